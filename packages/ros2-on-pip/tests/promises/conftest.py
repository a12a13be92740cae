"""What the tests of the promises share."""

from launched import launch

__all__ = ["launch"]
