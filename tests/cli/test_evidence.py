"""`check --evidence` and `regrade`: what was seen is kept, and judged again without running."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from roslings import course
from roslings.course import Edit, Mutant, lab
from roslings.evidence import evidence_json, read_json
from roslings.probe.bag import LEFT_OUT, MOST_BYTES
from until_told import checked

TOPICS = lab("topics")
TYPES = get_typestore(Stores.ROS2_JAZZY)
LONG_S = 120.0
ENDED_BY_CTRL_C = (130, -signal.SIGINT)
"""A shell says 130 of both. Python takes the second way where Ctrl-C met it in exec() of a text, as
the making of a dataclass is."""


@dataclass(frozen=True)
class Ran:
    """How a command ended."""

    code: int
    out: str
    err: str


def run(cwd: Path, *words: str | Path, **more: str) -> Ran:
    """Run a command to its end; our own traceback is never an answer."""
    command = [sys.executable, "-m", "roslings", *map(str, words)]
    done = subprocess.run(
        command,
        cwd=cwd,
        env=surroundings(cwd, **more),
        text=True,
        capture_output=True,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return Ran(done.returncode, done.stdout, done.stderr)


def surroundings(cwd: Path, **more: str) -> dict[str, str]:
    """This environment, with home, workspace and temporary files inside the test's folder."""
    (cwd / "tmp").mkdir(exist_ok=True)
    own = {"HOME": str(cwd), "ROSLINGS_WS": str(cwd / "ws"), "TMPDIR": str(cwd / "tmp")}
    return {**os.environ, **own, **more}


@dataclass(frozen=True)
class Kept:
    """One check whose evidence was saved."""

    folder: Path
    ran: Ran

    @property
    def verdict(self) -> dict[str, Any]:
        """The verdict beside the evidence."""
        found: dict[str, Any] = json.loads((self.folder / "verdict.json").read_text("utf-8"))
        return found

    @property
    def evidence(self) -> dict[str, Any]:
        """The evidence."""
        kept = read_json((self.folder / "evidence.json").read_bytes())
        found: dict[str, Any] = json.loads(evidence_json(kept))
        return found


def kept_of(cwd: Path, package: str | Path) -> Kept:
    """Of the first check that could tell; the folder of one that could not makes room."""

    kept, env = cwd / "kept", surroundings(cwd)
    done = checked("topics", package, "--evidence", kept, folder=cwd, env=env, kept=kept).ran
    assert "Traceback" not in done.stderr, done.stderr
    return Kept(kept, Ran(done.returncode, done.stdout, done.stderr))


@pytest.fixture(scope="module")
def solution(tmp_path_factory: pytest.TempPathFactory) -> Kept:
    """The right package."""
    cwd = tmp_path_factory.mktemp("solution")
    return kept_of(cwd, "--solution")


def mutant(*edits: Edit) -> Mutant:
    """The solution with these edits."""
    return Mutant(name="it", what="it", fails=("rate",), edits=edits)


@pytest.fixture(scope="module")
def wrong(tmp_path_factory: pytest.TempPathFactory) -> Kept:
    """A talker at 1 Hz, with 100 kB in each message and a line that looks like HTML.

    It writes no message: so much of it would be a flood, and end the talker.
    """
    cwd = tmp_path_factory.mktemp("wrong")
    replaced = {
        "create_timer(0.5,": "create_timer(1.0,",
        "f'Hello robotics {self.count}'": "'x' * 100_000 + f'Hello robotics {self.count}'",
        "self.get_logger().info(": "self.get_logger().debug(",
        "super().__init__('talker')": "super().__init__('talker')\n        print('<script>')",
    }
    edits = [Edit(file="chatter/talker.py", find=a, replace=b) for a, b in replaced.items()]
    package = mutant(*edits).make(TOPICS.solution, cwd / "ws/src/chatter")
    return kept_of(cwd, package)


def regraded(kept: Kept, tmp_path: Path, **more: str) -> tuple[Ran, dict[str, Any]]:
    """Judge again; the command's end, and the verdict without its seconds."""
    file = tmp_path / "again.json"
    page = tmp_path / "again.html"
    words = ("regrade", "topics", kept.folder, "--json", file, "--html", page)
    ran = run(tmp_path, *words, **more)
    return ran, without_seconds(json.loads(file.read_text("utf-8")))


def without_seconds(verdict: dict[str, Any]) -> dict[str, Any]:
    """What must be equal."""
    return {key: value for key, value in verdict.items() if key != "seconds"}


