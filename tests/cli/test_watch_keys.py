"""`watch` on a terminal: one key for each thing that a learner wants next."""

from __future__ import annotations

import re
import shutil
import signal
from pathlib import Path

import pytest
from watch_terminal import watching

from roslings.course import all_labs, lab, root
from roslings_learn.commands.watch.editing import FileLine, editor_for, first_to_do, is_there
from roslings_learn.drills import all_drills

EDITOR = """#!/bin/sh
echo "# edited" >> "$1"
"""


TIME = re.compile(r"\b\d+\.\d s\b")


def in_the_readme(first: str) -> list[str]:
    """The lines of the block that begins so; `...` stands for what it leaves out."""
    readme = (root() / "README.md").read_text("utf-8")
    (block,) = re.findall(rf"^```text\n({first}.*?)^```$", readme, re.M | re.S)
    return [line for line in block.splitlines() if line not in ("", "...")]


def without_times(lines: list[str]) -> list[str]:
    """How long something took is another story each time."""
    return [TIME.sub("... s", line).rstrip() for line in lines if line.strip()]


def with_editor(home: Path) -> Path:
    """A home whose editor writes a line and ends."""
    editor = home / "editor"
    editor.write_text(EDITOR)
    editor.chmod(0o755)
    return home


@pytest.mark.slow
def test_without_a_name_todays_drill_is_opened_and_then_the_next(tmp_path: Path) -> None:
    """The program that is mended makes place for the next one, by itself."""
    first, second = all_drills()[:2]
    with watching(with_editor(tmp_path)) as watch:
        wrong = re.escape(first.card.starter.names)
        said = watch.shows(rf"(?s)Drill 1 of .*{first.name} .*{wrong}.*q quit\n")
        assert without_times(said.splitlines()) == without_times(in_the_readme("Labs "))
        watch.press("h")
        watch.shows(f"Hint 1 of 3 for {first.name}")
        watch.press("r")
        watch.shows(rf"(?s){wrong}.*Save a file")
        watch.press("n")
        watch.shows("is not done yet")
        file = tmp_path / "roslings_ws" / "drills" / first.day / first.file_name
        shutil.copyfile(first.solution, file)
        watch.shows(rf"(?s)it does all that is asked.*Drill 2 of .*{second.name} .*Save a")
        assert (file.parent / second.file_name).is_file()
        watch.press("q")


@pytest.mark.slow
@pytest.mark.parametrize("name", [all_drills()[0].name, "nodes"])
def test_plain_is_lines_only(name: str, tmp_path: Path) -> None:
    """On a terminal, too: no colours, no keys, nothing that moves; Ctrl-C ends it well."""
    with watching(tmp_path, name, "--plain") as watch:
        said = watch.shows("Watching. Save a file to check again; Ctrl-C ends it.")
        assert not watch.moves and "h hint" not in said
        assert not set(said) & set("╭╮╰╯│─")
        watch.process.send_signal(signal.SIGINT)


@pytest.mark.slow
def test_a_labs_starter_is_put_there(tmp_path: Path) -> None:
    """The keys tell more, and the editor's save is checked."""
    with watching(with_editor(tmp_path), "nodes") as watch:
        said = watch.shows("h hint .* q quit")
        assert "The starter of 'nodes' is in" in said
        shown = in_the_readme("Day 02-")
        assert [line for line in shown if line not in said.splitlines()] == []
        watch.press("h")
        watch.shows("Hint 1 of 3")
        watch.press("h")
        watch.shows("Hint 2 of 3")
        watch.press("l")
        watch.shows(r"\./roslings lab 2\n")
        watch.press("g")
        watch.shows("No node has run yet")
        watch.press("n")
        watch.shows("is not done yet")
        watch.press("?")
        watch.shows("h hint .* q quit")
        watch.press("e")
        said = watch.shows(r"(?s)Saved: .*Save a file to check again")
        assert max(map(len, said.partition("Lab nodes,")[2].splitlines())) <= 80
        watch.press("q")
    package = tmp_path / "roslings_ws" / "src" / "rover_status"
    assert "# edited" in (package / "rover_status" / "minimal_publisher.py").read_text("utf-8")


