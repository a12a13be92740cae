"""What slow tests need: recorded when they run, so that the gate can choose by it.

    python .ci/needs.py record                 every test file with slow tests, and every lesson
    python .ci/needs.py record --missing       those with no record, or one that holds no more
    python .ci/needs.py record FILE...         these
    python .ci/needs.py join CLONE...          take in what was recorded in other clones
    python .ci/needs.py chosen --commit HASH   what runs at that commit, what is left out, and why

`record` writes after each file, so it may be interrupted, and goes on with `--missing`. Leave the
clone alone meanwhile: whatever is opened in it counts. Several clones may share the work, and
`join` puts it together. How it is seen stands in `tests/needed/opened.py`, the rules in
`tests/needed/choice.py`.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests"), *map(str, ROOT.glob("packages/*/src"))]

from machine import lack_of  # noqa: E402
from needed.choice import SAME, Choice, Core  # noqa: E402
from needed.left_out import write  # noqa: E402
from needed.opened import CannotWatch  # noqa: E402
from needed.recorder import Made, NoRecord, Recorder, made_by  # noqa: E402
from needed.records import Records  # noqa: E402
from needed.tree import RECORDS, NoGit, Tree  # noqa: E402
from roslings_prove.proofs.command import newest_commit  # noqa: E402
from roslings_prove.proofs.digests import measuring  # noqa: E402

RECORDED = Records(ROOT / RECORDS)


def core() -> Core:
    """What all labs are measured with, as it is now."""
    now = measuring()
    files = (now.modules.tree.file_of(name) for name in now.shared)
    return Core(frozenset(f.relative_to(ROOT).as_posix() for f in files if f), now.core)


def choice(commit: str = "") -> Choice:
    """By the records and the files of this clone."""
    return Choice(RECORDED.read(), Tree(ROOT), core, commit, lack_of)


def record(options: argparse.Namespace) -> int:
    """Run test files, and keep what they need; 1 where one got no record."""
    recorder = Recorder(ROOT)
    there = recorder.files()
    asked = list(map(name_of, options.files)) or there
    if options.missing:
        asked = missing(asked)
    print(f"{len(asked)} test files to record, in this clone; leave it alone meanwhile.")
    failed = 0
    for made in made_by(recorder, asked):
        if made.record:
            RECORDED.add(made.record, there)
        failed += not made.record
        print(told(made), flush=True)
    print(f"Kept: {kept()}.")
    return int(failed > 0)


def missing(asked: Iterable[str]) -> list[str]:
    """Those with no record, or one that holds no more."""
    holds = {file for file, each in choice().standings.items() if each.rule == SAME}
    return [file for file in asked if file not in holds]


def name_of(file: str) -> str:
    """From the clone's root."""
    return Path(file).resolve().relative_to(ROOT).as_posix()


def told(made: Made) -> str:
    """One line, and where there is no record the reason below it."""
    begin = f"{made.seconds:7.0f} s  {made.file}: "
    if made.record is None:
        return f"{begin}no record, {made.why_not}"
    lacks = f", recorded without {', '.join(made.record.lacks)}" if made.record.lacks else ""
    return f"{begin}{len(made.record.needs)} needs{lacks}"


def kept() -> str:
    """How many records there are, and how large they are."""
    size = sum(file.stat().st_size for file in RECORDED.folder.glob("*"))
    return f"{len(RECORDED.read())} records, {size / 1000:.0f} kB in {RECORDS}"


def join(options: argparse.Namespace) -> int:
    """Take records of other clones where they hold here, and ours do not."""
    records, tree = RECORDED.read(), Tree(ROOT)
    for clone in options.clones:
        for file, record in Records(clone / RECORDS).read().items():
            if all(tree.digest(need) == digest for need, digest in record.needs.items()):
                records[file] = record
    RECORDED.write(records.values())
    print(f"Kept: {kept()}.")
    return 0


def chosen(options: argparse.Namespace) -> int:
    """Print what is done with each recorded file; `--to` is for pytest."""
    now = choice(options.commit)
    if options.to:
        write(options.to, now.left_out.values())
    for file in now.standings:
        print(f"{file}: {now.why(file)}")
    left, all_of = len(now.left_out), len(now.standings)
    print(f"{left} of {all_of} recorded test files are left out, whole or in part; all others run.")
    return 0


def main() -> int:
    """Do as the words say; 1 where something went wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(required=True)
    recording = commands.add_parser("record")
    recording.add_argument("files", nargs="*", metavar="FILE")
    recording.add_argument("--missing", action="store_true")
    recording.set_defaults(run=record)
    joining = commands.add_parser("join")
    joining.add_argument("clones", nargs="+", type=Path, metavar="CLONE")
    joining.set_defaults(run=join)
    choosing = commands.add_parser("chosen")
    choosing.add_argument("--commit", default=newest_commit(), metavar="HASH")
    choosing.add_argument("--to", type=Path, metavar="FILE")
    choosing.set_defaults(run=chosen)
    options = parser.parse_args()
    try:
        return int(options.run(options))
    except (NoGit, NoRecord, CannotWatch) as error:
        print(f"needs: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
