"""Reports that a person reads: one HTML file each, with figures inside."""

from symid.report.solution import report_html, write_report

__all__ = ["report_html", "write_report"]
