"""Straight-line programs: SymPy expressions as numbered operations, and these as C."""
