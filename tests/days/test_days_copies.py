"""`./roslings lab`: the student's own copies, the right day, the right kernel."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from tiny_course import DAY, write_course

from roslings_learn.jupyter.choosing import chosen_day, place_for
from roslings_learn.jupyter.copies import Copies
from roslings_learn.jupyter.errors import NoHub, NoSuchDay, NotWritten
from roslings_learn.jupyter.meanings import with_meanings
from roslings_learn.jupyter.server import (
    JupyterOptions,
    command,
    environment,
    open_lab,
    write_kernel,
)
from roslings_learn.jupyter.unrun import unrun
from roslings_learn.lessons import Day, read_lessons
from sources import python_path

LESSON = "/lab/workspaces/01-lamp/tree/ws/notebooks/01-lamp/lesson.ipynb"


@pytest.fixture
def copies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Copies:
    """The tiny course, and a workspace in the home, which is not there yet."""
    monkeypatch.setenv("HOME", str(tmp_path))
    write_course(tmp_path / "course")
    lessons = read_lessons(tmp_path / "course")
    return Copies(tmp_path / "course", tmp_path / "ws", lessons.glossary)


def days_of(copies: Copies) -> tuple[Day, ...]:
    """The path of days."""
    return read_lessons(copies.course).days


def as_opened(lesson: Path, copies: Copies) -> bytes:
    """The course's lesson, its words with their meanings."""
    return unrun(with_meanings(lesson.read_bytes(), copies.glossary))


def test_a_word_brings_its_meaning(copies: Copies) -> None:
    """As a title, which JupyterLab shows; every word that the lesson links."""
    lesson = copies.course / "days" / DAY / "lesson.ipynb"
    word = next(iter(copies.glossary.by_id.values()))
    book = json.loads(lesson.read_text("utf-8"))
    book["cells"][0]["source"] = f"A [thing](#word-{word.id}) and [none](#word-no-such)."
    told = with_meanings(json.dumps(book).encode(), copies.glossary)
    source = json.loads(told)["cells"][0]["source"]
    assert f'[thing](#word-{word.id} "{word.title}: ' in source
    assert source.endswith("and [none](#word-no-such).")


def test_a_student_sees_no_output_before_running_a_cell(copies: Copies) -> None:
    """The course's lesson holds those that are compared: they would answer its questions."""
    copies.copy_all(days_of(copies))
    theirs = json.loads((copies.course / "days" / DAY / "lesson.ipynb").read_text("utf-8"))
    own = json.loads((copies.folder / DAY / "lesson.ipynb").read_text("utf-8"))
    kept = [
        [c["outputs"] or c["execution_count"] for c in book["cells"] if "outputs" in c]
        for book in (theirs, own)
    ]
    assert any(kept[0]) and not any(kept[1])


def test_the_first_time_all_is_copied(copies: Copies) -> None:
    """Lesson, pictures, pages, what it starts, and a list of the days, those to come too."""
    (copies.course / "days" / DAY / "first-look.md").write_text("# The first look\n\nLook.\n")
    (copies.course / "days" / DAY / "two.launch.xml").write_text("<launch/>\n")
    assert copies.copy_all(days_of(copies)) == []
    own = copies.folder / DAY / "lesson.ipynb"
    theirs = copies.course / "days" / DAY / "lesson.ipynb"
    assert own.read_bytes() == as_opened(theirs, copies)
    assert (copies.folder / DAY / "pictures" / "lamp.svg").is_file()
    assert (copies.folder / DAY / "two.launch.xml").read_text("utf-8") == "<launch/>\n"
    listed = (copies.folder / "Days.md").read_text("utf-8")
    assert "[Day 1: A lamp](01-lamp/lesson.ipynb)" in listed
    assert "Day 2: A motor (to come)" in listed
    assert "Begin with [The first look](01-lamp/first-look.md)." in listed
    assert (copies.folder / DAY / "first-look.md").is_file()


