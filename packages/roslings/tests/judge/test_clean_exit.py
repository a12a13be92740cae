"""An end that is not clean, and one that only looks so."""

from __future__ import annotations

from dataclasses import replace

import pytest

from roslings.evidence import Ending, ExperimentSeen, LogLine, ProcessSeen
from roslings.judge import end_within, exit_cleanly
from roslings.judge.faults import DoesNotEnd, Inconclusive, UncleanExit
from roslings.judge.views import ProcessView
from roslings.seen.exits import must_end_again

ALREADY = "RCLError: failed to shutdown: rcl_shutdown already called on the given context"


def ended(status: int, *lines: str) -> ProcessView:
    """A process that ended after Ctrl-C."""
    process = ProcessSeen(
        executable="it",
        started_ns=0,
        ended_ns=1,
        status=status,
        ending=Ending(signal="SIGINT", after_s=0.1, watched_s=0.1),
        lines=[LogLine(arrival_ns=0, text=line, source="terminal") for line in lines],
    )
    return ProcessView(process, ExperimentSeen(name="x", clock="wall"))


def ended_run(process: ProcessView) -> ExperimentSeen:
    """An experiment with this one process."""
    return process.experiment.model_copy(update={"processes": {"it": process.seen}})


def ended_after(after_s: float | None, waited_s: float, others_s: float = 0.0) -> ProcessView:
    """A process that took so long to end after Ctrl-C; None where 10 s were not enough."""
    process = ended(0)
    process.seen.ending = Ending(
        signal="SIGINT",
        after_s=after_s,
        watched_s=after_s or 10.0,
        waited_s=waited_s,
        others_waited_s=others_s,
    )
    return process


def test_to_wait_for_a_processor_is_no_time_of_its_own() -> None:
    """A busy computer makes every end late."""
    end_within(2.0)(ended_after(2.9, 1.2))
    for late in (ended_after(2.9, 0.3), ended_after(2.9, 0.3, 0.5), ended_after(None, 0.0, 7.0)):
        with pytest.raises(DoesNotEnd):
            end_within(2.0)(late)


@pytest.mark.parametrize("late", [ended_after(2.9, 0.3, 0.7), ended_after(None, 0.0, 9.0)])
def test_what_its_threads_waited_for_is_nobodys_fault(late: ProcessView) -> None:
    """Whether they waited one after the other or at the same time, nobody knows."""
    with pytest.raises(Inconclusive, match="waited for a processor for"):
        end_within(2.0)(late)


@pytest.mark.parametrize(("before", "now"), [(0, 1), (1, 0)])
def test_an_end_that_is_bad_in_one_of_two_runs_is_unclear(before: int, now: int) -> None:
    """Whichever came first."""
    process = replace(ended(now), before=(ended(before).seen,))
    with pytest.raises(Inconclusive, match="in one of two runs"):
        exit_cleanly(process)


def test_an_end_that_is_bad_in_both_runs_is_a_fault() -> None:
    """Seen twice."""
    with pytest.raises(UncleanExit):
        exit_cleanly(replace(ended(1), before=(ended(1).seen,)))
    with pytest.raises(DoesNotEnd):
        end_within(2.0)(replace(ended_after(2.9, 0.3), before=(ended_after(None, 0.0).seen,)))


def test_a_bad_end_is_looked_at_again_unless_it_was_seen_before() -> None:
    """Another experiment can be the second witness."""
    good, bad = ended_run(ended(0)), ended_run(ended(1))
    assert must_end_again(bad, [good], 2.0)
    assert not must_end_again(bad, [bad], 2.0)
    assert not must_end_again(good, [bad], 2.0)


def test_a_quiet_end_is_clean() -> None:
    """Exit code 0 and no traceback."""
    exit_cleanly(ended(0, "Publishing"))


@pytest.mark.parametrize(
    "process",
    [
        ended(1),
        ended(-2, "Traceback (most recent call last):", "KeyboardInterrupt"),
        ended(1, "Traceback (most recent call last):", "in shutdown", ALREADY),
    ],
)
def test_an_error_at_the_end_is_a_fault(process: ProcessView) -> None:
    """A status that is not 0, a traceback, a second shutdown()."""
    with pytest.raises(UncleanExit):
        exit_cleanly(process)


RACE = ("Traceback (most recent call last):", "context.py, line 139, in try_shutdown", ALREADY)


def test_a_race_inside_rclpy_is_nobodys_fault_and_nobodys_merit() -> None:
    """try_shutdown() is the right call; what the node does after it was not seen."""
    with pytest.raises(Inconclusive, match="while rclpy itself was at work"):
        exit_cleanly(ended(1, *RACE))


