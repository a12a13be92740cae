"""Why something that was handed in cannot be graded."""

from __future__ import annotations


class HandInRefused(Exception):
    """A submission that cannot be graded as it was handed in; both texts are for its author."""

    def __init__(self, reason: str, next_step: str) -> None:
        self.reason, self.next_step = reason, next_step
        super().__init__(f"{reason}\n{next_step}")


PACK_AGAIN = "Hand in the file that ./roslings pack LAB makes."


class HostileArchive(HandInRefused):
    """The archive holds what no archive of a package holds."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason, PACK_AGAIN)
