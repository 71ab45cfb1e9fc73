"""Samples of one channel: when they were taken, what stands out, how they run on, and their rates."""
