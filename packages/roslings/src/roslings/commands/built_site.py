"""The course as a website: where it lies, whether the course has changed since, what it may show.

Standard library only: a site that is built opens where nothing is installed.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import roslings
from ros2_on_pip.language import ENGLISH, FOLDER, language, named
from roslings import course
from roslings.commands.way import drills_there
from roslings.folders.course_folder import engine_root
from roslings.workspace.progress import read_progress

BUILT_HERE, BROUGHT = Path("build/site/html"), Path("site/html")
"""Where `./roslings site` builds it, and where the students' edition brings it."""
HOME = "index.html"
RECORD = "made-of.txt"
"""In the site: what the course's texts were when it was made."""
TEXTS = (
    "days/**/*",
    "glossary/*",
    "site/**/*",
    "labs/*/task.md",
    "labs/*/card.yaml",
    "labs/*/pictures/*",
    "packages/*/src/*/COMMANDS.md",
)
NO_TEXT = ("__pycache__", "html", ".ipynb_checkpoints")
SCRIPT = "_static/progress.js"
TELLS = "roslings.tell("


def site_here() -> Path | None:
    """The folder of the site: the one that was built here, else the one that came along.

    In another language, the one that was built here in it goes before both.
    """
    places = (built_in(language()), *(course.root() / each for each in (BUILT_HERE, BROUGHT)))
    return next((place for place in places if (place / HOME).is_file()), None)


def built_in(name: str) -> Path:
    """Where the site in a language is built."""
    if named(name) == ENGLISH:
        return course.root() / BUILT_HERE
    return course.root() / "build" / f"site-{named(name)}" / "html"


def language_folders() -> Iterator[Path]:
    """Where texts in other languages lie: the engine's own beside it, a course's with its site.

    An entry point of the group `ros2_on_pip.languages`.
    """
    yield Path(roslings.__file__).with_name(FOLDER)
    yield from {each / "site" / FOLDER for each in (engine_root(), course.root())}


def note_texts(html: Path, root: Path) -> None:
    """Write down what the site in `html` was made of. Raises OSError."""
    (html / RECORD).write_text(f"{digest(root)}\n", "utf-8")


def is_up_to_date(html: Path, root: Path) -> bool:
    """Whether the site shows the course's texts as they now are."""
    try:
        return (html / RECORD).read_text("utf-8").strip() == digest(root)
    except (OSError, UnicodeDecodeError):
        return False


def digest(root: Path) -> str:
    """Of the name and the content of each text."""
    whole = hashlib.sha256()
    for name, path in sorted(_texts(root)):
        whole.update(f"{name}\0{hashlib.sha256(path.read_bytes()).hexdigest()}\n".encode())
    return whole.hexdigest()


def _texts(root: Path) -> Iterator[tuple[str, Path]]:
    for path in (path for pattern in TEXTS for path in root.glob(pattern)):
        name = path.relative_to(root)
        if path.is_file() and not set(NO_TEXT) & set(name.parts):
            yield name.as_posix(), path


# --- what this computer knows of its student -----------------------------------------------------


def yours(workspace: Path) -> dict[str, Any]:
    """Lab to its best score, and day to how many of its drills are done. Raises CannotRead."""
    kept = read_progress(workspace)
    there = drills_there()
    done = Counter(
        day for day, name in there if name in kept.drills and kept.drills[name].passed_at
    )
    return {
        "labs": {
            name: {"score": lab.best, "passed": lab.done}
            for name, lab in kept.labs.items()
            if lab.checks
        },
        "drills": {day: [done[day], of] for day, of in Counter(day for day, _ in there).items()},
    }


def tell(html: Path, workspace: Path) -> None:
    """Put it into the site in the folder `html`, in place of what was told before.

    Only a site that is opened here holds it; `forget` takes it out. Raises CannotRead and OSError.
    """
    _end_script(html, f"\n{TELLS}{json.dumps(yours(workspace))});\n")


def forget(html: Path) -> None:
    """Leave nothing of anybody in a site that may be published. Raises OSError."""
    _end_script(html, "")


def _end_script(html: Path, end: str) -> None:
    script = html / SCRIPT
    before = script.read_text("utf-8")
    after = before.partition(f"\n{TELLS}")[0].rstrip("\n") + "\n" + end
    if after != before:
        script.write_text(after, "utf-8")
