"""What these tests share with those that span packages."""

from stages import empty, stage, workshop

__all__ = ["empty", "stage", "workshop"]
