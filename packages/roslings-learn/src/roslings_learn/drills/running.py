"""Run a drill's program behind the machine's wall, and judge what was seen, all in one process.

The process is a fork of one that has loaded ROS and the judge. So a drill begun in `watch` waits
for nothing but its own program. Who may fork stands in `experiment.forked`.
"""

from __future__ import annotations

import ast
import os
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from roslings.arena import Installed, Isolation, choose_isolation, kernel, ros_environment
from roslings.arena.environment import base_environment
from roslings.course.grader import Experiment, load_grader
from roslings.evidence import ExperimentSeen
from roslings.experiment.assignment import Assignment
from roslings.experiment.measuring import MeasuringContext
from roslings.experiment.preload import TYPES
from roslings.experiment.run_folder import run_folder
from roslings.experiment.scene import Scene
from roslings.judge import ExperimentView, Fault
from roslings.judge.faults import SyntaxErrorInCode
from roslings.probe.preload import load_ros
from roslings.seen.exits import must_end_again
from roslings_learn.drills.answers import require_answer
from roslings_learn.drills.card import PROGRAM
from roslings_learn.drills.course import Drill
from roslings_learn.drills.judging import DrillVerdict, failed, judged
from roslings_learn.drills.steps import BY_END, BY_GRAPH, ENDS_WITHIN_S, Step, steps_of
from roslings_learn.drills.student import program_in
from roslings_learn.drills.watching import BESIDE, ROS2, watch

LONGEST_S = 120.0
"""A run that takes longer is broken off: the machine's fault, or ours."""
START = '#!/bin/sh\nexec "{program}" "{file}" "$@"\n'
MORE_RUNS = 2
"""A busy computer is given two more chances, and a bad end."""


class RunBrokeOff(RoslingsError):
    """The measuring process ended without a verdict: the machine's fault, or ours."""

    exit_status = INCONCLUSIVE

    def __init__(self, drill: str, words: str) -> None:
        super().__init__(f"The run of {drill!r} broke off.\n{words}".rstrip())


# --- in the command's process ------------------------------------------------------------------


@cache
def load(drill: Drill) -> None:
    """Load what the runs of a drill need: once, before the first save."""
    with suppress(Exception):  # what cannot be loaded is told by the run that needs it
        os.environ.update(ros_environment(choose_isolation().wall))
        load_ros(TYPES.findall(drill.card.model_dump_json()))
        if drill.check:
            load_grader(drill.check)


@dataclass(frozen=True)
class Begun:
    """A run under way."""

    drill: Drill
    process: Any
    answer: Connection
    errors: Path
    began_s: float

    def verdict(self) -> DrillVerdict:
        """Wait for it. Raises RunBrokeOff."""
        try:
            if not self.answer.poll(LONGEST_S):
                raise EOFError
            found: DrillVerdict = self.answer.recv()
        except EOFError:
            words = self.errors.read_text("utf-8", "replace").splitlines()[-20:]
            raise RunBrokeOff(self.drill.name, "\n".join(words)) from None
        return found.taking(round(time.monotonic() - self.began_s, 3))


@contextmanager
def begun(drill: Drill, file: Path, began_s: float | None = None) -> Iterator[Begun]:
    """Run the program in `file`; its seconds count from `began_s` on (monotonic)."""
    load(drill)
    began_s = time.monotonic() if began_s is None else began_s
    walls = choose_isolation()
    source = program_in(file, drill)
    with run_folder() as folder:
        assignment = Assignment(
            lab=drill.name,
            seed=int.from_bytes(os.urandom(4), "big"),
            wall=walls.wall,
            sandbox=walls.sandbox,
            folder=folder,
        )
        assignment.make_folders()
        ours, theirs = get_context("fork").Pipe(duplex=False)
        words = (drill, file.name, source, walls, assignment, theirs, ours, os.getpid())
        process = get_context("fork").Process(target=_live, args=words)
        process.start()
        theirs.close()
        try:
            yield Begun(drill, process, ours, assignment.errors, began_s)
        finally:
            ours.close()
            process.kill() if process.is_alive() and not _ends(process) else None
            process.join()


