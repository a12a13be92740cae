"""Lines on the cable on the page: how they begin, and the bad ones, marked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.language import said
from ros2_on_pip.markup import Markup, joined, tag
from roslings.capabilities.serial.record import BoardSeen, CableLine, SerialSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.timeline_svg import cut, in_experiment
from roslings_rover.models.board_lines import BadLine, unframed

FIRST = 6
"""So many lines of each side are shown; the bad ones besides."""
MOST_BAD = 20
BOARD = "From the board: {count} lines{lost}"
NODE = "From the node: {count} lines, {refused} refused by the board"


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment with a board: what went over the cable."""
    figures = [
        _figure(seen, board)
        for seen in evidence.experiments.values()
        if (board := seen.part(SerialSeen).board) is not None
    ]
    if figures:
        words = "The first lines of each side, and those that are no line of the card, underlined."
        note = tag("p", said("page.cable.about", words), class_="about")
        yield tag("section", tag("h2", said("page.cable", "Lines on the cable")), note, *figures)


def _figure(seen: ExperimentSeen, board: BoardSeen) -> Markup:
    return tag(
        "figure",
        tag("h3", in_experiment(seen.name)),
        tag("p", said("page.cable.board", BOARD, count=len(board.told), lost=_lost(board))),
        _lines(board.told),
        tag("p", said("page.cable.node", NODE, count=len(board.heard), refused=board.rejected)),
        _lines(board.heard),
    )


def _lost(board: BoardSeen) -> str:
    if not board.lost_bytes:
        return ""
    late = "; {count} bytes were read too late, and are lost"
    return said("page.cable.lost", late, count=board.lost_bytes)


def _lines(lines: Sequence[CableLine]) -> Markup:
    bad = [line for line in lines if _is_bad(line)]
    shown = {id(line): line for line in (*lines[:FIRST], *bad[:MOST_BAD])}
    told = sorted(shown.values(), key=lambda line: line.board_s)
    return tag("pre", *(part for line in told for part in _told(line))) if told else Markup()


def _told(line: CableLine) -> Iterator[Markup]:
    text = cut(line.text)
    yield joined(f"{line.board_s:9.3f} s  ", tag("mark", text) if _is_bad(line) else text, "\n")


def _is_bad(line: CableLine) -> bool:
    """It is not framed as the card has it: no `$`, or a wrong checksum."""
    try:
        unframed(line.text.removeprefix("$").encode("utf-8", "replace"))
    except BadLine:
        return True
    return not line.text.startswith("$")