def test_what_a_lesson_links_to_lies_where_its_copy_looks(copies: Copies) -> None:
    """A reference page, and a lab's task with its picture: what has no day is one folder nearer."""
    page = copies.course / "site" / "pages" / "reference" / "robots.md"
    task = copies.course / "labs" / "lamp" / "task.md"
    picture = task.parent / "pictures" / "works.svg"
    for file, text in ((page, "# Robots\n"), (task, "# A lamp\n"), (picture, "<svg/>")):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")
    own = copies.folder / DAY
    more = copies.course / "days" / DAY / "more.md"
    links = ["../../site/pages/reference/robots.md#legs", "../../labs/lamp/task.md", "lesson.ipynb"]
    more.write_text("".join(f"[it]({link})\n" for link in links), "utf-8")
    copies.copy_all(days_of(copies))
    found = re.findall(r"\((.+?)(?:#\w+)?\)", (own / "more.md").read_text("utf-8"))
    assert len(found) == len(links) and all((own / link).is_file() for link in found)
    assert (own / "../labs/lamp/pictures/works.svg").is_file()


def test_work_is_never_overwritten(copies: Copies) -> None:
    """Not where the lesson stayed, and not where it changed: then both are there, told once."""
    copies.copy_all(days_of(copies))
    own = copies.folder / DAY / "lesson.ipynb"
    own.write_text("my work", "utf-8")
    assert copies.copy_all(days_of(copies)) == []
    lesson = copies.course / "days" / DAY / "lesson.ipynb"
    lesson.write_text(lesson.read_text("utf-8") + "\n", "utf-8")
    (told,) = copies.copy_all(days_of(copies))
    assert "Your work stays" in told and "lesson-2.ipynb" in told
    assert own.read_text("utf-8") == "my work"
    assert own.with_name("lesson-2.ipynb").read_bytes() == as_opened(lesson, copies)
    assert copies.copy_all(days_of(copies)) == []


def test_an_untouched_copy_follows_the_course(copies: Copies) -> None:
    """Nothing was written in it, so nothing is lost."""
    copies.copy_all(days_of(copies))
    lesson = copies.course / "days" / DAY / "lesson.ipynb"
    lesson.write_text(lesson.read_text("utf-8") + "\n", "utf-8")
    assert copies.copy_all(days_of(copies)) == []
    assert (copies.folder / DAY / "lesson.ipynb").read_bytes() == as_opened(lesson, copies)
    assert not (copies.folder / DAY / "lesson-2.ipynb").exists()


def test_a_lost_record_costs_no_work(copies: Copies) -> None:
    """Without it nobody knows what was changed: so all of it was."""
    copies.copy_all(days_of(copies))
    own = copies.folder / DAY / "lesson.ipynb"
    own.write_text("my work", "utf-8")
    (copies.workspace / ".roslings" / "lessons" / f"{DAY}.ipynb").unlink()
    assert len(copies.copy_all(days_of(copies))) == 1
    assert own.read_text("utf-8") == "my work"


@pytest.mark.parametrize("wanted", ["1", "01", "01-lamp", "lamp", None])
def test_a_day_has_several_names(copies: Copies, wanted: str | None) -> None:
    """Number, folder, name; without one, the first day to begin with."""
    day = chosen_day(wanted, days_of(copies), copies)
    assert day is not None and day.id == DAY


def test_a_day_that_cannot_be_opened_is_told(copies: Copies) -> None:
    """One that does not exist, and one that is to come."""
    with pytest.raises(NoSuchDay, match="2  02-motor"):
        chosen_day("9", days_of(copies), copies)
    with pytest.raises(NotWritten, match="Day 2: A motor"):
        chosen_day("2", days_of(copies), copies)


