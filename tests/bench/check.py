"""How long a verdict takes and what it costs; prints, and asserts nothing.

    .venv/bin/python tests/bench/check.py [RUNS]      from Enter to verdict, RUNS times (20)
    .venv/bin/python tests/bench/check.py labs        what each lab takes, and of whom

A bare `colcon build` of the same package runs before each check: what is left when it is taken
away is ours and the nodes'. CPU and memory of the grader stand beside those of the student's nodes,
from the same run.
"""

from __future__ import annotations

import platform
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from roslings.arena import base_environment
from roslings.course import Lab, all_labs, lab, root
from roslings.evidence import Evidence
from roslings.experiment import MeasuringOptions
from roslings.grading.checking import ready
from roslings.verdict import Verdict
from roslings.workspace.build import colcon

EXAMPLE = "topics"


@dataclass(frozen=True)
class Run:
    """One grading: the verdict, the evidence, and what the whole of it took."""

    verdict: Verdict
    evidence: Evidence
    cpu_s: float
    """Of the command, the measuring process, colcon and the nodes."""

    @property
    def nodes_cpu_s(self) -> float:
        """Of the student's nodes alone."""
        experiments = self.evidence.experiments.values()
        return sum(p.cpu_s for e in experiments for p in e.processes.values())

    @property
    def nodes_peak_mb(self) -> float:
        """Memory of the largest of the student's nodes."""
        experiments = self.evidence.experiments.values()
        peaks = [p.peak_memory_bytes for e in experiments for p in e.processes.values()]
        return max(peaks, default=0) / 1e6


def cpu_s() -> float:
    """CPU seconds of this process and of all that it has waited for."""
    whose = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN
    return sum(u.ru_utime + u.ru_stime for u in map(resource.getrusage, whose))


def peak_mb() -> float:
    """Memory of the largest process of ours so far."""
    whose = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN
    return max(resource.getrusage(who).ru_maxrss for who in whose) / 1e3


def grade(each: Lab, package: Path) -> Run:
    """Grade a package once."""
    began_ns, began_cpu_s = time.monotonic_ns(), cpu_s()
    with ready(each, MeasuringOptions(seed=1)) as begun:
        graded = begun.grade(package, began_ns, quiet=True)
    return Run(graded.verdict, graded.evidence, cpu_s() - began_cpu_s)


def show(name: str, run: Run) -> None:
    """One line of the table."""
    s = run.verdict.seconds
    grader_cpu_s = run.cpu_s - run.nodes_cpu_s
    print(
        f"{name:20} {s.total:6.2f} {s.build:6.2f} {s.discovery:9.2f} {s.watching:8.2f}"
        f" {s.ending:6.2f} {grader_cpu_s:8.2f} {run.nodes_cpu_s:7.2f}"
        f" {grader_cpu_s / max(run.nodes_cpu_s, 0.01):6.2f} {peak_mb():6.0f}"
        f" {run.nodes_peak_mb:6.0f}  {run.verdict.outcome} {run.verdict.score}"
    )


def labs() -> None:
    """Print the table for every lab."""
    print(
        f"{'':20} {'total':>6} {'build':>6} {'discovery':>9} {'watching':>8} {'ending':>6}"
        f" {'CPU ours':>8} {'nodes':>7} {'ratio':>6} {'MB':>6} {'nodes':>6}"
    )
    for each in all_labs():
        timed_s([str(root() / "roslings"), "check", each.name, "--solution"], root())  # first use
        show(f"{each.name} solution", grade(each, each.solution))
        show(f"{each.name} starter", grade(each, each.starter))


def timed_s(command: list[str], folder: Path, environment: dict[str, str] | None = None) -> float:
    """From Enter to the prompt. Raises CalledProcessError."""
    began_s = time.monotonic()
    subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)
    return time.monotonic() - began_s


def bare_build_s(each: Lab) -> float:
    """`colcon build` of the solution in an empty workspace, with the nodes' own environment."""
    with tempfile.TemporaryDirectory() as folder:
        workspace = Path(folder)
        shutil.copytree(each.solution, workspace / "src" / each.card.package)
        return timed_s([colcon(), "build"], workspace, base_environment(workspace))


def from_enter(runs: int) -> None:
    """Print the check beside the bare build, and what lies between the two."""
    each, command = lab(EXAMPLE), [str(root() / "roslings"), "check", EXAMPLE, "--solution"]
    timed_s(command, root())  # whatever is made at the first use is made now
    rows = [(bare_build_s(each), timed_s(command, root())) for _ in range(runs)]
    builds, checks = zip(*rows, strict=True)
    over = [check - build for build, check in rows]
    for name, figures in (("colcon build", builds), ("check", checks), ("check - build", over)):
        print(
            f"{name:14} median {statistics.median(figures):5.2f} s"
            f"   least {min(figures):5.2f}   most {max(figures):5.2f}   of {runs}"
        )
    ratio = statistics.median(check / build for build, check in rows)
    print(f"check / build  median {ratio:5.2f}")


def main() -> None:
    """Print what is asked for."""
    print(f"{platform.platform()}, Python {platform.python_version()}")
    if sys.argv[1:] == ["labs"]:
        labs()
    else:
        from_enter(int(sys.argv[1]) if len(sys.argv) > 1 else 20)


if __name__ == "__main__":
    main()