def _ends(process: Any) -> bool:
    process.join(ENDS_WITHIN_S)
    return process.exitcode is not None


def check(drill: Drill, file: Path, began_s: float | None = None) -> DrillVerdict:
    """The verdict on the program in `file`. Raises RunBrokeOff, and what `program_in` raises."""
    began_s = time.monotonic() if began_s is None else began_s
    if verdict := unrun(drill, file):
        return verdict.taking(round(time.monotonic() - began_s, 3))
    with begun(drill, file, began_s) as run:
        return run.verdict()


def unrun(drill: Drill, file: Path) -> DrillVerdict | None:
    """The verdict where the file need not be run: no Python, or no answer in it; else None."""
    try:
        readable(drill, file.name, program_in(file, drill))
    except SyntaxErrorInCode as fault:
        return failed(drill.name, "reads", "Python can read the file.", fault)
    except Fault as fault:
        return failed(drill.name, "answer", "The file holds your answer.", fault)
    return None


def check_many(
    runs: Sequence[tuple[Drill, Path]], at_once: int
) -> Iterator[tuple[int, DrillVerdict]]:
    """The verdict on each program, by its place in `runs`, as they come."""
    waiting = list(enumerate(runs))
    with ExitStack() as stack:
        under_way: dict[Connection, tuple[int, Begun, ExitStack]] = {}
        while waiting or under_way:
            while waiting and len(under_way) < at_once:
                number, (drill, file) = waiting.pop(0)
                if verdict := unrun(drill, file):
                    yield number, verdict
                    continue
                own = stack.enter_context(ExitStack())
                run = own.enter_context(begun(drill, file))
                under_way[run.answer] = number, run, own
            ready = wait(list(under_way))
            for answer in [each for each in under_way if each in ready]:
                number, run, own = under_way.pop(answer)
                with own:
                    yield number, run.verdict()


def readable(drill: Drill, name: str, program: bytes) -> Any:
    """What the student has foretold; None where nothing is asked.

    Raises SyntaxErrorInCode, and what `require_answer` raises.
    """
    if drill.card.program != "python":
        return None
    source = program.decode("utf-8", errors="replace")
    try:
        compile(ast.parse(source), name, "exec", dont_inherit=True)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None) or 1
        words = getattr(error, "msg", None) or str(error)
        raise SyntaxErrorInCode(f"{name}, line {line}: {words}") from error
    if drill.card.answer is None:
        return None
    return require_answer(source, drill.starter.read_text("utf-8"), drill.card.answer)


# --- in the fork -------------------------------------------------------------------------------


def _live(
    drill: Drill,
    name: str,
    source: bytes,
    walls: Isolation,
    assignment: Assignment,
    answer: Connection,
    ours: Connection,
    begun_by: int,
) -> None:
    """To its end: go behind the wall, run the program, judge, answer."""
    os.setsid()
    ours.close()
    _redirect(assignment.errors)
    os.chdir(assignment.folder)
    walls.enter(assignment.room, assignment.sandbox)
    kernel.die_with_parent()
    os.environ["ROS_LOG_DIR"] = str(assignment.folder / "log")
    os.environ.update(ros_environment(assignment.wall))
    if os.getppid() != begun_by:
        return
    installed = _installed(drill, name, source, assignment)
    said = readable(drill, name, source) if drill.card.answer else None
    verdict = _verdict(drill, said, MeasuringContext(installed, assignment, ENDS_WITHIN_S))
    answer.send(verdict.without(f"{installed.folder}{os.sep}"))
    os._exit(0)  # the interpreter's own end takes 0.2 s, and leaves nothing that we need


def _redirect(errors: Path) -> None:
    with errors.open("wb") as file, Path(os.devnull).open("rb") as nothing:
        os.dup2(nothing.fileno(), 0)
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    sys.stdout = sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115


