"""A model fitted to segments: the iteration, where it begins, and the errors of what is found."""
