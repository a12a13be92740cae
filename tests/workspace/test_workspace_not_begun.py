"""A lab that is not begun, beside the finished packages of other labs: so it is from day 3 on."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from few import few
from roslings.course import Lab, all_labs, lab
from roslings.hand_in.errors import HandInRefused
from roslings.hand_in.unpack import package_in
from roslings.workspace import errors as trouble
from roslings.workspace import progress
from roslings.workspace.student import diff, pack, package_of
from roslings_launcher.cli import main
from roslings_learn.notebook.verdict import check

LABS = [each.name for each in all_labs()]
NAMES = ("package.xml", "<name>", "setup.cfg", "resource/")
"""What is said of a name; to who has not begun, it means: rename the other lab's package."""

each_lab = few("name", [(name, name) for name in LABS], "topics", "serial-bridge")
"""The rules are the same for all. CI tries each pair of labs."""


def finish(workspace: Path, *names: str) -> None:
    """The packages of these labs, as good as their solutions."""
    for name in names:
        package = lab(name).outline.package
        shutil.copytree(lab(name).solution, workspace / "src" / package)


def others(name: str) -> list[str]:
    """All labs but this one."""
    return [each for each in LABS if each != name]


def says_start(told: str, name: str) -> bool:
    """The next step is the lab's starter, and no word is of names."""
    return f"./roslings start {name}" in told and not any(word in told for word in NAMES)


@each_lab
def test_each_lab_beside_each_other_one(workspace: Path, name: str) -> None:
    """The search through the workspace, its folder as a path, and the other package as a path."""
    for other in others(name):
        shutil.rmtree(workspace, ignore_errors=True)
        finish(workspace, other)
        its = workspace / "src" / lab(other).outline.package
        for path in (None, workspace, workspace / "src", its, its / "resource"):
            with pytest.raises((trouble.NotBegun, trouble.OfOtherLab)) as told:
                package_of(lab(name), path)
            assert says_start(str(told.value), name), told.value


