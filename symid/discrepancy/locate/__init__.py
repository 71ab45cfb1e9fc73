"""Where and when something is missing."""
