"""What a check saves beside the verdict: the evidence in a folder of its own, and a page."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from roslings.course import Lab
from roslings.evidence import Evidence
from roslings.experiment.run_folder import run_folder
from roslings.report.evidence_folder import CannotKeepThere, fill, in_the_making, require_free
from roslings.report.html import Reader, RequiredRate, write_html
from roslings.report.json_file import write_json
from roslings.verdict import Verdict

BAGS, VERDICT, PAGE = "bags", "verdict.json", "report.html"


class NothingToSave(RoslingsError):
    """The command runs nothing, so there is no evidence."""

    def __init__(self) -> None:
        super().__init__(
            "--hint shows your last verdict again and runs nothing: there is nothing to save.\n"
            "Leave --hint out, or leave --evidence and --html out."
        )


class NoBagWriter(RoslingsError):
    """The package that writes bags is not installed."""

    def __init__(self) -> None:
        super().__init__(
            "The package `rosbags`, which writes the bags of the evidence, is not installed.\n"
            "The script fetches it: run ./roslings check LAB --evidence DIR"
        )


@dataclass(frozen=True)
class Graded:
    """A verdict, and the evidence that it was judged from."""

    lab: Lab
    verdict: Verdict
    evidence: Evidence

    def write_page(self, path: Path, reader: Reader | None = None) -> None:
        """Write the page for a browser. Raises CannotWriteFile."""
        write_html(self.verdict, self.evidence, required_rates(self.lab), path, reader)


def required_rates(lab: Lab) -> list[RequiredRate]:
    """The rates that the lab's card asks for."""
    return [
        RequiredRate(topic.topic, topic.type, topic.rate.hz, topic.rate.low_hz, topic.rate.high_hz)
        for node in lab.card.nodes
        for topic in node.publishes
        if topic.rate
    ]


@contextmanager
def place_for_bags(folder: Path | None, package: Path) -> Iterator[Path | None]:
    """Where the bags lie until the verdict stands; None where no evidence is asked for.

    Refuses before the check begins what could not be saved after it. Raises CannotKeepThere.
    """
    if folder is None:
        yield None
        return
    _require_outside(folder, package)
    require_free(folder)
    _require_bag_writer()
    with run_folder() as scratch:
        yield scratch / BAGS


def _require_outside(folder: Path, package: Path) -> None:
    """What lies in the package is handed in with it."""
    if folder.resolve().is_relative_to(package.resolve()):
        step = f"Give a place outside it, for example: --evidence ~/{folder.name or 'evidence'}"
        raise CannotKeepThere(folder, "lies inside the package.", step)


def _require_bag_writer() -> None:
    """The script `./roslings` sees to it. Raises NoBagWriter."""
    if find_spec("rosbags") is None:
        raise NoBagWriter


def save(graded: Graded, folder: Path, bags: Path | None) -> None:
    """Make the folder: evidence, verdict, bags, logs and the page. Raises CannotWriteFile."""
    with in_the_making(folder) as part:
        fill(part, graded.evidence, bags)
        write_json(graded.verdict, part / VERDICT)
        graded.write_page(part / PAGE)