@pytest.mark.parametrize("name", ["solution", "wrong"])
def test_judged_again_it_is_the_same(
    name: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """Verdict, exit code, page: all but the time that judging takes."""
    kept: Kept = request.getfixturevalue(name)
    ran, again = regraded(kept, tmp_path)
    assert again == without_seconds(kept.verdict)
    # What is too large to be read is not judged: of the wrong one not everything can be told.
    assert ran.code == kept.ran.code == {"solution": 0, "wrong": 3}[name]
    page = (tmp_path / "again.html").read_text("utf-8")
    assert page == (kept.folder / "report.html").read_text("utf-8")
    assert "<script>" not in page


@pytest.mark.slow
def test_nothing_is_run_when_it_is_judged_again(solution: Kept, tmp_path: Path) -> None:
    """Not even where a node, colcon and ROS could not run."""
    ran, again = regraded(solution, tmp_path, PATH="/nowhere", AMENT_PREFIX_PATH="/nowhere")
    assert ran.code == 0
    assert again["score"] == 100
    assert list((tmp_path / "tmp").iterdir()) == []


def test_the_folder_holds_all_that_was_seen(solution: Kept) -> None:
    """Evidence, verdict, page, what each node wrote, and a bag of what was said, where it was."""
    files = {str(p.relative_to(solution.folder)) for p in solution.folder.rglob("*")}
    assert {"evidence.json", "verdict.json", "report.html", "logs/build.txt"} <= files
    for name in ("talking", "hearing"):  # `together` may end before the first message
        assert {f"bags/{name}/metadata.yaml", f"bags/{name}/{name}.mcap"} <= files
    assert {"logs/talking/talker.txt", "logs/hearing/listener.txt"} <= files
    assert (
        "Publishing: 'Hello robotics" in (solution.folder / "logs/talking/talker.txt").read_text()
    )
    assert str(solution.folder.name) in solution.ran.out
    assert not list(solution.folder.parent.glob(".kept*"))


def messages(bag: Path) -> list[tuple[str, int, Any]]:
    """Topic, stamp and message of all that a bag holds, read without ROS."""
    with Reader(bag) as reader:
        return [
            (each.topic, stamp_ns, TYPES.deserialize_cdr(raw, each.msgtype))
            for each, stamp_ns, raw in reader.messages()
        ]


def test_a_bag_holds_the_messages_as_they_came(solution: Kept) -> None:
    """With the publisher's stamps; and what the grader said, in the listener's."""
    seen = solution.evidence["experiments"]
    heard = seen["talking"]["topics"]["/chatter"]["messages"]
    assert [(t, m.data) for _, t, m in messages(solution.folder / "bags/talking")] == [
        (each["source_ns"], each["content"]["data"]) for each in heard
    ]
    said = [(each["topic"], each["content"]["data"]) for each in seen["hearing"]["spoken"]]
    assert len(said) == 12
    assert [(t, m.data) for t, _, m in messages(solution.folder / "bags/hearing")] == said


def test_a_bag_tells_its_types(solution: Kept) -> None:
    """The definition and the hash that ROS itself gives to std_msgs/msg/String."""
    with Reader(solution.folder / "bags/talking") as reader:
        (connection,) = reader.connections
    assert "string data" in connection.msgdef.data
    assert connection.digest == TYPES.hash_rihs01("std_msgs/msg/String")
    assert connection.ext.offered_qos_profiles[0].reliability.name == "RELIABLE"


def test_large_messages_are_in_the_bag(wrong: Kept) -> None:
    """Larger than what the evidence keeps as values."""
    heard = wrong.evidence["experiments"]["talking"]["topics"]["/chatter"]["messages"]
    assert {each["content"] for each in heard} == {None}
    kept = messages(wrong.folder / "bags/talking")
    assert [len(m.data) > 100_000 for _, _, m in kept] == [True] * len(heard)
    assert len(heard) * 100_000 < MOST_BYTES
    assert LEFT_OUT not in (wrong.folder / "bags/talking/metadata.yaml").read_text()


# --- another card, another grader --------------------------------------------------------------


@pytest.fixture
def other_course(tmp_path: Path) -> Path:
    """A copy of the course that a test may change."""
    for folder in ("labs", "graders"):
        shutil.copytree(course.root() / folder, tmp_path / "course" / folder)
    return tmp_path / "course"


def change(file: Path, find: str, replace: str) -> None:
    """Change one place."""
    text = file.read_text("utf-8")
    assert text.count(find) == 1
    file.write_text(text.replace(find, replace), "utf-8")


def test_a_changed_limit_changes_its_check_and_nothing_else(
    solution: Kept, other_course: Path, tmp_path: Path
) -> None:
    """An instructor asks for 4 Hz; the page shows the new band."""
    change(other_course / "labs/topics/card.yaml", "hz: 2.0", "hz: 4.0")
    ran, again = regraded(solution, tmp_path, ROSLINGS_COURSE=str(other_course))
    before = {check["id"]: check for check in solution.verdict["checks"]}
    changed = {c["id"]: c for c in again["checks"] if c["outcome"] != before[c["id"]]["outcome"]}
    assert changed.keys() == {"rate"}
    assert changed["rate"]["fault"] == "TooSlow"
    assert (ran.code, again["score"]) == (1, 100 - before["rate"]["points"])
    assert again["environment"] == solution.verdict["environment"]
    assert "4 Hz (3.8 to 4.2 Hz)" in (tmp_path / "again.html").read_text("utf-8")


def test_what_was_not_recorded_is_no_fault(
    solution: Kept, other_course: Path, tmp_path: Path
) -> None:
    """A grader that asks for one more experiment: inconclusive, and only there."""
    grader = other_course / "graders/grade_topics.py"
    more = "\n\n@experiment\ndef later(scene: Scene) -> None:\n    '''Later.'''\n"
    check = "\n\n@check()\ndef test_later(later: ExperimentView) -> None:\n    '''Later.'''\n"
    grader.write_text(grader.read_text("utf-8") + more + check, "utf-8")
    card = other_course / "labs/topics/card.yaml"
    change(card, "figure: 2", "figure: 1\n  later: 1")
    ran, again = regraded(solution, tmp_path, ROSLINGS_COURSE=str(other_course))
    assert ran.code == 3
    assert again["score"] is None
    (open_,) = [check for check in again["checks"] if check["outcome"] != "pass"]
    assert open_["id"] == "later"
    assert open_["why"].startswith("too little evidence")


# --- wrong use ---------------------------------------------------------------------------------


def test_evidence_that_is_none_is_refused(tmp_path: Path) -> None:
    """Exit code 2, one message, the next step."""
    (tmp_path / "evidence.json").write_text("{}")
    for path in (tmp_path, tmp_path / "gone"):
        ran = run(tmp_path, "regrade", "topics", path)
        assert ran.code == 2
        assert len(ran.err.splitlines()) == 2
        assert ran.out == ""


def taken(package: Path) -> Path:
    """A folder with something in it."""
    place = package.parent / "taken"
    place.mkdir()
    (place / "mine").touch()
    return place


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (taken, "holds other files"),
        (lambda package: package / "kept", "lies inside the package"),
        (lambda package: package.parent / "no/where", "mkdir -p"),
    ],
    ids=["taken", "inside", "nowhere"],
)
def test_a_place_that_cannot_be_is_said_at_once(
    tmp_path: Path, place: Callable[[Path], Path], words: str
) -> None:
    """Before anything is built or run."""
    package = tmp_path / "ws/src/chatter"
    shutil.copytree(TOPICS.solution, package)
    where = place(package)
    before = sorted(package.parent.rglob("*"))
    ran = run(tmp_path, "check", "topics", package, "--evidence", where)
    assert ran.code == 2
    assert words in ran.err
    assert "Building" not in ran.err + ran.out
    assert sorted(package.parent.rglob("*")) == before


