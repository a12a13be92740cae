"""How a process ended after Ctrl-C: in time or late, cleanly or not.

Experiments use it to look at a bad end a second time; checks use it to judge.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from roslings.evidence import ExperimentSeen, LogLine, ProcessSeen

NS_PER_S = 1e9


def simulated_life_s(process: ProcessSeen, seen: ExperimentSeen) -> float:
    """Seconds of simulated time that went by until it ended; 0 where the clock never moved."""
    ended_ns = process.ended_ns or process.started_ns
    lived = [tick.sim_ns for tick in seen.ticks if tick.at_ns <= ended_ns]
    return (lived[-1] - lived[0]) / NS_PER_S if lived else 0.0


def is_outlived(label: str, run: ExperimentSeen, counted: ExperimentSeen) -> bool:
    """A process ended by itself in simulated time, and in real time ran for longer than that.

    What ended it is the clock: it shows 0 at a node's start, as no real one does.
    """
    ended, again = run.processes[label], counted.processes.get(label)
    if run.clock != "sim" or not ended.ended_by_itself or again is None:
        return False
    if counted.clock == "sim" or again.ended_by_itself:
        return False
    until_ns = again.asked_to_end_ns or again.ended_ns or again.started_ns
    return (until_ns - again.started_ns) / NS_PER_S > simulated_life_s(ended, run)


def is_told_in_real_time(label: str, run: ExperimentSeen, counted: ExperimentSeen) -> bool:
    """What a process's end in simulated time is worth is known: in real time it ended, too, or not.

    Else it was not watched for as long there.
    """
    again = counted.processes.get(label)
    ended_too = run.clock == "sim" and counted.clock == "wall" and again and again.ended_by_itself
    return bool(ended_too) or is_outlived(label, run, counted)


def is_late(seen: ProcessSeen, limit_s: float) -> bool:
    """After Ctrl-C it took more than `limit_s` of its own time, or had to be killed."""
    if seen.ending is None:
        return False
    own_s = seen.ending.own_s
    return own_s is None or own_s > limit_s


def is_unclean(seen: ProcessSeen) -> bool:
    """It ended after Ctrl-C, with another exit code than 0 or with a traceback of the student's."""
    mistakes = [trace for trace in tracebacks(seen) if not _is_interrupted_destructor(trace)]
    return is_whole(seen) and (seen.status != 0 or bool(mistakes))


def is_whole(seen: ProcessSeen) -> bool:
    """It ended after Ctrl-C, and all that it did then was seen.

    Of a node that ended in a race of rclpy's nobody knows what it would have done next. One that
    shuts down a second time got no further than the first.
    """
    hidden = seen.status != 0 and _ends_in_a_race(tracebacks(seen))
    return seen.ended_after_ctrl_c and not hidden


def must_end_again(seen: ExperimentSeen, earlier: Iterable[ExperimentSeen], limit_s: float) -> bool:
    """An end is in doubt, and no other experiment has told more of its executable.

    One bad end is no proof. Of some thousand nodes that end well, one did not, on a busy computer,
    and nothing that was measured told why. One that is not whole is no proof either.
    """
    known = [process for each in earlier for process in each.processes.values()]
    return any(
        _is_in_doubt(process, [p for p in known if p.executable == process.executable], limit_s)
        for process in seen.processes.values()
    )


def _is_in_doubt(seen: ProcessSeen, others: Iterable[ProcessSeen], limit_s: float) -> bool:
    """`others`: how the same executable ended elsewhere."""
    if _is_bad(seen, limit_s):
        return not any(_is_bad(each, limit_s) for each in others)
    return seen.ended_after_ctrl_c and not any(map(is_whole, [seen, *others]))


def _is_bad(seen: ProcessSeen, limit_s: float) -> bool:
    return is_late(seen, limit_s) or is_unclean(seen)


def tracebacks(seen: ProcessSeen) -> list[list[str]]:
    """Each traceback's lines, from the line before it, which tells what Python did with it."""
    texts = [line.plain for line in seen.lines if line.text.strip()]
    starts = [i for i, text in enumerate(texts) if text.startswith("Traceback")]
    ends = [*starts, len(texts)][1:]
    return [texts[max(i - 1, 0) : end] for i, end in zip(starts, ends, strict=True)]


def without_interrupt(seen: ProcessSeen) -> list[LogLine]:
    """What it wrote, without the tracebacks that began after we had asked it to end.

    Ctrl-C is ours: of a node that did not do its task, the KeyboardInterrupt is no explanation.
    """
    asked_ns, kept, inside = seen.asked_to_end_ns, [], False
    for line in seen.lines:
        asked = asked_ns is not None and line.arrival_ns >= asked_ns
        text = LAUNCHED.sub("", line.text)
        if asked and text.startswith(BEGINNINGS):
            inside = True
        elif not inside:
            kept += [line] if text.strip() or not asked else []
        elif text.strip() and not text.startswith(" "):  # the error itself: its last line
            inside = False
    return kept


BEGINNINGS = (
    "Traceback (most recent",
    "Exception ignored ",
    "Exception in thread",
    "During handling of ",
    "The above exception was",
)
"""How the lines begin that Python writes of an error that nobody catches, or of one in a chain."""
LAUNCHED = re.compile(r"^\[[^\]\s]+-\d+\] ")
"""What `ros2 launch` writes before each line of a node."""


def _ends_in_a_race(traces: Sequence[Sequence[str]]) -> bool:
    """Ctrl-C ended rclpy's context while rclpy itself worked with it: no fault of the student's.

    rclpy's signal handler shuts the context down in another thread, whatever the node does then. It
    was seen where that came between the two steps of try_shutdown(), in a callback that publishes,
    and before a wait. It came once in some twenty endings of a node that is busy with messages, and
    once in four with a 2 kHz timer. The last traceback is the one that the node ended with. One
    before it can be Ctrl-C in a destructor, where Python says so and goes on.
    """
    last = traces[-1] if traces else []
    return _between_two_steps_of_try_shutdown(last) or _in_the_executor(last)


def _is_interrupted_destructor(trace: Sequence[str]) -> bool:
    return "Exception ignored in" in trace[0] and any(
        text.startswith("KeyboardInterrupt") for text in trace
    )


def _between_two_steps_of_try_shutdown(trace: Sequence[str]) -> bool:
    inside = any("in try_shutdown" in text for text in trace)
    return inside and any("rcl_shutdown already called" in text for text in trace)


def _in_the_executor(trace: Sequence[str]) -> bool:
    """Not what a node does by itself after spin(): that fails each time, and is to be mended."""
    spinning = any("/rclpy/executors.py" in text for text in trace)
    return spinning and any(_tells_of_ended_context(text) for text in trace)


def _tells_of_ended_context(text: str) -> bool:
    return "RCLError" in text and ("context is invalid" in text or "context is not valid" in text)
