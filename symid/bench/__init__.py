"""Measurements: symid beside its peers, in fresh processes on one core; ratios count, times do not."""
