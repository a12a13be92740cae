"""Build the site: gather the course's pages in one folder, and let Sphinx make HTML of them.

    python site/build.py [--fresh] [--links | --check-links] [--out DIR]

`./roslings site` runs this. The course is the clone that this file is in, or ROSLINGS_COURSE.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *map(str, HERE.parent.glob("packages/*/src"))]

from course_site.gather import Gathered, gather  # noqa: E402  found by the line above
from course_site.links import external_links  # noqa: E402

from roslings.built_site import forget, note_texts  # noqa: E402
from roslings.course import CourseError, root  # noqa: E402
from roslings_launcher.progress import going_on  # noqa: E402
from roslings_learn.lessons import BadLessons  # noqa: E402

OK, FAILED = 0, 1
STEP = re.compile(r"(reading sources|writing output)\.\.\. \[ *(\d+%)\] ([^\s\x1b]+)")
STEPS = {"reading sources": "Running the lessons:", "writing output": "Writing the pages:"}


def main(arguments: Sequence[str]) -> int:
    """Build, and say where the site is."""
    options = parser().parse_args(arguments)
    work = options.out.resolve()
    if options.fresh:
        shutil.rmtree(work, ignore_errors=True)
    try:
        gathered = gather(root(), HERE / "pages", work / "source")
    except OSError as error:
        print(f"roslings: {work} cannot be written: {error.strerror}.", file=sys.stderr)
        print("Next: give another folder, with --out DIR.", file=sys.stderr)
        return FAILED
    except (BadLessons, CourseError) as error:
        print(f"roslings: the site was not built.\n{error}", file=sys.stderr)
        return FAILED
    if options.links:
        print("\n".join(external_links(work / "source")))
        return OK
    if options.check_links:
        return sphinx("linkcheck", work, gathered)
    return build(work, gathered)


def build(work: Path, gathered: Gathered) -> int:
    """Make the HTML; the folder `html` can be copied to a USB stick as it is."""
    if sphinx("html", work, gathered):
        print("roslings: the site was not built. Mend what is named above.", file=sys.stderr)
        return FAILED
    forget(work / "html")
    note_texts(work / "html", root())
    return OK


def sphinx(builder: str, work: Path, gathered: Gathered) -> int:
    """Run Sphinx, every warning an error, and name the files as the author knows them."""
    words = [
        *(sys.executable, "-u", "-m", "sphinx", "-N", "-n", "-W", "--keep-going"),
        *("-b", builder, "-c", str(HERE), "-d", str(work / "doctrees")),
        *(str(work / "source"), str(work / builder)),
    ]
    if builder == "html":
        code, said = watched(words)
    else:
        done = subprocess.run(
            [*words, "-q"], env=environment(), text=True, capture_output=True, check=False
        )
        code, said = done.returncode, done.stdout + done.stderr
    if code or builder != "html":  # else it is the notebooks' kernels that talk
        print(gathered.in_the_authors_words(said), end="", file=sys.stderr)
    return code


def watched(words: Sequence[str]) -> tuple[int, str]:
    """Run Sphinx and show how far it is; its exit code, and what it complained of."""
    at = "Reading what the course says"

    def told() -> str:
        return f"Building the site. {at}"

    with (
        tempfile.TemporaryFile("w+", encoding="utf-8") as complaints,
        subprocess.Popen(
            words,
            env=environment(),
            stdout=subprocess.PIPE,
            stderr=complaints,
            text=True,
            encoding="utf-8",
            errors="replace",
        ) as running,
        going_on(told),
    ):
        assert running.stdout
        for line in running.stdout:
            at = place_in(line) or at
        code = running.wait()
        complaints.seek(0)
        return code, complaints.read()


def place_in(line: str) -> str:
    """How far Sphinx is, of a line that says it; empty for another line.

    Reading a lesson runs its cells: that takes nearly all of the time.
    """
    found = STEP.match(line)
    return f"{STEPS[found[1]]} {found[2]} ({found[3]})" if found else ""


def environment() -> dict[str, str]:
    """This one, for lessons whose nodes stay on this computer."""
    kept = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    return {**kept, **os.environ, "ROSLINGS_COURSE": str(root())}


def parser() -> argparse.ArgumentParser:
    """The options."""
    words = argparse.ArgumentParser(
        prog="./roslings site", description="Build the course's site.", allow_abbrev=False
    )
    words.add_argument("--fresh", action="store_true", help="build all of it anew")
    words.add_argument("--links", action="store_true", help="list the links to other sites")
    words.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    words.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        default=root() / "build" / "site",
        help="where to build (default: build/site)",
    )
    return words


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
