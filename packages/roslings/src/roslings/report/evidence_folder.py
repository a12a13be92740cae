"""The folder that `--evidence` makes: it appears whole or not at all, and replaces nothing."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.typed_paths import from_here, quoted_from_here
from roslings.evidence import Evidence
from roslings.report.evidence_file import FILE, evidence_bytes
from roslings.report.node_logs import logs_of
from roslings.report.whole_file import CannotWriteFile

BAGS, LOGS = "bags", "logs"
LONGEST_NAME = 100
_UNSAFE = re.compile(r"[^\w.-]+")


class CannotKeepThere(RoslingsError):
    """Evidence cannot be put at a path; the message says why, and what to do."""

    def __init__(self, path: Path, problem: str, next_step: str) -> None:
        super().__init__(f"{from_here(path)} {problem} Nothing was changed.\n{next_step}")


def require_free(folder: Path) -> None:
    """Before a check begins: `folder` is not there or is empty, and can be made.

    Raises CannotKeepThere.
    """
    step = f"Give a new name: --evidence {quoted_from_here(_free_name(folder))}"
    if folder.resolve() == Path.cwd():
        raise CannotKeepThere(folder, "is the folder that you are in.", step)
    if _taken(folder):
        raise CannotKeepThere(folder, _what_is_there(folder), step)
    parent = folder.absolute().parent
    if not parent.is_dir():
        step = f"Make the folder around it first: mkdir -p {quoted_from_here(parent)}"
        raise CannotKeepThere(folder, "cannot be made here.", step)
    try:
        _part(folder).mkdir()
        _part(folder).rmdir()
    except OSError as error:
        step = "Give a place where you may write, for example: --evidence ~/evidence"
        raise CannotKeepThere(folder, f"cannot be made: {error.strerror}.", step) from error


def _taken(folder: Path) -> bool:
    if not folder.is_dir():
        return folder.exists() or folder.is_symlink()
    return any(folder.iterdir())


def _what_is_there(folder: Path) -> str:
    if not folder.is_dir():
        return "is a file."
    ours = (folder / FILE).is_file()
    return f"holds {'the evidence of another check' if ours else 'other files'}."


def _free_name(folder: Path) -> Path:
    """The first of NAME-2, NAME-3 and so on that is not there."""
    plain = folder if folder.name.strip(".") else Path("evidence")
    number = 2
    while (name := plain.with_name(f"{plain.stem}-{number}")).exists():
        number += 1
    return name


def _part(folder: Path) -> Path:
    """The hidden name, beside it, that a folder has until it is whole."""
    place = folder.absolute()
    return place.with_name(f".{place.name}-{os.getpid()}.part")


@contextmanager
def in_the_making(folder: Path) -> Iterator[Path]:
    """A hidden folder beside `folder`, which takes its name when the block ends well.

    Raises CannotKeepThere where somebody made `folder` meanwhile, and CannotWriteFile.
    """
    part = _part(folder)
    try:
        part.mkdir()
        yield part
        part.replace(folder.absolute())  # an empty folder gives way, a full one does not
    except OSError as error:
        if _taken(folder):
            require_free(folder)
        raise CannotWriteFile(folder, error) from error
    finally:
        shutil.rmtree(part, ignore_errors=True)


def fill(folder: Path, evidence: Evidence, bags: Path | None = None) -> None:
    """Put the evidence, the bags in `bags` and what every node wrote into `folder`."""
    (folder / FILE).write_bytes(evidence_bytes(evidence))
    if bags and bags.is_dir():
        shutil.copytree(bags, folder / BAGS)
    for name, text in log_files(evidence).items():
        path = folder / LOGS / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode("utf-8", "backslashreplace"))


def log_files(evidence: Evidence) -> dict[str, str]:
    """File name to text: colcon's last lines, each node's terminal, and all lines in /rosout."""
    files = {"build.txt": "\n".join([*evidence.build.output, ""])} if evidence.build else {}
    for seen in evidence.experiments.values():
        for log in logs_of(seen):
            files[f"{_file_name(seen.name)}/{_file_name(log.origin)}.txt"] = log.text
    return files


def _file_name(name: str) -> str:
    """No part of a name leads out of the folder."""
    return _UNSAFE.sub("_", name).strip("._")[:LONGEST_NAME] or "_"
