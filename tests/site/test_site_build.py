"""The builder: strict, quick to say what is wrong, and no answer lies open in a page."""

from __future__ import annotations

import io
import json
import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest
from site_rules import HEAVIEST_BYTES, weight_bytes
from two_days_site import BUILDER, build

from roslings.commands.built_site import is_up_to_date
from roslings_launcher import progress

PAGE = "days/01-install/lesson.ipynb"


def change_lesson(course: Path, source: str, cell: int = 0) -> None:
    """Write another text into a cell of day 1."""
    path = course / PAGE
    notebook = json.loads(path.read_text("utf-8"))
    notebook["cells"][cell]["source"] = source
    path.write_text(json.dumps(notebook), "utf-8")


WRONG = {
    "A [robot](#word-robto).": "There is no word 'robto'",
    "## A [node](#word-node)": "A heading is no place",
    "[There](../no-such-page.md).": "no-such-page",
    "[There](#no-such-place).": "no-such-place",
    "{wrod}`node`": "wrod",
    "```{math}\na = b\n```": "shows no formulas",
}


@pytest.mark.slow
def test_each_wrong_thing_on_a_page_ends_the_build(course: Path) -> None:
    """All are told at once, with the name of the file that the author knows."""
    change_lesson(course, "# Day 1\n\n" + "\n\n".join(WRONG))
    done = build(course)
    assert done.returncode == 1
    assert [told for told in WRONG.values() if told not in done.stderr] == []
    assert str(course / PAGE) in done.stderr
    assert str(course / "out" / "source") not in done.stderr


@pytest.mark.slow
def test_a_failing_notebook_ends_the_build(course: Path) -> None:
    """What the page shows must have happened."""
    change_lesson(course, "print(1 / 0)", cell=2)
    done = build(course)
    assert done.returncode == 1
    assert "ZeroDivisionError" in done.stderr


def test_a_wrong_quiz_ends_the_build_before_sphinx(course: Path) -> None:
    """File, line and mend, nothing else."""
    quiz = course / "days/03-topics/quiz.yaml"
    quiz.write_text(quiz.read_text("utf-8").replace("#word", "#w").replace("right: true", ""))
    done = build(course)
    assert done.returncode == 1
    assert re.search(r"quiz\.yaml:\d+: .*no right answer", done.stderr)
    assert "Mend: Add 'right: true'" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_links_to_other_sites_are_listed(course: Path) -> None:
    """On request, with the pages that name them."""
    done = build(course, "--links")
    assert done.returncode == 0
    assert "https://docs.ros.org/en/jazzy/  (days/03-topics/index.ipynb" in done.stdout


@pytest.mark.slow
def test_a_link_to_a_lesson_leads_to_its_page(site: Path) -> None:
    """In JupyterLab a lesson is a file; here it is the first page of its day."""
    days = site / "days"
    third = (days / "03-topics" / "index.html").read_text("utf-8")
    assert 'href="../01-install/index.html"' in third
    assert 'href="../01-install/page.html"' in third
    assert 'href="index.html"' in (days / "01-install" / "page.html").read_text("utf-8")


def test_no_answer_lies_open_in_a_page(site: Path) -> None:
    """Neither as an attribute nor as text; the page of answers is not in the search."""
    page = (site / "days/01-install/quiz.html").read_text("utf-8")
    assert "Sourcing changes the variables" not in page
    choices = re.findall(r'<input type="(?:radio|checkbox)"[^>]*>', page)
    assert (
        len({re.sub(r'value="\d"', "", choice) for choice in choices}) == 4
    )  # two are the theme's
    assert "Sourcing changes" not in (site / "searchindex.js").read_text("utf-8")
    answers = (site / "days/01-install/answers.html").read_text("utf-8")
    assert "Sourcing changes the variables" in answers


def test_a_page_with_a_notebook_weighs_at_most_200_kb(site: Path) -> None:
    """Without pictures; all that the page loads, before compression."""
    page = site / "days/01-install/index.html"
    assert len(page.read_bytes()) < weight_bytes(page) <= HEAVIEST_BYTES


def test_the_site_knows_what_it_was_made_of(site: Path) -> None:
    """So `./roslings site` can tell that the course has changed since."""
    course = site.parents[1]
    assert is_up_to_date(site, course)


# --- how far it is ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def builder() -> ModuleType:
    """The program site/build.py."""
    spec = spec_from_file_location("site_builder", BUILDER)
    assert spec and spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("line", "place"),
    [
        (
            "reading sources... [  3%] days/01-install/index\n",
            "Running the lessons: 3% (days/01-install/index)",
        ),
        ("reading sources... [100%] labs/topics", "Running the lessons: 100% (labs/topics)"),
        ("writing output... [ 50%] glossary", "Writing the pages: 50% (glossary)"),
        ("copying images... [ 50%] glossary", ""),
        ("looking for now-outdated files... none found", ""),
        ("", ""),
    ],
)
def test_how_far_the_build_is(builder: ModuleType, line: str, place: str) -> None:
    """As Sphinx says it."""
    assert builder.place_in(line) == place


def test_a_long_build_says_again_and_again_how_far_it_is(
    builder: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """And hands on its exit code and what it complained of."""
    seen = tmp_path / "seen"

    class Screen(io.StringIO):
        """Says to the program when somebody has read how far it is."""

        def write(self, text: str) -> int:
            if "Running the lessons: 7% (days/x)" in text:
                seen.touch()
            return super().write(text)

    program = (
        "import os, sys, time\n"
        "print('reading sources... [  7%] days/x', flush=True)\n"
        "for _ in range(6000):\n"
        f"    if os.path.exists({str(seen)!r}): break\n"
        "    time.sleep(0.01)\n"
        "sys.exit(print('WARNING: no such word', file=sys.stderr) or 3)\n"
    )
    monkeypatch.setattr(progress, "_PLAIN_EVERY_S", 0.01)
    monkeypatch.setattr(sys, "stderr", Screen())
    assert builder.watched([sys.executable, "-c", program]) == (3, "WARNING: no such word\n")
