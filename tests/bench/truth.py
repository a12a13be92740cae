"""Many gradings of packages whose verdict is known, all processors busy; prints, asserts nothing.

    .venv/bin/python tests/bench/truth.py [N] --file FILE [--busy 4] [--jobs 4]
        [--labs topics nodes]

N gradings (1,000) of all labs' solutions, starters and hand-written mutants, in an order that is
shuffled and always the same. A mutant must fail in exactly the checks that it names, a solution
gets 100, a starter does not pass. One in four is a solution: a right package that loses a point is
worse than a wrong one that keeps it. Each grading may end right, wrong, or inconclusive; what is
inconclusive is tried again by itself, as `grade` does, and counted in both columns.

Ctrl-C, and the same command later, go on: FILE holds a line of JSON for each grading, and only what
this very engine and these very labs said counts. What was not right leaves its evidence in
FILE.evidence/, to be looked at with `./roslings regrade LAB FOLDER`. `--busy 4` runs four more
processes that never rest. `--show` prints the table of a file, and grades nothing.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import asdict, dataclass
from functools import cache
from itertools import count, islice
from pathlib import Path
from typing import Literal

from roslings.arena.kernel import cores
from roslings.course import Lab, all_labs
from roslings.course.grader import Clock
from roslings.course.labs import MUTANTS
from roslings.experiment.run_folder import run_folder
from roslings_class.gradebook import FILE, gradebook
from roslings_class.result import GradingResult
from roslings_class.scheduler import BatchProgress
from roslings_class.version import engine_in, version_of
from roslings_prove.prove import ProvenPackage, Solution, graded, packages_of, proof_of

SEED = 19
CHUNK = 48
"""So many are graded, then written down: an interrupted run loses no more."""
RIGHT = 3
"""Of so many wrong packages in a row, one more is a right one."""
BUSY = "import os\nparent = os.getppid()\nwhile os.getppid() == parent: pass"
Word = Literal["right", "wrong", "inconclusive"]


# --- what is graded, in which order ------------------------------------------------------------


@dataclass(frozen=True)
class Again:
    """A package of a lab, for the n-th time."""

    package: ProvenPackage
    turn: int

    @property
    def lab(self) -> Lab:
        """Whose it is."""
        return self.package.lab

    @property
    def clock(self) -> Clock:
        """By which its experiments run."""
        return self.package.clock

    @property
    def course(self) -> Path | None:
        """Where the files lie by which it is graded."""
        return self.package.course

    @property
    def name(self) -> str:
        """Of this grading only."""
        return f"{self.package.name} {self.turn}"

    @property
    def about(self) -> str:
        """What must hold of it."""
        return self.package.about

    def make(self, folder: Path) -> Path:
        """Where it lies."""
        return self.package.make(folder / str(self.turn))

    def problem(self, result: GradingResult) -> str:
        """What is wrong with a conclusive result."""
        return self.package.problem(result)


def in_order(labs: Sequence[Lab]) -> Iterator[Again]:
    """Gradings without end, the same ones each time."""
    dice, turns = random.Random(SEED), dict[str, int]()
    for package in _packages(labs, dice):
        turns[package.name] = turns.get(package.name, 0) + 1
        yield Again(package, turns[package.name])


def _packages(labs: Sequence[Lab], dice: random.Random) -> Iterator[ProvenPackage]:
    """All wrong ones, shuffled, with the solutions in turn among them; then all anew."""
    everything = [package for lab in labs for package in packages_of(lab)]
    right = [package for package in everything if isinstance(package, Solution)]
    wrong = [package for package in everything if not isinstance(package, Solution)]
    solutions = (right[n % len(right)] for n in count())
    while True:
        for n, package in enumerate(dice.sample(wrong, len(wrong))):
            yield package
            if n % RIGHT == RIGHT - 1:
                yield next(solutions)


# --- what came of it ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Row:
    """One grading."""

    version: str
    """Of the engine and the lab, with its mutants."""
    name: str
    lab: str
    is_solution: bool
    first: Word
    """What the first try said."""
    last: Word
    """What was said in the end."""
    score: float | None
    seconds: float
    busy: int
    """Other processes that never rested."""
    idle: float
    """Part of the processors that nobody used, while this one and those around it were graded."""
    why: str = ""
    """What was not right, in the first try that was not."""


@cache
def version(lab: Lab) -> str:
    """Another one after each change to the engine, the lab, or one of its packages."""
    packages = map(engine_in, (lab.solution, lab.starter, lab.folder / MUTANTS))
    return hashlib.sha256(version_of(lab).encode() + b"".join(packages)).hexdigest()[:16]


def rows_in(file: Path, labs: Sequence[Lab]) -> dict[str, Row]:
    """Name to grading, of those that the engine and the labs of now have made."""
    lines = file.read_text("utf-8").splitlines() if file.is_file() else []
    now = {version(lab) for lab in labs}
    return {row.name: row for row in map(row_in, lines) if row and row.version in now}


def row_in(line: str) -> Row | None:
    """One line of the file; None where a power cut left half of it."""
    try:
        return Row(**json.loads(line))
    except (ValueError, TypeError):
        return None


def word_of(package: Again, result: GradingResult) -> tuple[Word, str]:
    """Right, wrong or inconclusive, and why."""
    proof = proof_of(package, result)
    if proof.holds:
        return "right", ""
    return ("inconclusive" if proof.is_open else "wrong"), proof.problem


def row_of(package: Again, tries: Sequence[GradingResult], busy: int, idle: float) -> Row:
    """All tries of one grading."""
    said = [word_of(package, each) for each in tries]
    return Row(
        version(package.lab),
        package.name,
        package.lab.name,
        isinstance(package.package, Solution),
        said[0][0],
        said[-1][0],
        tries[-1].score,
        round(tries[0].seconds, 1),
        busy,
        round(idle, 3),
        next((why for _, why in said if why), ""),
    )


# --- grade -------------------------------------------------------------------------------------


def grade(options: argparse.Namespace, labs: Sequence[Lab]) -> None:
    """All that the file does not know yet, chunk by chunk."""
    known = rows_in(options.file, labs)
    todo = [each for each in islice(in_order(labs), options.n) if each.name not in known]
    with burning(options.busy), run_folder() as scratch:
        for start in range(0, len(todo), CHUNK):
            chunk, book = todo[start : start + CHUNK], f"book{start}"
            with at_work() as work:
                graded(chunk, scratch, silent, options.jobs, book=book, keeps_evidence=True)
            keep(options, chunk, scratch / book, work.idle)
            shutil.rmtree(scratch / "made")
            tell(len(known) + start + len(chunk), options.n, work)


@dataclass
class Work:
    """What a stretch of time was used for."""

    seconds: float = 0.0
    idle: float = 0.0
    """Part of the processors that nobody used."""


@contextmanager
def at_work() -> Iterator[Work]:
    """Filled in when the block ends."""
    work, began_s, began_idle_s = Work(), time.monotonic(), idle_s()
    yield work
    work.seconds = time.monotonic() - began_s
    work.idle = (idle_s() - began_idle_s) / (work.seconds * (os.cpu_count() or 1))


def keep(options: argparse.Namespace, chunk: Iterable[Again], book: Path, idle: float) -> None:
    """Write down a chunk, and the evidence of what was not right."""
    tries = tries_in(book)
    rows = [row_of(each, tries[each.name], options.busy, idle) for each in chunk]
    keep_evidence(options.file.with_name(options.file.name + ".evidence"), book, rows)
    with options.file.open("a", encoding="utf-8") as file:
        file.writelines("\n" + json.dumps(asdict(row)) for row in rows)
    for row in rows:
        if row.first != "right":
            print(f"  {row.first}, then {row.last}: {row.name}: {row.why}", flush=True)


def tries_in(book: Path) -> dict[str, list[GradingResult]]:
    """Package's name to all that was said of it, one try after the other."""
    tries: dict[str, list[GradingResult]] = {}
    with closing(sqlite3.connect(book / FILE)) as connection:
        for (text,) in connection.execute("SELECT result FROM results ORDER BY id"):
            result = GradingResult.model_validate_json(text)
            tries.setdefault(result.submission, []).append(result)
    return tries


