"""Which files an edition for others is made from: what git keeps, each lab, and what grades it.

A lab that is not committed yet is a lab all the same: `check` and `export` see it, and so does
`release`. What else is not committed stays out: it may be a list of students. Both is told.

A course may lie outside of the engine's own folder, with capabilities in packages of their own.
An edition holds these too: it works for somebody who installs nothing else.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from ros2_on_pip.typed_paths import shown
from roslings import course
from roslings.course import CourseError
from roslings.course.labs import EXAMPLE, all_labs, engine_root
from roslings.workspace.sources import files
from roslings_class.outside import packages_of_capabilities

ENGINE = PurePosixPath("packages/roslings/src/roslings")
ENGINES_OWN = (
    "roslings",
    "setup.bash",
    "pyproject.toml",
    "constraints.txt",
    "LICENSE",
    "LICENSE-lessons.md",
    "packages",
    EXAMPLE,
)
"""What a course outside of the engine's folder gets from there."""
MOST_NAMED = 6


class CannotCollect(CourseError):
    """What belongs to the course cannot be told."""


@dataclass(frozen=True)
class CourseFiles:
    """Files of the course, by the name that each gets in an edition."""

    paths: dict[str, Path]
    not_committed: list[str] = field(default_factory=list)
    """Those of `paths` that git does not keep yet."""
    left_out: list[str] = field(default_factory=list)
    """What lies there besides, and git does not keep."""
    brought: list[str] = field(default_factory=list)
    """Packages with capabilities, that come along."""

    def remarks(self, used: Iterator[str] | list[str]) -> Iterator[str]:
        """What is to be known of an edition that holds `used`."""
        names = set(used)
        if taken := [name for name in self.not_committed if name in names]:
            yield f"Not committed yet, and in it as it is now: {_few(taken)}."
        if self.left_out:
            yield f"Not committed, and not in it: {_few(self.left_out)}."
            yield "What belongs to the course: git add it, then do this again."
        if self.brought:
            yield f"In it, too, with what the labs need of it: {', '.join(self.brought)}."


def course_files() -> CourseFiles:
    """All that an edition may be made from. Raises CannotCollect."""
    root = course.root()
    kept = _kept_by_git(root)
    if kept is None:
        paths = {name: path for name, path in files(root).items() if path.is_file()}
        return _whole(CourseFiles(paths))
    others = _listed(root, "--others", "--exclude-standard")
    labs = [name for name in others if _is_of_a_lab(name)]
    paths = {name: root / name for name in (*kept, *labs) if (root / name).is_file()}
    return _whole(CourseFiles(paths, labs, [name for name in others if name not in labs]))


def _is_of_a_lab(name: str) -> bool:
    path = course.root() / name
    return any(
        path == lab.grader or path.is_relative_to(lab.folder) or path.is_relative_to(lab.beside)
        for lab in all_labs()
    )


def _whole(own: CourseFiles) -> CourseFiles:
    """With the engine and the capabilities, where they lie elsewhere."""
    engine = {} if course.root() == engine_root() or _has_engine(own.paths) else _of_engine()
    found = packages_of_capabilities(course.root() / "packages")
    capabilities = {name: path for each in found for name, path in each.files.items()}
    return CourseFiles(
        {**engine, **capabilities, **own.paths},
        own.not_committed,
        own.left_out,
        [each.name for each in found],
    )


def _has_engine(paths: dict[str, Path]) -> bool:
    return (ENGINE / "__init__.py").as_posix() in paths


def _of_engine() -> dict[str, Path]:
    root = engine_root()
    if not (root / "roslings").is_file():
        raise CannotCollect(
            "This course has no engine in its folder, and the engine that runs now came by pip.\n"
            "Next: make a folder of the engine by `roslings new`, and run its ./roslings:\n"
            f"  ROSLINGS_COURSE={course.root()} roslings-course/roslings ..."
        )
    kept = _kept_by_git(root)
    names = files(root) if kept is None else kept
    return {
        name: root / name
        for name in names
        if PurePosixPath(name).parts[0] in ENGINES_OWN and (root / name).is_file()
    }


# --- git ---------------------------------------------------------------------------------------


def _kept_by_git(root: Path) -> list[str] | None:
    """What git keeps of a folder; None where it keeps nothing there. Raises CannotCollect."""
    if not any((folder / ".git").exists() for folder in (root, *root.parents)):
        return None
    return _listed(root, "--cached") or None


def _listed(root: Path, *which: str) -> list[str]:
    try:
        listed = subprocess.run(
            ["git", "ls-files", "-z", *which], cwd=root, capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        raise CannotCollect(
            f"{shown(root)} is a clone, and there is no git here to say what belongs to it.\n"
            "Install it: sudo apt install git"
        ) from None
    if listed.returncode:
        said = listed.stderr.strip()
        raise CannotCollect(f"git does not say what belongs to {shown(root)}:\n{said}")
    return [name for name in listed.stdout.split("\0") if name]


def _few(names: list[str]) -> str:
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return f"{', '.join(names[:MOST_NAMED])}{more}"
