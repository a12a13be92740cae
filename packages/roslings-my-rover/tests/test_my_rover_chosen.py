"""Which package is which part: the best one, today's, a borrowed one, or none yet."""

from __future__ import annotations

import re
import shutil
from argparse import ArgumentParser
from pathlib import Path
from xml.etree import ElementTree

import pytest

from roslings.course import Lab, lab, root
from roslings.verdict import Verdict
from roslings.workspace.best import best_package, keep_best
from roslings.workspace.progress import record
from roslings_my_rover.chosen import CannotBorrow, chosen, told
from roslings_my_rover.commands import my_rover
from roslings_my_rover.launch_file import DEVICE, PORT, launch_file
from roslings_my_rover.parts import PARTS, RoverPart, day_number, labs_of_parts
from roslings_my_rover.wiring import wired


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty one."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    (tmp_path / "ws" / "src").mkdir(parents=True)
    return tmp_path / "ws"


def built(workspace: Path, name: str, word: str = "") -> Path:
    """A package of the student's, with a word in it."""
    own = lab(name)
    package = workspace / "src" / own.outline.package
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(own.solution, package)
    (package / "word.txt").write_text(word)
    return package


def checked(own: Lab, package: Path, score: float) -> None:
    """As `check` does at its end."""
    record(Verdict.model_construct(lab=own.name, checks=(), score=score, outcome="fail"))
    keep_best(own, package, score)


def word_in(package: Path | None) -> str:
    """Which of the student's packages it is."""
    assert package
    return (package / "word.txt").read_text()


def test_without_a_package_every_part_is_absent(workspace: Path) -> None:
    """And says from which day on it is there."""
    found = chosen()
    assert found.there == () and len(found.absent) == len(PARTS)
    assert [each.line for each in found.absent][5] == "no eyes yet: day 7"
    assert all(len(each.line) <= 32 for each in found.absent)
    assert len(list(told(found))) == len(PARTS)
    assert all(len(line) <= 80 for line in told(found))


def test_a_part_that_was_never_checked_is_a_part(workspace: Path) -> None:
    """A student learns most from seeing the own broken part on the robot."""
    built(workspace, "nodes")
    (found,) = chosen().there
    assert (found.part.name, found.remark) == ("voice", "never checked")


def test_the_best_one_is_carried_and_src_takes_todays(workspace: Path) -> None:
    """What is tried after a good check spoils nothing of it."""
    own = lab("nodes")
    checked(own, built(workspace, "nodes", "good"), 60)
    checked(own, built(workspace, "nodes", "worse"), 40)
    built(workspace, "nodes", "not checked at all")
    (best,), (todays,) = chosen().there, chosen(todays=True).there
    assert (word_in(best.package), best.remark) == ("good", "60 of 100")
    assert (word_in(todays.package), todays.remark) == ("not checked at all", "40 of 100")
    checked(own, built(workspace, "nodes", "whole"), 100)
    (best,) = chosen().there
    assert (word_in(best.package), best.remark) == ("whole", "")


def test_of_two_with_one_score_the_later_is_kept(workspace: Path) -> None:
    """A verdict that nobody could give keeps nothing."""
    own = lab("nodes")
    keep_best(own, built(workspace, "nodes", "first"), 60)
    keep_best(own, built(workspace, "nodes", "second"), 60)
    keep_best(own, built(workspace, "nodes", "unclear"), None)
    assert word_in(best_package(own)) == "second"


def test_a_kept_package_that_was_spoiled_is_kept_anew(workspace: Path) -> None:
    """By hand, or by a disk that was full."""
    own = lab("nodes")
    keep_best(own, built(workspace, "nodes", "first"), 60)
    (workspace / ".roslings/best/nodes/score").write_text("sixty")
    keep_best(own, built(workspace, "nodes", "second"), 10)
    assert word_in(best_package(own)) == "second"


