"""How long a verdict takes and what it costs; prints, and asserts nothing.

    .venv/bin/python tests/bench/check.py

CPU and memory of the grader stand beside those of the student's nodes, from the same run.
"""

from __future__ import annotations

import platform
import resource
import time
from dataclasses import dataclass
from pathlib import Path

from roslings.course import all_labs
from roslings.evidence import Evidence
from roslings.experiment import Choices, measure
from roslings.judge import judge
from roslings.verdict import Verdict
from roslings.workspace.inspect import inspect_package


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


def grade(lab_name: str, package: Path) -> Run:
    """Grade a package once."""
    lab = next(lab for lab in all_labs() if lab.name == lab_name)
    began_s, began_cpu_s = time.monotonic(), cpu_s()
    files = inspect_package(package, lab.card)
    evidence = measure(lab.name, package, files, Choices(seed=1), lambda step: None)
    verdict = judge(lab, evidence, time.monotonic() - began_s)
    return Run(verdict, evidence, cpu_s() - began_cpu_s)


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


def main() -> None:
    """Print the table for every lab."""
    print(f"{platform.platform()}, Python {platform.python_version()}")
    print(
        f"{'':20} {'total':>6} {'build':>6} {'discovery':>9} {'watching':>8} {'ending':>6}"
        f" {'CPU ours':>8} {'nodes':>7} {'ratio':>6} {'MB':>6} {'nodes':>6}"
    )
    for lab in all_labs():
        show(f"{lab.name} solution", grade(lab.name, lab.solution))
        show(f"{lab.name} starter", grade(lab.name, lab.starter))


if __name__ == "__main__":
    main()
