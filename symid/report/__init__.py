"""Reports that a person reads: one HTML file each, with figures inside."""

from symid.report.diagnosis import diagnosis_html, write_diagnosis_report
from symid.report.solution import report_html, write_report
from symid.report.study import study_html, write_study_report

__all__ = [
    "diagnosis_html",
    "report_html",
    "study_html",
    "write_diagnosis_report",
    "write_report",
    "write_study_report",
]
