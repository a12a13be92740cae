"""A judge that has read grader, card and hints before a stranger's code runs.

It waits in a process of its own, whose checks are loaded: what happens to their files later does
not matter to it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any

from roslings.course import Lab
from roslings.evidence import Evidence
from roslings.judge.judge import judge, judge_later
from roslings.verdict import Verdict

Judge = Callable[[Evidence, int | None], Verdict]
LOADED = "loaded"


@contextmanager
def judge_for(lab: Lab, strangers: bool) -> Iterator[Judge]:
    """A judge for one package: of a stranger's, one that has loaded all before it is built."""
    if strangers:
        with judge_loaded(lab) as found:
            yield found
    else:
        yield lambda evidence, began_ns: judge(lab, evidence, began_ns)


@contextmanager
def judge_loaded(lab: Lab) -> Iterator[Judge]:
    """A judge for one package, which has loaded all that it judges by. Raises BadGrader."""
    ours, theirs = get_context("fork").Pipe()
    process = get_context("fork").Process(target=_live, args=(lab, ours, theirs), daemon=True)
    process.start()
    theirs.close()
    try:
        _answer(ours)
        yield lambda evidence, began_ns: _asked(ours, evidence, began_ns)
    finally:
        ours.close()
        process.kill()
        process.join()


def _asked(ours: Connection, evidence: Evidence, began_ns: int | None) -> Verdict:
    ours.send((evidence.model_dump_json(by_alias=True), began_ns))
    return Verdict.model_validate_json(_answer(ours))


def _answer(ours: Connection) -> str:
    """What the judge says; its error is raised here."""
    answer: Any = ours.recv()
    if isinstance(answer, Exception):
        raise answer
    return str(answer)


def _live(lab: Lab, ours: Connection, theirs: Connection) -> None:
    """In the judge's process, to its end."""
    ours.close()
    try:
        verdict = judge_later(lab, lambda: _wait(theirs))
    except EOFError:
        return  # nobody asks any more
    except Exception as error:
        theirs.send(error)
    else:
        theirs.send(verdict.model_dump_json(by_alias=True))


def _wait(theirs: Connection) -> tuple[Evidence, int | None]:
    """All is loaded: wait for what was seen."""
    theirs.send(LOADED)
    text, began_ns = theirs.recv()
    return Evidence.model_validate_json(text), began_ns
