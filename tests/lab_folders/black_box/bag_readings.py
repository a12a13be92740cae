"""A package's program with real bags, in this very process: what comes of it is judged as usual.

No build, no sandbox: so the judgement on many packages takes seconds.
"""

from __future__ import annotations

import contextlib
import io
import runpy
import sys
import traceback
from collections.abc import Iterator
from pathlib import Path

from graders.black_box.act import holding
from graders.black_box.contract import BagWords
from graders.black_box.record import BagGiven, BagsSeen
from roslings.course import Lab
from roslings.course import written as said
from roslings.evidence import (
    BuildSeen,
    Evidence,
    ExperimentSeen,
    LogLine,
    MachineSeen,
    ProcessSeen,
)
from roslings.judge import judge
from roslings.verdict import Verdict
from roslings.workspace.inspect import inspect_package
from roslings_rover.models.drives.unknown import unknown_drive, without
from roslings_rover.rover.black_box import write_drive
from ways_to_write import written

HERE = MachineSeen(
    roslings="0",
    ros_distro="jazzy",
    rmw="rmw_fastrtps_cpp",
    python="3.12",
    platform="Linux",
    isolation="namespace",
)


class Bags:
    """The bags of one grading, for many packages."""

    def __init__(self, lab: Lab, folder: Path, seed: int = 7) -> None:
        self.lab, self._folder = lab, folder
        self._reader = said(lab.card.of(BagWords).reads_bags, lab.name)
        self._known: dict[str, dict[str, ExperimentSeen]] = {}
        first, other = self._reader.storages
        drives = [
            unknown_drive(seed + n, self._reader.odometry, self._reader.gap_periods)
            for n in range(3)
        ]
        write_drive(drives[0], folder / "drive", first)
        write_drive(drives[1], folder / "other", other, 4.0)
        write_drive(without(drives[2], self._reader.odometry), folder / "still", first)
        (folder / "folder").mkdir()
        self._holds = {
            "drive": holding(drives[0], self._reader),
            "other": holding(drives[1], self._reader),
        }

    def verdict_on(self, package: Path, handed_in_as: str = "", way: str = "print") -> Verdict:
        """Let the package read all of them, and judge it; its lines were written in this way."""
        files = inspect_package(package, self.lab.card)
        files.handed_in_as = handed_in_as
        names = [name for name in files.entry_points if files.entry_points[name]]
        built = BuildSeen(
            succeeded=True, recognised_as="ros.ament_python", seconds=1.0, executables=names
        )
        evidence = Evidence(lab=self.lab.name, seed=0, machine=HERE, package=files, build=built)
        for name, seen in self._read_by(package).items():
            evidence.experiments[name] = written(seen, way)
        return judge(self.lab, evidence)

    def _read_by(self, package: Path) -> dict[str, ExperimentSeen]:
        """What packages with the same program read is the same."""
        (program,) = package.glob(f"*/{self._reader.executable}.py")
        text = program.read_text("utf-8")
        if text not in self._known:
            self._known[text] = {
                name: self._seen(program, name, labels) for name, labels in EXPERIMENTS.items()
            }
        return self._known[text]

    def _seen(self, program: Path, name: str, labels: tuple[str, ...]) -> ExperimentSeen:
        seen = ExperimentSeen(name=name, clock="wall")
        for label in labels:
            path = self._folder / label
            given = BagGiven(label=label, path=str(path), holds=self._holds.get(label))
            seen.recording(BagsSeen).given.append(given)
            seen.processes[label] = ran(program, self._reader.executable, path)
        return seen


EXPERIMENTS = {
    "reading": ("drive",),
    "elsewhere": ("other",),
    "nothing": ("missing", "folder", "still"),
}


def ran(program: Path, executable: str, bag: Path) -> ProcessSeen:
    """What the program wrote about a bag, and how it ended."""
    written = io.StringIO()
    with _arguments([str(program), str(bag)]), contextlib.redirect_stdout(written):
        status = _status_of(program, written)
    lines = [
        LogLine(arrival_ns=0, text=text, source="terminal")
        for text in written.getvalue().splitlines()
    ]
    return ProcessSeen(
        executable=executable,
        started_ns=0,
        ended_ns=10**9,
        status=status,
        ended_by_itself=True,
        lines=lines,
    )


def _status_of(program: Path, written: io.StringIO) -> int:
    try:
        runpy.run_path(str(program), run_name="__main__")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 0
    except Exception:
        written.write(traceback.format_exc())
        return 1
    return 0


@contextlib.contextmanager
def _arguments(words: list[str]) -> Iterator[None]:
    before, sys.argv = sys.argv, words
    try:
        yield
    finally:
        sys.argv = before