def keep_evidence(folder: Path, book: Path, rows: Iterable[Row]) -> None:
    """Of the last try of each grading that was not right at once."""
    from roslings.evidence import evidence_json
    from roslings_class.grading import unpacked

    with gradebook(book, "labs") as results:
        latest = results.latest()
        for row in rows:
            if row.first != "right" and (content := results.evidence(latest[row.name])):
                place = folder / row.name.replace(": ", "-").replace(" ", "-")
                place.mkdir(parents=True, exist_ok=True)
                (place / "evidence.json").write_bytes(evidence_json(unpacked(content)))


@contextmanager
def burning(processes: int) -> Iterator[None]:
    """So many processes that never rest while the block runs; they end with this one."""
    command = [sys.executable, "-S", "-c", BUSY]
    with ExitStack() as stack:
        for _ in range(processes):
            burner = stack.enter_context(subprocess.Popen(command, start_new_session=True))
            stack.callback(burner.kill)
        yield


def idle_s() -> float:
    """Seconds in which this machine's processors had nothing to do, since it was started."""
    words = Path("/proc/stat").read_text("ascii").split()
    return (int(words[4]) + int(words[5])) / os.sysconf("SC_CLK_TCK")


def silent(standing: BatchProgress) -> None:
    """A line for each chunk is enough."""