@few("name", [(name, name) for name in (*LABS, "example")], "topics", "example")
@pytest.mark.parametrize(
    "words",
    [
        "check LAB",
        "check LAB --hint",
        "check LAB --json -",
        "pack LAB",
        "diff LAB",
        "graph --for LAB",
    ],
)
def test_each_command_says_how_to_begin(
    workspace: Path, name: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """With all other labs done; it fails as wrong use, and leaves nothing behind."""
    finish(workspace, *others(name))
    before = sorted(workspace.rglob("*"))
    assert main(words.replace("LAB", name).split()) == 2
    told = capsys.readouterr()
    assert says_start(told.err, name), told.err
    assert told.out == "" and sorted(workspace.rglob("*")) == before


@each_lab
@pytest.mark.parametrize("done", ["none", "all others"])
def test_the_check_of_a_cell_says_it_in_one_line(
    workspace: Path, name: str, done: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The notebook's own words, whatever else is in the workspace."""
    if done != "none":
        finish(workspace, *others(name))
    check(name)
    told = capsys.readouterr().out
    assert told.count("\n") == 1 and says_start(told, name), told


@each_lab
def test_what_is_next_is_to_start_it(
    workspace: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """`./roslings` and `status` too: a package of another lab is no beginning of this one."""
    finish(workspace, *others(name))
    status = next(each for each in progress.status() if each.lab.name == name)
    assert status.package is None
    assert main(["status"]) == 0
    line = next(each for each in capsys.readouterr().out.splitlines() if f" {name} " in each)
    assert "not begun" in line


def test_before_the_first_lab_each_way_names_the_lab(workspace: Path) -> None:
    """No workspace, an empty one, and one with drills only."""
    for make in (lambda: None, lambda: workspace.mkdir(parents=True), lambda: drill_in(workspace)):
        make()
        for name in LABS:
            with pytest.raises(trouble.WorkspaceError) as told:
                package_of(lab(name))
            assert says_start(str(told.value), name), told.value


def drill_in(workspace: Path) -> None:
    """A file that is no package."""
    (workspace / "drills").mkdir()
    (workspace / "drills" / "seven.sh").touch()


def test_watch_begins_the_lab_by_itself(
    workspace: Path, topics: Lab, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its starter is put there, beside what is finished."""
    from roslings_launcher.cli import parser
    from roslings_learn.commands.watch.keyboard import Keyboard
    from roslings_learn.commands.watch.lab import begun

    finish(workspace, *others("topics"))
    session = begun(topics, parser().parse_args(["watch", "topics"]), Keyboard())
    assert session.folder == workspace / "src" / "chatter"
    assert "starter" in capsys.readouterr().out


# --- one that looks like this lab -------------------------------------------------------------


def rename(package: Path, name: str) -> None:
    """The name in package.xml becomes another."""
    xml = package / "package.xml"
    old = f"<name>{package.name}</name>"
    assert old in xml.read_text("utf-8")
    xml.write_text(xml.read_text("utf-8").replace(old, f"<name>{name}</name>"), "utf-8")


def misspell(package: Path) -> None:
    """A letter less."""
    rename(package, package.name[:-2] + package.name[-1])


def put_a_hyphen(package: Path) -> None:
    """As the lab is often called."""
    rename(package, f"my-{package.name.replace('_', '-')}")


def call_it_otherwise(package: Path) -> None:
    """Folder and name are the student's own: only the executables tell."""
    rename(package, "week_two")
    package.rename(package.with_name("week_two"))


def forget_the_name(package: Path) -> None:
    """The folder is right, and package.xml is a copy of another lab's."""
    other = next(each for each in all_labs() if each.outline.package != package.name)
    rename(package, other.outline.package)


@each_lab
@pytest.mark.parametrize("spoil", [misspell, put_a_hyphen, call_it_otherwise, forget_the_name])
def test_a_package_that_looks_like_this_lab_is_told_of_its_name(
    workspace: Path, name: str, spoil: Callable[[Path], None]
) -> None:
    """It alone is named, among the finished ones of all others."""
    finish(workspace, name)
    spoil(workspace / "src" / lab(name).outline.package)
    (spoiled,) = (workspace / "src").iterdir()
    finish(workspace, *others(name))
    for way in (package_of, pack, diff):
        with pytest.raises(trouble.NamedOtherwise, match=r"package\.xml") as told:
            way(lab(name))
        assert [folder for _, folder in told.value.found] == [spoiled]
        assert f"./roslings start {name}" in told.value.next_step


def test_who_gives_the_one_package_as_a_path_means_it(workspace: Path, topics: Lab) -> None:
    """Also where nothing in it looks like the lab."""
    finish(workspace, "nodes")
    package = workspace / "src" / "rover_status"
    rename(package, "week_two")
    with pytest.raises(trouble.NamedOtherwise, match="'week_two'"):
        package_of(topics, package)
    with pytest.raises(trouble.NotBegun, match="start topics"):
        package_of(topics)


# --- the package is there, and colcon does not see it -------------------------------------------


@pytest.mark.parametrize("name", LABS)
def test_a_package_that_colcon_passes_by_is_no_lab_not_begun(workspace: Path, name: str) -> None:
    """`start` would refuse: its folder is taken."""
    finish(workspace, *LABS)
    package = workspace / "src" / lab(name).outline.package
    (package / "COLCON_IGNORE").touch()
    with pytest.raises(trouble.IgnoredByColcon):
        package_of(lab(name))
    (package / "package.xml").unlink()
    with pytest.raises(trouble.NoPackageXml):
        package_of(lab(name))


# --- what was handed in -------------------------------------------------------------------------


@pytest.mark.parametrize("name", LABS)
def test_the_package_of_another_lab_that_was_handed_in(tmp_path: Path, name: str) -> None:
    """It is called so; nobody is told to rename it. One of no lab is."""
    for other in others(name):
        folder = tmp_path / f"{name}-{other}"
        finish(folder, other)
        with pytest.raises(HandInRefused) as told:
            package_in(folder, lab(name).outline.package, tmp_path / "room")
        assert f"of the lab '{other}'" in told.value.reason
        assert "pack LAB" in told.value.next_step and "package.xml" not in told.value.next_step
    rename(folder / "src" / lab(other).outline.package, "week_two")
    with pytest.raises(HandInRefused, match="'week_two'") as told:
        package_in(folder, lab(name).outline.package, tmp_path / "room")
    assert "package.xml" in told.value.next_step
