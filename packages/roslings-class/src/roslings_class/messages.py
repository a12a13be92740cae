"""What the command says: how far it is, and what came of all."""

from __future__ import annotations

import statistics
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from ros2_on_pip.safe_text import harmless
from roslings.report.flow import one_line
from roslings_class.gradebook import Gradebook
from roslings_class.result import GradingResult
from roslings_class.scheduler import BatchProgress

WORDS = ("pass", "fail", "refused", "inconclusive")
MEANINGS = {
    "pass": "every check passes",
    "fail": "a check fails",
    "refused": "cannot be graded as handed in",
    "inconclusive": "the machine could not tell",
}
MOST_NAMED = 10
COLUMNS = 80


def standing_line(standing: BatchProgress) -> str:
    """How far the work is, on one line."""
    parts = [f"{standing.done} of {standing.all} graded", f"{standing.working} at work"]
    if standing.unclear:
        parts.append(f"{standing.unclear} to try again")
    if standing.left_s is not None and standing.done < standing.all:
        parts.append(f"about {duration(standing.left_s)} left")
    return ", ".join(parts)


def duration(seconds: float) -> str:
    """A time that nobody needs to the second."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"


def summary_lines(book: Gradebook, names: Sequence[str]) -> list[str]:
    """What came of the submissions called `names`."""
    latest = book.latest()
    results = [latest[name] for name in names if name in latest]
    counts = Counter(result.word for result in results)
    lines = [f"{len(results)} of {len(names)} submissions graded."]
    lines += [f"  {counts[word]:5} {word:13} {MEANINGS[word]}" for word in WORDS if counts[word]]
    lines += _scores(results)
    lines += _named("refused", (result for result in results if result.word == "refused"))
    lines += _named("inconclusive", (r for r in results if r.word == "inconclusive"))
    return lines


def soak_line(results: Iterable[GradingResult]) -> str:
    """How long the nodes were left running, in the gradings that the gradebook holds now."""
    soaked = sorted({result.verdict.soak_s for result in results if result.verdict})
    if not any(soaked):
        return "No node was left running longer than its checks took (--soak SECONDS does that)."
    seconds = " or ".join(f"{each:g}" for each in soaked)
    return f"Besides, the nodes of each were left running for {seconds} s."


def _scores(results: Sequence[GradingResult]) -> list[str]:
    scores = [result.score for result in results if result.score is not None]
    if not scores:
        return []
    median = statistics.median(scores)
    return [f"Scores: lowest {min(scores):g}, median {median:g}, highest {max(scores):g}."]


def _named(word: str, results: Iterable[GradingResult]) -> list[str]:
    """Those that want a person's eye, with the reason."""
    found = list(results)
    if not found:
        return []
    lines = [_wrapped(f"{result.submission}: {_reason(result)}") for result in found[:MOST_NAMED]]
    more = [f"  and {len(found) - MOST_NAMED} more"] if len(found) > MOST_NAMED else []
    return [f"{word.capitalize()}:", *lines, *more]


def _wrapped(text: str) -> str:
    """A reason, whole; where it takes more than a line, the others stand below its words."""
    return textwrap.fill(
        text,
        COLUMNS,
        initial_indent="  ",
        subsequent_indent=" " * 6,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _reason(result: GradingResult) -> str:
    if result.reason:
        return one_line(result.reason)
    checks = result.verdict.checks if result.verdict else ()
    return next((f"{c.id}: {c.why}" for c in checks if c.outcome == "inconclusive"), "")


def root_lines(why: str) -> Iterator[str]:
    """Where root's own number stands behind each sandbox; the sandboxes hold all the same."""
    if why:
        yield f"Sandboxes were root's own here, not another user's: {why}."


def closed_lines(places: Sequence[str]) -> Iterator[str]:
    """Where a node could not write as elsewhere: an open copy of the course lies there."""
    if places:
        yield (
            f"No node could use {', '.join(places)}: a copy of the course with its solutions lies"
            " there, and every user can read it."
        )


def few(label: str, names: Sequence[str], most: int = 8) -> str:
    """How many, and the first of them by name."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    shown = ", ".join(map(harmless, names[:most]))
    return wrapped(f"{label} ({len(names)}): {shown}{more}")


def wrapped(text: str) -> str:
    """A sentence; where it takes more than a line, the others stand below its words."""
    return textwrap.fill(
        text, COLUMNS, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )
