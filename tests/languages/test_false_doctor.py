"""The doctor in the false language: no text of a check is without an id, and columns stay straight.

Its package knows none of ours. It finds translations by an entry point, where a language is asked.
"""

from __future__ import annotations

import ast
import errno
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from false_screen import left_plain, require_columns

from plain_english import words_of
from ros2_on_pip.false_language import false
from ros2_on_pip.language import ENGLISH, FALSE, VARIABLE
from ros_doctor import texts
from ros_doctor.cli import main
from ros_doctor.examine import examine
from ros_doctor.pages import page_of
from ros_doctor.registry import all_checks
from ros_doctor.screen import LABEL, LABELS, Paint, explain_lines, lines_of, list_lines
from roslings.course import root

PACKAGE = root() / "packages/ros-doctor"
sys.path.append(str(PACKAGE / "tests"))
from clinic import Clinic  # noqa: E402

SAYS = {"do": 1} | dict.fromkeys(
    ("ok", "fault", "warning", "advice", "unknown", "not_applicable", "say"), 0
)
"""What a check tells with, to which of its arguments people read."""
NAMES = words_of(
    "sam noble greeter course ros jazzy humble opt roslings doctor LTS nano em src setup sudo GNU"
    " bookworm gcc bubblewrap wheels"
) | words_of(os.strerror(errno.ENOENT))
"""Names of this machine, of programs and of files; and what the system says in its own words."""


@pytest.fixture(autouse=True)
def asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """The language is asked for as a student does."""
    monkeypatch.setenv(VARIABLE, FALSE)


