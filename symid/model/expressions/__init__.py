"""Arithmetic on parts: operators, NumPy's functions, comparisons, tables and C functions as SymPy expressions."""
