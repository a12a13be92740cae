"""A gradebook and the key beside it: do they belong together? What is wrong has a next step."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ros2_on_pip.typed_paths import from_here, quoted_from_here
from roslings_class.gradebook import Gradebook
from roslings_class.signing import (
    ANEW,
    FILE,
    PUT_BACK,
    BadKey,
    close_to_others,
    make_key,
    read_key,
)

MOST_NAMED = 10


class LostKey(BadKey):
    """The gradebook is signed, and its key is gone."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"{from_here(folder / FILE)} is gone: the key that signed the evidence here.\n"
            "Without it nobody can tell whether the evidence is what was measured.",
            f"{PUT_BACK}\n{ANEW}",
        )


class OtherKey(BadKey):
    """The key is of another class."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"{from_here(folder / FILE)} is the key of another class.\n"
            "It did not sign this gradebook.",
            f"{PUT_BACK}\n{ANEW}",
        )


class NotSigned(BadKey):
    """There is a key, and yet no word of it in the gradebook."""

    def __init__(self, folder: Path) -> None:
        super().__init__(
            f"{from_here(folder / FILE)} is there, and nothing in the gradebook is signed.\n"
            "Somebody took the signatures away, or put another gradebook there.",
            "Put the gradebook back from a backup. Are you sure that this one is right?\n"
            "Then remove the key, and type the same command again: all is signed anew.",
        )


def take_key(book: Gradebook, folder: Path) -> list[str]:
    """Let the key of the class in `folder` sign the gradebook; what an instructor has to know.

    The first time it makes the key, and signs what was kept before there were keys.
    Raises BadKey and CannotWriteFile.
    """
    key = read_key(folder)
    if key is None:
        if book.signed_by():
            raise LostKey(folder)
        return _signed_once(book.sign_all(make_key(folder)), folder)
    told = close_to_others(folder)
    if book.signed_by() is None:
        if book.has_evidence():
            raise NotSigned(folder)
        book.sign_all(key)
    elif book.signed_by() != key.name:
        raise OtherKey(folder)
    book.use(key)
    return told


def _signed_once(count: int, folder: Path) -> list[str]:
    if not count:
        return []
    return [
        f"The evidence of {count} submissions was not signed. It is signed now, as it is:\n"
        "believe it as you did before. From now on, what is changed in it is seen.\n"
        f"The key is {from_here(folder / FILE)}: nobody else may read it."
    ]


def forged_lines(forged: Mapping[str, str], lab: str, folder: Path) -> list[str]:
    """Which evidence was not judged again, why, and what to do."""
    if not forged:
        return []
    named = [f"  {name}: {why}" for name, why in list(forged.items())[:MOST_NAMED]]
    more = [f"  and {len(forged) - MOST_NAMED} more"] if len(forged) > MOST_NAMED else []
    return [
        f"{len(forged)} not judged again: the evidence is not what was measured. They keep the\n"
        "verdict that they had:",
        *named,
        *more,
        "To measure them anew:",
        f"  ./roslings grade {lab} SUBMISSIONS --out {quoted_from_here(folder)}",
    ]