def test_what_the_server_is_told(copies: Copies) -> None:
    """The page, the port, no browser, and this computer alone."""
    place, share = place_for("1", days_of(copies), copies, port=9911, browser=False), Path("share")
    words = command(place, share)
    assert f"--LabApp.default_url={LESSON}" in words
    assert f"--ServerApp.root_dir={copies.workspace.parent}" in words
    assert {"--ServerApp.port=9911", "--ServerApp.port_retries=0", "--no-browser"} <= set(words)
    assert JupyterOptions(copies, None).page == "/lab/tree/ws/notebooks/Days.md"
    assert "--no-browser" not in command(JupyterOptions(copies, None), share)
    assert "--LabApp.app_settings_dir=share/lab/settings" in words


def test_what_a_server_of_jupyterhub_is_told(copies: Copies) -> None:
    """The page; where to listen, and for whom, comes from JupyterHub itself."""
    place = place_for(None, days_of(copies), copies, port=9911, browser=True)
    words = command(replace(place, hub=True, ip="0.0.0.0"), Path("share"))
    assert words[1:3] == ["-m", "jupyterhub.singleuser"]
    assert f"--ServerApp.default_url={LESSON}" in words
    assert not [word for word in words if word.startswith(("--ServerApp.port", "--ServerApp.ip"))]
    assert "--no-browser" not in words


def test_hub_typed_by_a_person_is_refused(copies: Copies, monkeypatch: pytest.MonkeyPatch) -> None:
    """With what belongs into JupyterHub's configuration."""
    monkeypatch.delenv("JUPYTERHUB_SERVICE_URL", raising=False)
    with pytest.raises(NoHub, match=r'c\.Spawner\.cmd = \[".*/roslings", "lab", "--hub"\]'):
        open_lab(JupyterOptions(copies, None, hub=True))


def test_the_kernel_is_the_one_of_this_place(tmp_path: Path) -> None:
    """Written at each start: a clone that was moved gets the new path."""
    for name in ("here", "moved here"):
        assert write_kernel(tmp_path / name, tmp_path / "ws") == tmp_path / name / "share/jupyter"
        note = tmp_path / name / "share" / "jupyter" / "kernels" / "roslings" / "kernel.json"
        assert json.loads(note.read_text())["argv"][0] == str(tmp_path / name / "bin" / "python")
    settings = tmp_path / "here" / "share" / "jupyter" / "lab" / "settings" / "overrides.json"
    news = json.loads(settings.read_text())["@jupyterlab/apputils-extension:notification"]
    assert news == {"fetchNews": "false", "checkForUpdates": False}


def test_an_environment_of_others_is_left_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is right is used; what cannot be written there lies in the workspace."""
    prefix, own = tmp_path / "env", tmp_path / "ws/.roslings/jupyter"
    right = write_kernel(prefix, tmp_path / "ws") / "kernels/roslings/kernel.json"
    before = right.stat().st_mtime_ns
    write_kernel(prefix, tmp_path / "ws")
    assert right.stat().st_mtime_ns == before and not own.exists()
    closed = tmp_path / "closed"
    closed.mkdir()
    (closed / "share").touch()
    assert write_kernel(closed, tmp_path / "ws") == own
    note = json.loads((own / "kernels/roslings/kernel.json").read_text())
    assert note["argv"][0] == str(closed / "bin/python")
    assert (own / "lab/settings/overrides.json").is_file()
    monkeypatch.setenv("JUPYTER_PATH", "/theirs")
    assert environment(own)["JUPYTER_PATH"] == f"{own}:/theirs"
    assert environment(Path(sys.prefix) / "share/jupyter")["JUPYTER_PATH"] == "/theirs"


def test_a_wrong_day_is_wrong_use(copies: Copies) -> None:
    """Exit code 2, no traceback, and nothing is written."""
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "lab", "9", "--no-browser"],
        env={
            **os.environ,
            "PYTHONPATH": python_path(),
            "ROSLINGS_COURSE": str(copies.course),
            "ROSLINGS_WS": str(copies.workspace),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2 and "There is no day '9'" in done.stderr
    assert "Traceback" not in done.stderr and not copies.workspace.exists()
