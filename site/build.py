"""Build the site: gather the course's pages in one folder, and let Sphinx make HTML of them.

    python site/build.py [--fresh] [--links | --check-links | --catalogue] [--language LANG]
                         [--out DIR]

`./roslings site` runs this. In another language, what cells print is taken from the English site
where that was built, since code is the same in each; and the site lies in a folder of its own.
`--catalogue` writes what a translator fills in, and brings it up to date. The course is the clone
that this file is in, or ROSLINGS_COURSE.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *map(str, HERE.parent.glob("packages/*/src"))]

from course_site.gather import Gathered, gather  # noqa: E402  found by the line above
from course_site.links import external_links  # noqa: E402

from ros2_on_pip.errors import RoslingsError  # noqa: E402
from ros2_on_pip.language import (  # noqa: E402
    ENGLISH,
    FALSE,
    FOLDER,
    NAME,
    VARIABLE,
    language,
    named,
    speak,
)
from roslings.commands.built_site import forget, note_texts  # noqa: E402
from roslings.course import root  # noqa: E402
from roslings_launcher.progress import going_on  # noqa: E402

OK, FAILED = 0, 1
LANGUAGES = root() / "site" / FOLDER
LOCALES = "locales"
"""In the folder of a build: what Sphinx reads of the language."""
DOCTREES = {"gettext": "doctrees-gettext"}
"""Where a builder has pages of its own: these are not run, and are English."""
STEP = re.compile(r"(reading sources|writing output)\.\.\. \[ *(\d+%)\] ([^\s\x1b]+)")
STEPS = {"reading sources": "Running the lessons:", "writing output": "Writing the pages:"}


def main(arguments: Sequence[str]) -> int:
    """Build, and say where the site is."""
    options = parser().parse_args(arguments)
    speak(options.language or language())
    work = (options.out or place_of(language())).resolve()
    if options.fresh:
        shutil.rmtree(work, ignore_errors=True)
    try:
        return made(work, options)
    except RoslingsError as error:
        print(f"roslings: the site was not built.\n{error}", file=sys.stderr)
        return FAILED


def place_of(name: str) -> Path:
    """Where the site in a language is built."""
    return root() / "build" / ("site" if name == ENGLISH else f"site-{name}")


def made(work: Path, options: argparse.Namespace) -> int:
    """Do what was asked for. Raises RoslingsError."""
    if options.catalogue:
        return catalogue(work)
    gathered = gathered_in(work)
    if options.links:
        print("\n".join(external_links(work / "source")))
        return OK
    if options.check_links:
        return sphinx("linkcheck", work, gathered)
    return translated(work, gathered) or build(work, gathered)


def gathered_in(work: Path) -> Gathered:
    """All pages of the course, in a folder. Raises RoslingsError."""
    try:
        return gather(root(), HERE / "pages", work / "source")
    except OSError as error:
        what = f"{work} cannot be written: {error.strerror}."
        raise RoslingsError(f"{what}\nNext: give another folder, with --out DIR.") from error


def catalogue(work: Path) -> int:
    """Write a translator's files, and say where they are. Raises RoslingsError."""
    wanted = language()
    if wanted in (ENGLISH, FALSE):
        raise NoTranslation("A catalogue is for another language.", "de")
    speak(ENGLISH)
    gathered = gathered_in(work)
    if sphinx("gettext", work, gathered):
        return FAILED
    from course_site import po_files, translators  # Babel and the graders: few need them

    po_files.merge(work / "gettext", LANGUAGES, wanted)
    print(*translators.write_texts(root(), wanted), sep="\n")
    print(f"The pages: {LANGUAGES / wanted / po_files.MESSAGES}")
    return OK


def translated(work: Path, gathered: Gathered) -> int:
    """Make what Sphinx reads of a language; the exit code of what was run. Raises RoslingsError."""
    wanted = language()
    if wanted == ENGLISH:
        return OK
    from course_site import po_files, translators

    if wanted == FALSE:
        code = sphinx("gettext", work, gathered)
        return code or po_files.write_false(work / "gettext", work / LOCALES)
    if not (LANGUAGES / wanted).is_dir():
        raise NoTranslation(f"There is no translation into {wanted!r} yet.", wanted)
    translators.require_known(root(), wanted)
    po_files.compile_all(LANGUAGES, work / LOCALES, wanted)
    return OK


class NoTranslation(RoslingsError):
    """There is none; how one begins."""

    def __init__(self, what: str, name: str) -> None:
        super().__init__(f"{what}\nNext: ./roslings site --catalogue --language {name}")


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
        *("-b", builder, "-c", str(HERE), "-d", str(work / DOCTREES.get(builder, "doctrees"))),
        *(("-D", "nb_execution_mode=off") if builder == "gettext" else ()),
        *(str(work / "source"), str(work / builder)),
    ]
    if builder == "html":
        code, said = watched(words, environment(work))
    else:
        done = subprocess.run(
            [*words, "-q"],
            env=environment(work, builder),
            text=True,
            capture_output=True,
            check=False,
        )
        code, said = done.returncode, done.stdout + done.stderr
    if code or builder == "linkcheck":  # else it is the notebooks' kernels that talk
        print(gathered.in_the_authors_words(said), end="", file=sys.stderr)
    return code


def watched(words: Sequence[str], given: Mapping[str, str] | None = None) -> tuple[int, str]:
    """Run Sphinx and show how far it is; its exit code, and what it complained of."""
    at = "Reading what the course says"

    def told() -> str:
        return f"Building the site. {at}"

    with (
        tempfile.TemporaryFile("w+", encoding="utf-8") as complaints,
        subprocess.Popen(
            words,
            env=given,
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


def environment(work: Path, builder: str = "html") -> dict[str, str]:
    """This one, for lessons whose nodes stay on this computer. Texts are taken out in English."""
    wanted = ENGLISH if builder == "gettext" else language()
    kept = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    ours = {"ROSLINGS_COURSE": str(root()), VARIABLE: wanted}
    if wanted != ENGLISH:
        ours["ROSLINGS_LOCALES"] = str(work / LOCALES)
        ours["ROSLINGS_CELLS"] = str(place_of(ENGLISH) / ".jupyter_cache")
    return {**kept, **os.environ, **ours}


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
        "--catalogue", action="store_true", help="write the texts that a translator fills in"
    )
    words.add_argument(
        "--language",
        metavar="LANG",
        type=language_named,
        help="in which language (default: that of ROSLINGS_LANGUAGE, or English)",
    )
    words.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        help="where to build (default: build/site, or build/site-LANG)",
    )
    return words


def language_named(text: str) -> str:
    """A language's name. Raises ArgumentTypeError."""
    if NAME.fullmatch(text):
        return named(text)
    raise argparse.ArgumentTypeError(f"{text!r} is no language: write it as de, or pt_BR")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