def test_another_run_tells_what_a_race_has_hidden() -> None:
    """A run of the same experiment, before it or after, else one of another experiment."""
    race, good, bad = ended(1, *RACE), ended(0), ended(1, "Traceback (most recent call last):")
    exit_cleanly(replace(race, before=(good.seen,)))
    exit_cleanly(replace(good, before=(race.seen,)))
    exit_cleanly(replace(race, elsewhere=(race.seen, good.seen)))
    exit_cleanly(replace(race, before=(good.seen,), elsewhere=(bad.seen,)))
    for hidden in (
        replace(race, before=(bad.seen,)),
        replace(bad, before=(race.seen,)),
        replace(race, elsewhere=(bad.seen, race.seen)),
    ):
        with pytest.raises(UncleanExit):
            exit_cleanly(hidden)
    with pytest.raises(Inconclusive, match="in one of two runs"):
        exit_cleanly(replace(race, elsewhere=(good.seen, bad.seen)))


def test_an_end_that_a_race_has_hidden_is_looked_at_again() -> None:
    """Unless the same program was seen to end in another run, well or not."""
    race, good, bad = map(ended_run, (ended(1, *RACE), ended(0), ended(1)))
    assert must_end_again(race, [], 2.0)
    assert must_end_again(race, [race], 2.0)
    assert not must_end_again(race, [good], 2.0)
    assert not must_end_again(race, [race, bad], 2.0)


EXECUTOR = '  File "/opt/ros/jazzy/lib/python3/rclpy/executors.py", line 834, in _spin_once_impl'
INVALID = (
    "rclpy._rclpy_pybind11.RCLError: Failed to publish: publisher's context is invalid,"
    " at ./src/rcl/publisher.c:423"
)
NO_WAIT_SET = (
    "rclpy._rclpy_pybind11.RCLError: failed to initialize wait set: the given context is not valid,"
    " either rcl_init() was not called or rcl_shutdown() was called., at ./src/rcl/wait.c:130"
)


@pytest.mark.parametrize("error", [INVALID, NO_WAIT_SET])
def test_a_context_that_ends_while_the_node_spins_is_nobodys_fault(error: str) -> None:
    """Both were seen of the code that every tutorial shows, with a quick timer."""
    hidden = ended(1, "Traceback (most recent call last):", EXECUTOR, error)
    exit_cleanly(replace(hidden, elsewhere=(ended(0).seen,)))


def test_publishing_after_ctrl_c_is_the_students_fault() -> None:
    """A last command in `except KeyboardInterrupt:` fails each time: the context is gone."""
    after = ("Traceback (most recent call last):", '  File "drive.py", line 9, in main', INVALID)
    with pytest.raises(UncleanExit):
        exit_cleanly(ended(1, *after))


def test_publishing_while_another_error_is_handled_is_the_students_fault() -> None:
    """Two tracebacks: the first is Ctrl-C in the executor, the second the student's own."""
    first = ("Traceback (most recent call last):", EXECUTOR, "KeyboardInterrupt")
    second = ("Traceback (most recent call last):", '  File "drive.py", line 9, in main', INVALID)
    with pytest.raises(UncleanExit):
        exit_cleanly(ended(1, *first, *second))


IGNORED = (
    "Exception ignored in: <function Task.__del__ at 0x7f>",
    "Traceback (most recent call last):",
    '  File "/opt/ros/jazzy/lib/python3/rclpy/task.py", line 50, in __del__',
    "KeyboardInterrupt: ",
)


@pytest.mark.parametrize(
    "process",
    [
        ended(0, *IGNORED),
        replace(
            ended(1, *IGNORED, "Traceback (most recent call last):", EXECUTOR, NO_WAIT_SET),
            elsewhere=(ended(0).seen,),
        ),
    ],
)
def test_ctrl_c_in_a_destructor_is_nobodys_fault(process: ProcessView) -> None:
    """Python writes such a one down and goes on; whatever runs then, nobody chose."""
    exit_cleanly(process)


def test_an_error_that_is_printed_while_all_goes_on_is_a_fault() -> None:
    """Exit code 0 does not hide it."""
    with pytest.raises(UncleanExit):
        exit_cleanly(ended(0, "Traceback (most recent call last):", "KeyError: 'x'"))


def test_an_excused_traceback_does_not_excuse_the_next() -> None:
    """The last one is what the node ended with."""
    again = ("Traceback (most recent call last):", '  File "drive.py", line 9, in main', "KeyError")
    with pytest.raises(UncleanExit):
        exit_cleanly(ended(1, "Traceback (most recent call last):", EXECUTOR, NO_WAIT_SET, *again))