def ill(clinic: Clinic) -> None:
    """Eight things at once."""
    clinic.apt(sourced=False)
    clinic.change(free_bytes=lambda path: 100_000_000)
    (clinic.package() / "setup.cfg").unlink()
    (clinic.machine.workspace / "src/greeter/resource/greeter").unlink()
    (clinic.root / "dev/ttyACM0").symlink_to(clinic.root / "dev/gone")
    clinic.set(ROS_DOMAIN_ID="seven", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF")


def without_ros(clinic: Clinic) -> None:
    """A bare machine, in a terminal that knows another ROS."""
    clinic.no_ros()
    clinic.env.pop("DISPLAY")
    clinic.set(ROS_DISTRO="humble", CONDA_PREFIX="/opt/conda", ROS_LOCALHOST_ONLY="1")
    clinic.set(GTK_PATH="/snap/code/1", RMW_IMPLEMENTATION="rmw_other", ROS_DOMAIN_ID="200")


def with_a_broken_package(clinic: Clinic) -> None:
    """What stands in the workspace is not built, and setup.py leads nowhere."""
    package = clinic.package()
    setup = package / "setup.py"
    setup.write_text(setup.read_text("utf-8").replace("greeter.hello", "greeter.helo"), "utf-8")
    (package / "package.xml").write_text("<package>", "utf-8")


@pytest.fixture(params=[lambda _: None, ill, without_ros, with_a_broken_package])
def machine(request: pytest.FixtureRequest, tmp_path: Path) -> Clinic:
    """A machine that is well, and machines that are not."""
    clinic = Clinic(tmp_path / "m")
    request.param(clinic)
    return clinic


def known(clinic: Clinic) -> frozenset[str]:
    """What each language says alike: ids, paths, commands."""
    ids = frozenset(word for check in all_checks() for word in words_of(check.id))
    return ids | NAMES | words_of(str(clinic.root))


def screen(lines: Iterator[str], commands: set[str]) -> str:
    """Without the lines that are typed."""
    return "\n".join(line for line in lines if line.strip() not in commands)


def test_what_the_doctor_finds(machine: Clinic) -> None:
    """Findings, what one sees, mends, a summary: with all that is well, too."""
    seen = examine(machine.machine, [check for check in all_checks() if not check.live])
    commands = {
        line.strip()
        for one in seen.results
        for step in one.finding.mend
        for line in step.command.splitlines()
    }
    for detailed in (False, True):
        said = screen(lines_of(seen, Paint(False), detailed), commands)
        whole = " ".join(said.split())  # a command in a text is known by its first word
        assert not left_plain(whole, known(machine)), "\n".join(left_plain(whole, known(machine)))
        short = "\n".join(line for line in said.splitlines() if str(machine.root) not in line)
        require_columns(short)  # a path is never broken


def test_what_the_doctor_can_look_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """`--list`, in both languages in lines of 80 columns."""
    for language in (FALSE, ENGLISH):
        monkeypatch.setenv(VARIABLE, language)
        said = "\n".join(list_lines(all_checks()))
        require_columns(said)
        ids = frozenset(word for check in all_checks() for word in words_of(check.id))
        if language == FALSE:
            assert not left_plain(said, ids | NAMES)


@pytest.mark.parametrize("id", [check.id for check in all_checks()])
def test_the_page_of_a_check(tmp_path: Path, id: str) -> None:
    """`--explain`: what it looks at, its page, how it stands here. Code in it is code."""
    clinic = Clinic(tmp_path / "m")
    check = next(each for each in all_checks() if each.id == id)
    one = examine(clinic.machine, [check]).results[0]
    said = " ".join(" ".join(explain_lines(one, page_of(check), Paint(False))).split())
    commands = {word for step in one.finding.mend for word in words_of(step.command)}
    places = words_of(check.lesson)
    assert not left_plain(said, known(clinic) | commands | places)


def test_wrong_use(capsys: pytest.CaptureFixture[str]) -> None:
    """A check that is not there, a folder that is not there."""
    for words in (["--only", "memmory"], ["--workspace", "/no/such/folder"]):
        assert main(words) == 2
        told = capsys.readouterr().err
        ids = frozenset(word for check in all_checks() for word in words_of(check.id))
        assert not left_plain(told.replace("memmory", ""), NAMES | ids)


def test_labels_share_a_column() -> None:
    """However long they are; in English as narrow as before."""
    assert max(len(str(each)) + 1 for each in LABELS) > LABEL
    assert max(len(each.english) + 1 for each in LABELS) == LABEL


def test_each_text_of_a_check_has_an_id() -> None:
    """None is written out where a finding or a mend is made: this reads the code."""
    source = PACKAGE / "src/ros_doctor"
    bare = [
        f"{file.name}:{call.lineno}: {ast.unparse(text)}"
        for file in (*sorted((source / "checks").glob("*.py")), source / "mends.py")
        for call, text in told_in(ast.parse(file.read_text("utf-8")))
        if written_out(text)
    ]
    assert bare == []


def told_in(tree: ast.Module) -> Iterator[tuple[ast.Call, ast.expr]]:
    """Each call that tells something, with what it tells."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name):
            place = SAYS.get(call.func.id)
            if place is not None and len(call.args) > place:
                yield call, call.args[place]


def written_out(text: ast.expr) -> bool:
    """Whether it is English, and no text with an id."""
    if isinstance(text, ast.IfExp):
        return written_out(text.body) or written_out(text.orelse)
    if isinstance(text, ast.BinOp):
        return written_out(text.left) or written_out(text.right)
    return isinstance(text, ast.Constant | ast.JoinedStr)


def test_texts_that_are_written_out_are_found() -> None:
    """Else the silence of the test above would mean nothing."""
    tree = ast.parse('ok(f"{x} is there."); do("rm x", "Remove it:"); say(said("a.b", "c"))')
    assert [written_out(text) for _, text in told_in(tree)] == [True, True, False]


def test_english_looks_for_no_translations(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is loaded where no language is asked for; where none is brought, it is English."""
    calls: list[str] = []
    look: Callable[[], None] = lambda: calls.append("looked")  # noqa: E731
    monkeypatch.setattr(texts, "_found", look)
    monkeypatch.delenv(VARIABLE)
    assert texts.said("doctor.x", "{a} is well", a=1) == "1 is well" and calls == []
    monkeypatch.setenv(VARIABLE, FALSE)
    assert texts.said("doctor.x", "{a} is well", a=1) == "1 is well" and calls == ["looked"]
    assert texts.counted("doctor.x", 2, one="{count} check", other="{count} checks") == "2 checks"


def test_names_are_listed() -> None:
    """As a sentence has them."""
    assert [texts.listed(["a", "b", "c"][:count]) for count in (0, 1)] == ["", "a"]
    assert texts.listed(["a", "b", "c"]) == f"a, b {false('and')} c"
    assert texts.either(["a", "b"]) == f"a {false('or')} b"
