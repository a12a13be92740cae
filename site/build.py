"""Build the site: gather the course's pages in one folder, and let Sphinx make HTML of them.

    python site/build.py [--open] [--fresh] [--links | --check-links] [--out DIR]

`./roslings site` runs this. The course is the clone that this file is in, or ROSLINGS_COURSE.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *map(str, HERE.parent.glob("packages/*/src"))]

from course_site.gather import Gathered, gather  # noqa: E402  found by the line above
from course_site.links import external_links  # noqa: E402
from course_site.yours import tell  # noqa: E402

from roslings.course import CourseError, root  # noqa: E402
from roslings.workspace.errors import WorkspaceError  # noqa: E402
from roslings.workspace.student import workspace_root  # noqa: E402
from roslings_learn.lessons import BadLessons  # noqa: E402

OK, FAILED = 0, 1


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
    return build(work, gathered, options.open)


def build(work: Path, gathered: Gathered, open_it: bool) -> int:
    """Make the HTML; the folder `html` can be copied to a USB stick as it is."""
    if sphinx("html", work, gathered):
        print("roslings: the site was not built. Mend what is named above.", file=sys.stderr)
        return FAILED
    home = work / "html" / "index.html"
    print(f"The site is built: {home}")
    if open_it:
        show_yours(home.parent)
        webbrowser.open(home.as_uri())
    else:
        print("Open this file in a browser, or run: ./roslings site --open")
    return OK


def show_yours(html: Path) -> None:
    """Labs and drills of this computer's student; without them the site is as good."""
    try:
        tell(html, workspace_root())
    except (WorkspaceError, CourseError, OSError) as error:
        print(f"roslings: the site cannot show what you have done. {error}", file=sys.stderr)


def sphinx(builder: str, work: Path, gathered: Gathered) -> int:
    """Run Sphinx, every warning an error, and name the files as the author knows them."""
    done = subprocess.run(
        [
            *(sys.executable, "-m", "sphinx", "-q", "-n", "-W", "--keep-going"),
            *("-b", builder, "-c", str(HERE), "-d", str(work / "doctrees")),
            *(str(work / "source"), str(work / builder)),
        ],
        env=environment(),
        text=True,
        capture_output=True,
        check=False,
    )
    if done.returncode or builder != "html":  # else it is the notebooks' kernels that talk
        said = gathered.in_the_authors_words(done.stdout + done.stderr)
        print(said, end="", file=sys.stderr)
    return done.returncode


def environment() -> dict[str, str]:
    """This one, for lessons whose nodes stay on this computer."""
    kept = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    return {**kept, **os.environ, "ROSLINGS_COURSE": str(root())}


def parser() -> argparse.ArgumentParser:
    """The options."""
    words = argparse.ArgumentParser(
        prog="./roslings site", description="Build the course's site.", allow_abbrev=False
    )
    words.add_argument("--open", action="store_true", help="open it in the browser")
    words.add_argument("--fresh", action="store_true", help="build all of it anew")
    words.add_argument("--links", action="store_true", help="list the links to other sites")
    words.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    words.add_argument(
        "--out", metavar="DIR", type=Path, default=root() / "build" / "site",
        help="where to build (default: build/site)",
    )  # fmt: skip
    return words


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
