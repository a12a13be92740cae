"""Each drill is run by hand, as a student does who wants to see it: in a terminal, and once more.

A terminal is a shell that has sourced `setup.bash`. Its home is empty and stays so, and nothing is
written into the folder of the file.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.capabilities.services.contract import ServiceWords
from roslings.course import root
from roslings_learn.drills import Drill, all_drills, drill
from roslings_learn.drills.card import DrillCard
from roslings_learn.drills.student import start

RUNNERS = {".py": "python3", ".sh": "bash"}
HANGS_AFTER_S = 60.0
"""Nothing waits for it, unless something is broken."""
LOOKS_EVERY_S = 0.05
OF_HOME = re.compile(r"\bHOME\b|\.home\(\)|expanduser|~/(?![a-z_]+\")")


@dataclass
class Terminal:
    """Where programs are run by hand, and what is seen of them from outside."""

    domain: int
    folder: Path
    _node: Any = None
    """Ours, which looks at the graph."""

    @property
    def home(self) -> Path:
        """Empty at first."""
        return self.folder / "home"

    def nodes(self) -> set[str]:
        """The full names of all other nodes."""
        found = self._node.get_node_names_and_namespaces()
        names = {f"{space.rstrip('/')}/{name}" for name, space in found}
        return names - {self._node.get_fully_qualified_name()}

    @contextmanager
    def looked_at(self) -> Iterator[None]:
        """By a node that comes anew: the graph of an older one may hold nodes that have ended."""
        import rclpy

        context = rclpy.Context()
        rclpy.init(context=context, domain_id=self.domain)
        self._node = rclpy.create_node("looks_on", context=context)
        try:
            yield
        finally:
            self._node.destroy_node()
            context.try_shutdown()

    @contextmanager
    def running(self, file: Path) -> Iterator[Program]:
        """`python3 FILE` or `bash FILE`, in the folder of the file; Ctrl-C at its end."""
        for name in ("home", "log", "tmp"):
            (self.folder / name).mkdir(exist_ok=True)
        own = {
            "HOME": str(self.home),
            "ROS_DOMAIN_ID": str(self.domain),
            "TERM": "dumb",
            "ROS_LOG_DIR": str(self.folder / "log"),
            "TMPDIR": str(self.folder / "tmp"),
            "PATH": os.environ["PATH"],
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONUNBUFFERED": "1",
        }
        typed = f"source '{root()}/setup.bash'; exec {RUNNERS[file.suffix]} {file.name}"
        output = self.folder / f"{file.stem}.txt"
        with (
            output.open("wb") as said,
            subprocess.Popen(
                ["bash", "--norc", "-c", typed],
                cwd=file.parent,
                env=own,
                start_new_session=True,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=subprocess.STDOUT,
            ) as process,
        ):
            try:
                yield Program(process, output)
            finally:
                end(process)


@dataclass(frozen=True)
class Program:
    """What runs in a terminal."""

    process: subprocess.Popen[bytes]
    output: Path

    @property
    def ended(self) -> bool:
        """By itself."""
        return self.process.poll() is not None

    def said(self) -> str:
        """All that it wrote until now."""
        return self.output.read_text("utf-8", "replace")


def end(process: subprocess.Popen[bytes]) -> None:
    """Ctrl-C; some starters hear none, and then the terminal is closed."""
    for how in (signal.SIGINT, signal.SIGINT, signal.SIGKILL):
        if process.poll() is None:
            os.killpg(process.pid, how)
            try:
                process.wait(10.0)
            except subprocess.TimeoutExpired:
                continue


def until(holds: Callable[[], bool]) -> bool:
    """Wait for it; False where something hangs."""
    deadline_s = time.monotonic() + HANGS_AFTER_S
    while not holds():
        if time.monotonic() > deadline_s:
            return False
        time.sleep(LOOKS_EVERY_S)
    return True


@pytest.fixture
def terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Terminal]:
    """On this computer only, in a domain of its own."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    with leased_domain() as domain:
        yield Terminal(domain, tmp_path)


def is_asked(card: DrillCard) -> bool:
    """Whether it waits for somebody else: a server, a client, a word."""
    others = card.takes or card.gives or card.tells or card.says
    return bool(others or any(node.of(ServiceWords).calls for node in card.nodes))


def names_of(card: DrillCard) -> set[str]:
    """The nodes of its own that it has when it is started without further words."""
    renamed = card.named or card.remaps or card.given
    return set() if renamed else {node.node for node in card.nodes}


