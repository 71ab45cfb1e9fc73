"""What sensors add to a motion, and what filters take from it: noise, its memory, zero-phase filters, smoothing."""