@pytest.mark.slow
def test_who_is_done_goes_on_with_what_is_next(tmp_path: Path) -> None:
    """The graph is that of the check; then comes what was left out: here the day's drills."""
    nodes = lab("nodes")
    shutil.copytree(nodes.solution, tmp_path / "roslings_ws" / "src" / nodes.card.package)
    with watching(with_editor(tmp_path), "nodes") as watch:
        watch.shows(r"(?s)100 of 100.*Done\. To hand it in: \./roslings pack nodes.*Save a file")
        watch.press("g")
        watch.shows("/minimal_publisher")
        watch.press("r")
        watch.shows(rf"(?s)1 of {len(all_labs())}.*100 of 100.*Save a file")
        watch.press("n")
        watch.shows(r"(?s)Drill 1 of .*Save a file to check again")
        watch.press("q")


def test_the_first_thing_to_do_is_where_the_editor_opens(tmp_path: Path) -> None:
    """In the package's own code; else its first file."""
    package = tmp_path / "chatter"
    (package / "chatter").mkdir(parents=True)
    (package / "setup.py").write_text("# TODO 1\n")
    (package / "chatter" / "listener.py").write_text("import rclpy\n")
    assert first_to_do(package) == FileLine(package / "chatter" / "listener.py")
    (package / "chatter" / "talker.py").write_text("import rclpy\n# TODO 2: a timer\n")
    assert first_to_do(package) == FileLine(package / "chatter" / "talker.py", 2)


def test_an_editor_that_is_set_wins_but_in_vs_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`code` is asked for the line; another one gets the file; with none the place is told."""
    place, words = FileLine(tmp_path / "talker.py", 7), ("VISUAL", "EDITOR", "TERM_PROGRAM")
    for name in ("code", "nano"):
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
    for word in words:
        monkeypatch.delenv(word, raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    code = [str(tmp_path / "code"), str(tmp_path), "--goto", f"{place.file}:7"]
    assert editor_for(place, tmp_path) == code
    monkeypatch.setenv("EDITOR", "nano -w")
    assert editor_for(place, tmp_path) == ["nano", "-w", "+7", str(place.file)]
    monkeypatch.setenv("TERM_PROGRAM", "vscode")
    assert editor_for(place, tmp_path) == code
    monkeypatch.setenv("PATH", "")
    assert editor_for(place, tmp_path) is None


@pytest.mark.parametrize(
    ("there", "opens"),
    [
        (("vim", "nano"), ["nano", "+7"]),
        (("vi",), ["vi", "+7"]),
        (("emacs",), ["emacs", "-nw", "+7"]),
        (("gedit",), None),
    ],
)
def test_an_editor_that_is_there_is_offered(
    there: tuple[str, ...], opens: list[str] | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where none is set: the easiest that needs no window, at the line."""
    for word in ("VISUAL", "EDITOR", "TERM_PROGRAM"):
        monkeypatch.delenv(word, raising=False)
    for name in there:
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    place = FileLine(tmp_path / "talker.py", 7)
    assert editor_for(place, tmp_path) == (opens and [*opens, str(place.file)])
    assert is_there() is bool(opens)


def test_an_editor_of_a_window_gets_no_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody knows which word leads it there."""
    (tmp_path / "thonny").write_text("#!/bin/sh\n")
    (tmp_path / "thonny").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("VISUAL", "thonny")
    monkeypatch.delenv("TERM_PROGRAM", raising=False)
    assert editor_for(FileLine(tmp_path / "a.py", 7), tmp_path) == [
        "thonny",
        str(tmp_path / "a.py"),
    ]
