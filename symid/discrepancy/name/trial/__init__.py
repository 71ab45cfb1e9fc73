"""Suspects are tried on top of a fitted model: where a trial begins, what it promises, and what its fit finds."""
