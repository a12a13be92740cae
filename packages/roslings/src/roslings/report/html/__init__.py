"""A verdict and its evidence as one HTML file that needs no other file, no network, no script."""

from roslings.report.html.document import OfClass, Own, Reader, html_of, write_html
from roslings.report.html.intervals import Asked

__all__ = ["Asked", "OfClass", "Own", "Reader", "html_of", "write_html"]
