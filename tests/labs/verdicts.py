"""The verdicts of all hand-written packages, written down; then two such records, compared.

For a change that moves much and must change no verdict: record before it, record after it.

    .venv/bin/python tests/labs/verdicts.py record FILE [--labs topics nodes] [--jobs 2]
    .venv/bin/python tests/labs/verdicts.py compare BEFORE AFTER

`record` grades the solution, the starter and each mutant of the labs by the engine of the
environment whose Python runs this file: another commit is recorded from a clone of its own, with
that clone's Python and this very file. FILE holds a line of JSON for each package; Ctrl-C, and
the same command later, go on. `compare` looks at outcome, points and fault of every check, and
ends with 1 where two differ. What one of both could not tell is named, and is no difference.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import islice
from pathlib import Path

CHUNK = 24
"""So many are graded, then written down: an interrupted run loses no more."""


@dataclass(frozen=True)
class Said:
    """What was said of one check."""

    outcome: str
    points: float
    fault: str | None

    def __str__(self) -> str:
        """It in a few words."""
        kind = f" ({self.fault})" if self.fault else ""
        return f"{self.outcome} {self.points:g}{kind}"


Verdicts = dict[str, dict[str, Said]]
"""Package's name to check to what was said of it; no checks where it was refused."""


# --- record ------------------------------------------------------------------------------------


def record(file: Path, labs: Sequence[str], jobs: int | None) -> None:
    """Grade what the file does not know yet."""
    from roslings.course import all_labs
    from roslings_prove.prove import ProvenPackage, packages_of

    known = verdicts_in(file)
    packages: list[ProvenPackage] = [
        each
        for lab in all_labs()
        if not labs or lab.name in labs
        for each in packages_of(lab)
        if each.name not in known
    ]
    remaining = iter(packages)
    while chunk := list(islice(remaining, CHUNK)):
        keep(file, verdicts_of(chunk, jobs))
        print(f"{len(verdicts_in(file))} of {len(known) + len(packages)}", flush=True)


def verdicts_of(packages: Collection[object], jobs: int | None) -> Verdicts:
    """Grade them; what could not be told is tried once more, as `grade` does."""
    from roslings.experiment.run_folder import run_folder
    from roslings_prove.prove import graded

    with run_folder() as scratch:
        results = graded(packages, scratch, lambda _: None, jobs)  # type: ignore[arg-type]
    return {
        name: {
            check.id: Said(check.outcome, check.points, check.fault)
            for check in (result.verdict.checks if result.verdict else ())
        }
        for name, result in results.items()
    }


def keep(file: Path, verdicts: Verdicts) -> None:
    """A line for each package."""
    with file.open("a", encoding="utf-8") as lines:
        for name, checks in verdicts.items():
            said = {check: asdict(each) for check, each in checks.items()}
            lines.write(json.dumps({"package": name, "checks": said}) + "\n")


def verdicts_in(file: Path) -> Verdicts:
    """All that a file holds; half a line that a power cut left is no verdict."""
    lines = file.read_text("utf-8").splitlines() if file.is_file() else []
    return dict(read for read in map(_read, lines) if read)


def _read(line: str) -> tuple[str, dict[str, Said]] | None:
    try:
        row = json.loads(line)
    except ValueError:
        return None
    return row["package"], {check: Said(**said) for check, said in row["checks"].items()}


# --- compare -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Difference:
    """A check of which two engines say two things."""

    package: str
    check: str
    before: Said | None
    after: Said | None

    @property
    def is_open(self) -> bool:
        """One of both could not tell."""
        said = (self.before, self.after)
        return any(each and each.outcome == "inconclusive" for each in said)

    def __str__(self) -> str:
        """It on one line."""
        return f"{self.package}: {self.check}: {self.before} before, {self.after} after"


def differences(before: Verdicts, after: Verdicts) -> Iterator[Difference]:
    """Of all packages that both know, in the order of their names."""
    for package in sorted(before.keys() & after.keys()):
        yield from _between(package, before[package], after[package])


def _between(
    package: str, before: Mapping[str, Said], after: Mapping[str, Said]
) -> Iterator[Difference]:
    for check in dict.fromkeys((*before, *after)):
        if before.get(check) != after.get(check):
            yield Difference(package, check, before.get(check), after.get(check))


def compare(before: Verdicts, after: Verdicts) -> int:
    """Print what differs, what could not be told and what only one knows; 1 where some differ."""
    found = list(differences(before, after))
    for name in sorted(before.keys() ^ after.keys()):
        print(f"only {'before' if name in before else 'after'}: {name}")
    for each in found:
        print(f"{'not told' if each.is_open else 'DIFFERS'}  {each}")
    both = before.keys() & after.keys()
    checks = sum(len(before[name]) for name in both)
    wrong = sum(not each.is_open for each in found)
    print(f"{len(both)} packages, {checks} checks: {wrong} differ, {len(found) - wrong} not told.")
    return 1 if wrong else 0


# --- the command -------------------------------------------------------------------------------


def options_in(words: Sequence[str]) -> argparse.Namespace:
    """What was typed."""
    parser = argparse.ArgumentParser(description="Record verdicts, or compare two records.")
    verbs = parser.add_subparsers(dest="verb", required=True)
    recording = verbs.add_parser("record")
    recording.add_argument("file", type=Path)
    recording.add_argument("--labs", nargs="+", default=[])
    recording.add_argument("--jobs", type=int)
    comparing = verbs.add_parser("compare")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    return parser.parse_args(words)


def main(words: Sequence[str]) -> int:
    """Do it; the status."""
    options = options_in(words)
    if options.verb == "compare":
        return compare(verdicts_in(options.before), verdicts_in(options.after))
    for number in (signal.SIGINT, signal.SIGTERM):  # a job in the background would not hear Ctrl-C
        signal.signal(number, signal.default_int_handler)
    try:
        record(options.file, options.labs, options.jobs)
    except KeyboardInterrupt:
        print("Interrupted: the same command goes on.")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
