"""Which known law it is."""