def _installed(drill: Drill, name: str, source: bytes, assignment: Assignment) -> Installed:
    """The program as an executable, in the room that the process was put into."""
    folder = assignment.room / "install"
    folder.mkdir()
    (folder / name).write_bytes(source)
    interpreter = sys.executable if drill.card.program == "python" else shutil.which("bash")
    _executable(folder / PROGRAM, str(interpreter), folder / name)
    if drill.card.beside:
        path = folder / f"{BESIDE}_{drill.card.beside.file}"
        shutil.copy(drill.folder / drill.card.beside.file, path)
        _executable(folder / BESIDE, sys.executable, path)
    environment = base_environment(assignment.home)
    if drill.card.program == "bash" and (ours := our_ros2()):
        _executable(folder / "ros2", sys.executable, ours)
        environment["PATH"] = os.pathsep.join([str(folder), environment["PATH"]])
    return Installed(folder, environment, folder)


def our_ros2() -> Path | None:
    """The course's own `ros2`, where this environment has no other: its start, as a file."""
    found = Path(sys.prefix) / "bin" / "ros2"
    ours = found.is_file() and b"roslings" in found.read_bytes()
    return ROS2 / "start.py" if ours else None


def _executable(path: Path, program: str, file: Path) -> None:
    path.write_text(START.format(program=program, file=file), "utf-8")
    path.chmod(0o755)


def _verdict(drill: Drill, said: Any, stage: MeasuringContext) -> DrillVerdict:
    """Run and judge, and no longer than until a verdict stands: the student waits for it."""
    steps, before = _steps(drill, said), list[ExperimentSeen]()
    for seen in _runs(drill, stage):
        verdict = _judged(drill, steps, seen, before)
        if _stands(seen, verdict, before):
            break
        before.append(seen)
    answer = drill.card.answer if verdict.outcome == "pass" else None
    return replace(verdict, because=answer.because if answer else "")


def _runs(drill: Drill, stage: MeasuringContext) -> Iterator[ExperimentSeen]:
    """As of a lab's experiment; what is in doubt after those is run again, in real time."""
    experiment = Experiment(
        drill.name,
        lambda scene: _watch(drill, scene),
        clock="auto" if drill.card.follows_the_clock else "wall",
    )
    yield from stage.runs(experiment, 0, ())
    for _ in range(MORE_RUNS):
        yield from stage.runs(replace(experiment, clock="wall"), 0, ())


def _judged(
    drill: Drill, steps: Sequence[Step], seen: ExperimentSeen, before: Sequence[ExperimentSeen]
) -> DrillVerdict:
    """What no clock can bend first: it counts, whatever came of the rest."""
    believed = tuple(run for run in before if not run.doubt)
    view = ExperimentView(seen, believed)
    by_graph = judged(drill.name, steps, view, only_graph=True)
    return by_graph if by_graph.outcome == "fail" else judged(drill.name, steps, view)


def _stands(seen: ExperimentSeen, verdict: DrillVerdict, before: Sequence[ExperimentSeen]) -> bool:
    """Whether no other run could tell more: this one is believed, or no clock can bend it."""
    if verdict.outcome == "pass" or seen.prints_without_end:
        return True
    if verdict.outcome == "inconclusive":
        return False
    if verdict.first and verdict.first.id in BY_END:
        return not must_end_again(seen, before, ENDS_WITHIN_S)
    return seen.doubt is None or bool(verdict.first and verdict.first.id in BY_GRAPH)


def _watch(drill: Drill, scene: Scene) -> None:
    own = _own(drill, "watch")
    own(scene, drill.card) if own else watch(drill.card, scene)


def _steps(drill: Drill, said: Any) -> list[Step]:
    own = _own(drill, "steps")
    return [*steps_of(drill.card, said), *(own(drill.card) if own else ())]


def _own(drill: Drill, name: str) -> Any:
    """A function of the drill's own `check.py`; None where it has none."""
    return getattr(load_grader(drill.check), name, None) if drill.check else None


__all__ = ["Begun", "RunBrokeOff", "begun", "check", "check_many", "load", "readable", "unrun"]