def tell(done: int, wanted: int, work: Work) -> None:
    """How far it is."""
    now = time.strftime("%H:%M:%S")
    last = f"the last {CHUNK} at most in {work.seconds:.0f} s, idle {work.idle:.0%}"
    print(f"{now}  {done} of {wanted}; {last}", flush=True)


# --- the table ---------------------------------------------------------------------------------


def show(rows: Sequence[Row]) -> None:
    """A line a lab, right packages beside wrong ones, and each grading that was not right."""
    print(
        "| lab | right packages | of them not 100 | wrong packages | of them other checks than told"
        " | inconclusive at first | after the second try |\n"
        "| --- | --- | --- | --- | --- | --- | --- |"
    )
    for lab in dict.fromkeys(sorted(row.lab for row in rows)):
        print(line_of(lab, [row for row in rows if row.lab == lab]))
    print(line_of("all", rows))
    for row in rows:
        if row.first != "right":
            print(f"{row.first}, then {row.last}: {row.name}: {row.why}")
    if rows:
        print(f"idle {sum(row.idle for row in rows) / len(rows):.1%} of {cores()} processors")


def line_of(name: str, rows: Sequence[Row]) -> str:
    """One line of the table."""
    right = [row for row in rows if row.is_solution]
    wrong = [row for row in rows if not row.is_solution]
    not_right = [sum("wrong" in (row.first, row.last) for row in kind) for kind in (right, wrong)]
    unclear = [sum(getattr(row, which) == "inconclusive" for row in rows) for which in TRIES]
    parts = [f"{number} ({number / max(1, len(rows)):.1%})" for number in unclear]
    return (
        f"| {name} | {len(right)} | {not_right[0]} | {len(wrong)} | {not_right[1]}"
        f" | {parts[0]} | {parts[1]} |"
    )


TRIES = ("first", "last")


def options_in(words: Sequence[str]) -> argparse.Namespace:
    """What was typed."""
    parser = argparse.ArgumentParser(description="Grade packages whose verdict is known.")
    parser.add_argument("n", nargs="?", type=int, default=1000)
    parser.add_argument("--file", type=Path, required=True)
    parser.add_argument("--busy", type=int, default=0)
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--labs", nargs="+", default=[])
    parser.add_argument("--show", action="store_true")
    return parser.parse_args(words)


def main(words: Sequence[str]) -> None:
    """Grade what is left, and print the table; also where it is interrupted."""
    options = options_in(words)
    labs = [lab for lab in all_labs() if not options.labs or lab.name in options.labs]
    for number in (signal.SIGINT, signal.SIGTERM):  # a job in the background would not hear Ctrl-C
        signal.signal(number, signal.default_int_handler)
    try:
        if not options.show:
            grade(options, labs)
    except KeyboardInterrupt:
        print("Interrupted: the same command goes on.")
    show(list(rows_in(options.file, labs).values()))


if __name__ == "__main__":
    main(sys.argv[1:])