def test_a_hint_has_no_evidence(solution: Kept, tmp_path: Path) -> None:
    """It shows the last verdict again."""
    (tmp_path / "ws/.roslings").mkdir(parents=True)
    shutil.copy(solution.folder / "verdict.json", tmp_path / "ws/.roslings/verdict-topics.json")
    ran = run(tmp_path, "check", "topics", "--hint", "--evidence", "kept")
    assert ran.code == 2
    assert "Leave --hint out" in ran.err
    assert not (tmp_path / "kept").exists()


@pytest.mark.slow
def test_ctrl_c_leaves_no_half_folder(tmp_path: Path) -> None:
    """Nor any other trace."""
    words = [sys.executable, "-m", "roslings", "check", "topics", "--solution"]
    running = subprocess.Popen(
        [*words, "--evidence", str(tmp_path / "kept")],
        cwd=tmp_path,
        env=surroundings(tmp_path),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    wait_until(lambda: any(tmp_path.glob("tmp/roslings-*/src/*")))
    os.killpg(running.pid, signal.SIGINT)
    _, errors = running.communicate()
    assert running.returncode in ENDED_BY_CTRL_C, errors
    assert [p.name for p in tmp_path.iterdir()] == ["tmp"]
    assert list((tmp_path / "tmp").glob("roslings-*")) == []


def wait_until(condition: Callable[[], bool]) -> None:
    """Wait for a condition; fail when it never holds."""
    deadline_s = time.monotonic() + LONG_S
    while not condition():
        assert time.monotonic() < deadline_s
        time.sleep(0.02)


@pytest.mark.slow
def test_a_page_alone_needs_no_folder(tmp_path: Path) -> None:
    """`--html FILE`, also for a package that cannot be built."""
    package = mutant(
        Edit(file="setup.py", find="setup(\n", replace="raise SystemExit('no glue')\nsetup(\n")
    ).make(TOPICS.solution, tmp_path / "src/chatter")
    ran = run(tmp_path, "check", "topics", package, "--html", "it.html")
    assert ran.code == 1
    page = (tmp_path / "it.html").read_text("utf-8")
    assert "no glue" in page
