"""constraints.txt, read: each line pins a package and names, behind `#`, the groups that need it.

numpy==2.5.5 ; python_full_version >= '3.12'  # ros graph
"""

import json
import os
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.errors import LauncherTrouble

# Run by the environment's Python, which knows what a marker means there and what is installed.
# The pip that it asks is itself pinned.
_ASK = """
import json, platform, sys
from importlib.metadata import PackageNotFoundError, version
from pip._vendor.packaging.requirements import Requirement

def missing(need):
    try:
        seen = version(need.name)
    except PackageNotFoundError:
        return True
    return need.name not in any_version and seen not in need.specifier

minor = "%d.%d" % sys.version_info[:2]
others = [minor + ".0", minor + ".99"] if sys.argv[1] == "all" else []
pythons = [{"python_full_version": full} for full in [platform.python_version(), *others]]

def holds(need):
    return not need.marker or any(map(need.marker.evaluate, pythons))

any_version = sys.argv[2:]
needs = [Requirement(line) for line in json.load(sys.stdin)]
here = list(filter(holds, needs))
print(json.dumps([f"{n.name}{n.specifier}" for n in here if sys.argv[1] == "all" or missing(n)]))
"""

_ASK_TWICE = """
import json, sys
from importlib.metadata import distributions

own = [entry for entry in sys.path if entry.startswith(sys.prefix)]
others = [entry for entry in sys.path if entry not in own]

def lies_in(path, name):
    return any(True for _ in distributions(name=name, path=path))

print(json.dumps([n for n in sys.argv[1:] if lies_in(own, n) and lies_in(others, n)]))
"""


@dataclass(frozen=True)
class Pin:
    """One line."""

    requirement: str  # "numpy==2.5.5 ; python_full_version >= '3.12'"
    groups: frozenset[str]

    @property
    def name(self) -> str:
        """The package."""
        return self.requirement.partition("==")[0].strip()


def read(file: Path) -> list[Pin]:
    """Every pin of `file`."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return [_pin(line) for line in lines if line.strip() and not line.startswith("#")]


def _pin(line: str) -> Pin:
    requirement, _, groups = line.partition("#")
    return Pin(requirement.strip(), frozenset(groups.split()))


def of_groups(file: Path, groups: Iterable[str]) -> list[str]:
    """The requirements of `groups`, markers and all, in the order of `file`."""
    wanted = set(groups)
    return [pin.requirement for pin in read(file) if pin.groups & wanted]


def names_of(file: Path, group: str) -> set[str]:
    """The packages of `group`, on whatever Python."""
    return {pin.name for pin in read(file) if group in pin.groups}


def exact(file: Path, group: str) -> dict[str, str]:
    """Name -> version of a group whose pins hold for every Python.

    Raises:
        LauncherTrouble: the group is empty.
    """
    found = dict(line.split("==") for line in of_groups(file, [group]))
    if not found:
        raise LauncherTrouble(
            f"constraints.txt pins nothing for {group}.", "Write it: ./roslings pins"
        )
    return found


def applying(python: Path, requirements: Sequence[str], environment: dict[str, str]) -> list[str]:
    """`name==version` of those that hold for `python`, installed or not.

    For any release of it: a folder of wheels made by 3.11.7 is to do for 3.11.2 as well.
    """
    return _ask(python, requirements, environment, "all")


def missing(
    python: Path,
    requirements: Sequence[str],
    environment: dict[str, str],
    any_version: Iterable[str] = (),
) -> list[str]:
    """`name==version` of those that hold for `python` and that it does not see in that version.

    Of `any_version` it may see any.
    """
    return _ask(python, requirements, environment, "missing", *any_version)


def seen_twice(python: Path, names: Iterable[str], environment: dict[str, str]) -> list[str]:
    """Those of `names` that `python` has in its own environment and sees outside of it, too."""
    return _told([python, "-c", _ASK_TWICE, *names], environment, "")


def _ask(
    python: Path, requirements: Sequence[str], environment: dict[str, str], *words: str
) -> list[str]:
    return _told([python, "-c", _ASK, *words], environment, json.dumps(list(requirements)))


def _told(command: Sequence[str | Path], environment: dict[str, str], said: str) -> list[str]:
    done = subprocess.run(
        command,
        cwd=os.sep,  # where no file of a student's can stand in for a module
        env=environment,
        input=said,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["nothing said"])[-1]
        raise LauncherTrouble(
            f"constraints.txt could not be read: {last}", "Write it: ./roslings pins"
        )
    found: list[str] = json.loads(done.stdout)
    return found
