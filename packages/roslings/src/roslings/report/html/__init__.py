"""A verdict and its evidence as one HTML file that needs no other file, no network, no script."""

from roslings.report.html.document import OfClass, Own, Reader, html_of, write_html
from roslings.report.html.intervals import RequiredRate

__all__ = ["OfClass", "Own", "Reader", "RequiredRate", "html_of", "write_html"]
