"""Whether data that were not used agree."""
