"""A model's equations as Programs: over one interval, at one moment, for many states, and its conditions."""
