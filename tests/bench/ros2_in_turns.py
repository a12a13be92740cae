"""Looks of `ros2` beside ten nodes, by two trees in turns; prints, and asserts nothing.

    .venv/bin/python tests/bench/ros2_in_turns.py [--bare] BEFORE AFTER ROUNDS

BEFORE and AFTER are folders of clones, whose files are run by this Python: what is installed is
the same for both. In each round each look is made once by each, beside the same nodes, and the
other tree begins. A row has p50 and the longest in seconds, the same in CPU seconds, and how often
all was seen. The nodes are plain `python3` in a terminal that has sourced setup.bash; with
`--bare`, in one that has not, where nodes announce themselves every 3 s.

    .venv/bin/python tests/bench/ros2_in_turns.py OLD . 50
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain

sys.path.insert(0, str(Path(__file__).resolve().parent))

from ros2 import NODES, SOURCED, TOPICS, Ran, Shell, surroundings, talkers

LOOKS: dict[tuple[str, ...], Callable[[Ran], bool]] = {
    ("node", "list"): lambda ran: len(ran.lines) == NODES,
    ("topic", "list"): lambda ran: len(ran.lines) == TOPICS,
    ("topic", "info", "/chatter"): lambda ran: f"Publisher count: {NODES}" in ran.lines,
}
"""What is typed, and whether all is in what it printed."""


@dataclass(frozen=True)
class Look:
    """One look: how long it took, how much of a processor, whether it saw all."""

    took_s: float
    cpu_s: float
    complete: bool


def path_of(clone: Path) -> str:
    """Where the programs of a clone lie, for Python."""
    return os.pathsep.join(str(place) for place in sorted(clone.resolve().glob("packages/*/src")))


def looked(shell: Shell, clone: Path, words: tuple[str, ...]) -> Look:
    """One look by the files of `clone`."""
    before, began_s = os.times(), time.perf_counter()
    ran = shell(*words, PYTHONPATH=path_of(clone))
    took_s, after = time.perf_counter() - began_s, os.times()
    used_s = after.children_user + after.children_system
    return Look(took_s, used_s - before.children_user - before.children_system, LOOKS[words](ran))


def row(clone: Path, words: Sequence[str], looks: Sequence[Look]) -> str:
    """What is printed of all looks of one kind by one clone."""
    times_s, cpu_s = [look.took_s for look in looks], [look.cpu_s for look in looks]
    return (
        f"| {' '.join(words)} | {clone.resolve().name} | {statistics.median(times_s):.2f}"
        f" | {max(times_s):.2f} | {statistics.median(cpu_s):.2f} | {max(cpu_s):.2f}"
        f" | {sum(look.complete for look in looks)} of {len(looks)} |"
    )


def main(clones: Sequence[Path], rounds: int, settings: dict[str, str]) -> None:
    """Print a row for each look of each clone."""
    print(f"load {os.getloadavg()[0]:.1f}, {NODES} nodes")
    print("| look | clone | p50 s | longest s | p50 CPU s | longest CPU s | complete |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as home, leased_domain() as domain:
        shell = Shell(surroundings(domain, Path(home)), Path(home))
        with talkers(shell, NODES, settings):
            for words in LOOKS:
                made: dict[Path, list[Look]] = {clone: [] for clone in clones}
                for number in range(rounds):
                    for clone in clones if number % 2 else reversed(clones):
                        made[clone].append(looked(shell, clone, words))
                for clone, looks in made.items():
                    print(row(clone, words, looks), flush=True)


def options_in(words: Sequence[str]) -> argparse.Namespace:
    """Two clones, how often, and how the nodes were started."""
    reader = argparse.ArgumentParser(description=__doc__, usage=(__doc__ or "").splitlines()[2])
    reader.add_argument("--bare", action="store_true")
    reader.add_argument("clones", nargs=2, type=Path)
    reader.add_argument("rounds", type=int)
    return reader.parse_args(words)


if __name__ == "__main__":
    options = options_in(sys.argv[1:])
    main(options.clones, options.rounds, {} if options.bare else SOURCED)
