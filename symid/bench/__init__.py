"""Measurements: symid beside its peers, in fresh processes on one core; ratios count, times do not."""

from symid.bench.measure import measure, measure_load
from symid.bench.table import load_table, table
from symid.bench.task import Task

__all__ = ["Task", "load_table", "measure", "measure_load", "table"]
