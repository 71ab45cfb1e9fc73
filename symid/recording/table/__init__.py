"""A table of numbers in a file: how text holds it, what its columns are called, and which rows are there."""