def test_a_package_that_was_renamed_since_is_carried_as_it_was(workspace: Path) -> None:
    """The best one is kept under its lab's name; today there is none of that name."""
    own = lab("nodes")
    package = built(workspace, "nodes", "good")
    checked(own, package, 80)
    file = package / "package.xml"
    name = f"<name>{own.outline.package}</name>"
    file.write_text(file.read_text("utf-8").replace(name, "<name>my_first_one</name>"), "utf-8")
    package.rename(package.with_name("my_first_one"))
    (best,) = chosen().there
    assert (word_in(best.package), best.remark) == ("good", "80 of 100")
    assert chosen(todays=True).there == ()
    assert chosen(todays=True).absent[0].line == "no voice yet: day 2"


def test_only_the_days_that_are_asked_for(workspace: Path) -> None:
    """Later parts are neither there nor missed."""
    for name in ("nodes", "distance-sensor", "services"):
        built(workspace, name)
    found = chosen(last_day=3)
    assert [each.part.name for each in found.there] == ["voice", "sonar"]
    assert found.absent == ()


def test_a_part_is_borrowed_only_where_there_is_none(workspace: Path) -> None:
    """And it says whose it is."""
    built(workspace, "nodes", "mine")
    found = chosen(last_day=3, borrowed=[2, 3])
    assert [each.remark for each in found.there] == ["never checked", "borrowed from the course"]


@pytest.mark.parametrize(("day", "words"), [(1, "no part of the rover"), (9, "no part"), (0, "no")])
def test_what_cannot_be_borrowed(workspace: Path, day: int, words: str) -> None:
    """With the days that can."""
    with pytest.raises(CannotBorrow, match=words) as told_so:
        chosen(borrowed=[day])
    assert "2, 3, 4, 5, 6, 7, 8, 10" in str(told_so.value)


def test_an_edition_without_solutions_lends_nothing(
    workspace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It names the command that begins the lab."""
    own = lab("services")
    shutil.copytree(own.folder, tmp_path / "course/labs/services")
    shutil.rmtree(tmp_path / "course/labs/services/solution")
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path / "course"))
    with pytest.raises(CannotBorrow, match="start services"):
        chosen(borrowed=[4])


def test_the_launch_file_has_each_program_with_its_wiring(workspace: Path) -> None:
    """As the rover starts them; of absent parts it says nothing, nor of what drives by itself."""
    for part in PARTS:
        built(workspace, part.lab)
    started = [part for part in PARTS if not part.only_in_rooms]
    tree = ElementTree.fromstring(launch_file(chosen()))
    nodes = {node.attrib["exec"]: node for node in tree.iter("node")}
    wiring = wired(started, PORT, DEVICE)
    assert nodes.keys() == wiring.programs.keys()
    for name, link in wiring.programs.items():
        remaps = [(each.attrib["from"], each.attrib["to"]) for each in nodes[name].iter("remap")]
        values = [(each.attrib["name"], each.attrib["value"]) for each in nodes[name].iter("param")]
        assert (tuple(remaps), tuple(values)) == (link.remaps, link.parameters)
    assert len(list(ElementTree.fromstring(launch_file(chosen(last_day=2))).iter("node"))) == 1


PAGE = (root() / "site/pages/reference/my-rover.md").read_text("utf-8")
TYPED = re.findall(r"\./roslings (my-rover[^\n`]*)", PAGE)


@pytest.mark.parametrize("typed", [*dict.fromkeys(TYPED)])
def test_what_the_page_types_is_a_command(typed: str) -> None:
    """With options that there are."""
    parser = ArgumentParser()
    my_rover.add_options(parser)
    parser.parse_args(typed.split()[1:])


def test_the_page_tells_each_part() -> None:
    """Its day, its name and its lab, as the rover has them."""
    rows = re.findall(r"^\| (\d+) \| ([a-z]+) \| `([a-z-]+)` \|", PAGE, re.M)
    labs = labs_of_parts()
    assert rows == [(str(day_number(labs[part.name])), part.name, part.lab) for part in PARTS]


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.name)
def test_each_task_ends_on_the_rover(part: RoverPart) -> None:
    """With a command that there is."""
    text = lab(part.lab).task.read_text("utf-8").rpartition("## On your rover")[2]
    typed = re.findall(r"^\./roslings my-rover(.*)$", text, re.M)
    assert typed
    for words in typed:
        parser = ArgumentParser()
        my_rover.add_options(parser)
        parser.parse_args(words.split())
