"""The packages that lie in an environment: which are whole, which were left half installed."""

import csv
import re
import shutil
import zipfile
from collections.abc import Iterator
from pathlib import Path


def installed(site: Path) -> dict[str, str]:
    """Normalised name -> version of every package in `site`."""
    return {normal(name): version for name, version in map(_named, site.glob("*.dist-info"))}


def forget_damaged(site: Path) -> list[str]:
    """Removes the names of packages that are not whole, so that pip installs them again.

    Returns:
        The names and versions forgotten.
    """
    damaged = [info for info in site.glob("*.dist-info") if not _whole(info)]
    for info in damaged:
        shutil.rmtree(info)
    return [info.stem for info in damaged]


def fetched(folder: Path) -> set[str]:
    """`name==version` of every whole wheel in `folder`; one that was cut is removed."""
    found = set()
    for wheel in folder.glob("*.whl"):
        if zipfile.is_zipfile(wheel):  # a zip's table of contents stands at its end
            name, version = wheel.name.split("-")[:2]
            found.add(f"{normal(name)}=={version}")
        else:
            wheel.unlink()
    return found


def _named(info: Path) -> tuple[str, str]:
    name, _, version = info.stem.partition("-")
    return name, version


def normal(name: str) -> str:
    """One spelling of a package's name, as constraints.txt has it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def _whole(info: Path) -> bool:
    """pip writes INSTALLER and then RECORD last, so both are missing in a half installed one."""
    if not ((info / "RECORD").is_file() and (info / "INSTALLER").is_file()):
        return False
    return all(_there(info.parent / name, size) for name, size in _files(info / "RECORD"))


def _files(record: Path) -> Iterator[tuple[str, str]]:
    with record.open(newline="", encoding="utf-8") as rows:
        for row in csv.reader(rows):
            if len(row) == 3 and not row[0].endswith(".pyc"):
                # A script in bin/ names its Python: a move has changed its size.
                yield row[0], "" if row[0].startswith("..") else row[2]


def _there(file: Path, size: str) -> bool:
    try:
        return file.stat().st_size == int(size or file.stat().st_size)
    except OSError:
        return False