def works(one: Drill, program: Program, terminal: Terminal, beside: set[str]) -> None:
    """It does what its card says, as far as it can be seen without anybody who asks it."""
    card = one.card
    prints = () if is_asked(card) else card.prints
    ends = card.exits is not None and not is_asked(card)

    def is_there() -> bool:
        nodes = terminal.nodes() - beside
        all_there = names_of(card) <= nodes and (bool(nodes) or not card.nodes)
        return all_there and all(text in program.said() for text in prints)

    assert until(lambda: program.ended or (is_there() and not ends)), program.said()
    if ends:
        assert program.process.returncode == card.exits, program.said()
    elif card.exits is None and card.nodes:
        assert not program.ended and is_there(), program.said()
    assert all(text in program.said() for text in prints), program.said()
    assert "Traceback" not in program.said(), program.said()


def shows_something(_: Drill, program: Program, terminal: Terminal, beside: set[str]) -> None:
    """It ends, writes, or has a node."""
    assert until(lambda: program.ended or bool(program.said() or terminal.nodes() - beside))
    assert "FileExistsError" not in program.said(), program.said()


def run_by_hand(one: Drill, terminal: Terminal) -> None:
    """Starter and solution, each twice, with what its text wants to run beside it."""
    for source, look in ((one.starter, shows_something), (one.solution, works)):
        file, _ = start(one, terminal.folder / source.stem)
        shutil.copyfile(source, file)
        before = sorted(file.parent.iterdir())
        for _ in range(2):
            with (
                terminal.looked_at(),
                beside_it(one, file.parent, terminal) as others,
                terminal.running(file) as program,
            ):
                look(one, program, terminal, others)
            assert list(terminal.home.iterdir()) == []
            assert sorted(file.parent.iterdir()) == before


@contextmanager
def beside_it(one: Drill, folder: Path, terminal: Terminal) -> Iterator[set[str]]:
    """In another terminal, as the file says; the names of its nodes."""
    if one.card.beside is None:
        yield set()
        return
    wanted = set(one.card.beside.nodes)
    with terminal.running(folder / one.card.beside.file) as program:
        assert until(lambda: wanted <= terminal.nodes()), program.said()
        yield wanted


SHELL = [one for one in all_drills() if one.suffix == ".sh"]
REST = [one for one in all_drills() if one.suffix != ".sh"]


@pytest.mark.slow
@pytest.mark.parametrize("one", [*SHELL, drill("which_first")], ids=lambda one: one.name)
def test_a_script_runs_by_hand(one: Drill, terminal: Terminal) -> None:
    """Those that set up a terminal, and those that write files."""
    run_by_hand(one, terminal)


@pytest.mark.slow
@pytest.mark.parametrize("one", REST, ids=lambda one: one.name)
def test_a_program_runs_by_hand(one: Drill, terminal: Terminal) -> None:
    """All others."""
    run_by_hand(one, terminal)


@pytest.mark.parametrize("one", all_drills(), ids=lambda one: one.name)
def test_a_drill_knows_no_home(one: Drill) -> None:
    """What it writes goes into a folder of its own. A topic may begin with ~."""
    for file in (one.starter, one.solution):
        assert OF_HOME.findall(file.read_text("utf-8")) == []


BESIDE = [one for one in all_drills() if one.card.beside]


@pytest.mark.parametrize("one", BESIDE, ids=lambda one: one.name)
def test_what_runs_beside_comes_along_and_is_told(one: Drill, tmp_path: Path) -> None:
    """The text says what to type, and the file lies there; twice of one name, they are the same."""
    assert one.card.beside
    name = one.card.beside.file
    file, _ = start(one, tmp_path)
    theirs = one.folder / name
    assert (file.parent / name).read_bytes() == theirs.read_bytes()
    for source in (one.starter, one.solution):
        assert f"python3 {name}" in source.read_text("utf-8")
    (file.parent / name).write_text("# mine\n", "utf-8")
    assert start(one, tmp_path) == (file, False)
    assert (file.parent / name).read_text("utf-8") == "# mine\n"
    twins = [each for each in BESIDE if each.day == one.day and (each.folder / name).is_file()]
    assert {(each.folder / name).read_bytes() for each in twins} == {theirs.read_bytes()}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "outcome"),
    [
        ("export ROBOT=rover", "pass"),
        ("ROBOT=rover; export ROBOT", "pass"),
        ("ROBOT=rover", "fail"),
        ("export ROBOT=tower", "fail"),
    ],
)
def test_each_way_to_hand_on_a_variable_mends_the_drill(
    line: str, outcome: str, tmp_path: Path
) -> None:
    """The right value in the shell alone is not enough, and a wrong one is not, either."""
    from fresh import in_fresh_process

    from roslings_learn.drills.running import check

    file = tmp_path / "it.sh"
    one = drill("handed_on")
    file.write_text(one.starter.read_text("utf-8").replace("ROBOT=rover", line), "utf-8")
    assert in_fresh_process(check, one, file).outcome == outcome
