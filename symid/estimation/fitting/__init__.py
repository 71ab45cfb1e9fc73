"""A model fitted to segments: its predictor, the iteration, where it begins, and the errors of what is found."""
