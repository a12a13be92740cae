"""What a program writes counts once, however it is written; all that counts asks one place."""

from __future__ import annotations

import ast
from collections.abc import Iterator

import pytest

from roslings.course import lab, root
from roslings.evidence import ExperimentSeen, LogLine, ProcessSeen, Qos, Spoken
from roslings.judge import ExperimentView, Fault
from roslings.judge.demands import insist_on_at_most, log_each, repeat
from roslings.judge.faults import LoggedAgain
from roslings.judge.views import Demand, ProcessView
from sources import code_of
from ways_to_write import WAYS, written

ENGINE, LEARN = code_of("roslings"), code_of("roslings_learn")
LISTENER = lab("topics").card.nodes[1]
STATUS = lab("nodes").card.nodes[0]
OK = ("Publishing: 'OK 1'", "Publishing: 'OK 2'")
HEARD = Spoken(
    topic="/news",
    type="std_msgs/msg/String",
    content={"data": "amber"},
    sent_ns=0,
    matched=True,
    offered=Qos(reliability="reliable", durability="volatile", depth=1),
)


def wrote(*texts: str, way: str = "print", **others: list[str]) -> ProcessView:
    """A process that wrote these lines, one each nanosecond, beside `others`."""
    named = {"it": list(texts), **others}
    processes = {name: ran(name, lines) for name, lines in named.items()}
    seen = ExperimentSeen(name="x", clock="wall", processes=processes)
    return ExperimentView(written(seen, way)).labelled("it")


def ran(name: str, texts: list[str]) -> ProcessSeen:
    """A process with these lines on its terminal."""
    lines = [LogLine(arrival_ns=n, text=text, source="terminal") for n, text in enumerate(texts)]
    return ProcessSeen(executable=name, started_ns=0, lines=lines)


@pytest.mark.parametrize("way", WAYS)
def test_each_line_is_there_once(way: str) -> None:
    """One that is written twice, twice."""
    assert wrote("a", "b", "a", way=way).texts == ["a", "b", "a"]


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    ("demand", "lines"),
    [
        (log_each(STATUS, ["OK 1", "OK 2"]), OK),
        (repeat(LISTENER, [HEARD]), (str(LISTENER.log).format(text="amber"),)),
        (lambda process: insist_on_at_most(process, OK[:1], 1), OK[:1]),
    ],
)
def test_who_counts_lines_counts_each_once(
    demand: Demand[ProcessView], lines: tuple[str, ...], way: str
) -> None:
    """And finds one that is written again."""
    wrote(*lines, way=way).must(demand)
    with pytest.raises(LoggedAgain):
        wrote(*lines, lines[0], way=way).must(demand)


@pytest.mark.parametrize("way", ["print", "get_logger", "get_logger, unheard", "both"])
def test_what_another_process_logs_is_its_own(way: str) -> None:
    """All nodes of an experiment are heard on /rosout."""
    assert wrote("mine", way=way, other=["mine", "yours"]).texts == ["mine"]


def test_what_was_logged_before_it_began_is_of_another() -> None:
    """Programs that are started one after the other, and write no terminal."""
    seen = ProcessSeen(executable="it", started_ns=50)
    logs = [LogLine(arrival_ns=at, text=f"at {at}", source="rosout") for at in (40, 60)]
    experiment = ExperimentSeen(name="x", clock="wall", rosout={"it": logs})
    assert ProcessView(seen, experiment).texts == ["at 60"]


def test_a_log_of_several_lines_is_as_many() -> None:
    """The terminal shows the decorations of the first one alone."""
    shown = [
        LogLine(arrival_ns=1, text=text, source="terminal")
        for text in ("[INFO] [1.0] [it]: one", "two")
    ]
    heard = [LogLine(arrival_ns=2, text="one\ntwo", source="rosout")]
    seen = ProcessSeen(executable="it", started_ns=0, lines=shown)
    experiment = ExperimentSeen(name="x", clock="wall", rosout={"it": heard})
    assert ProcessView(seen, experiment).texts == ["one", "two"]


def test_what_looks_like_a_decoration_stays_in_a_logged_text() -> None:
    """`[3]: x`, said by get_logger(), is no line of another logger."""
    shown = [LogLine(arrival_ns=1, text="[INFO] [1.0] [it]: [3]: x", source="terminal")]
    heard = [LogLine(arrival_ns=2, text="[3]: x", source="rosout")]
    seen = ProcessSeen(executable="it", started_ns=0, lines=shown)
    experiment = ExperimentSeen(name="x", clock="wall", rosout={"it": heard})
    assert ProcessView(seen, experiment).texts == ["[3]: x"]


# --- nobody goes another way -------------------------------------------------------------------


LINES_OF_A_PROCESS = {
    "judge/lines.py": "what it wrote",
    "judge/views.py": "the lines of its end",
    "judge/unobserved.py": "how often it writes: a rate",
    "judge/floods.py": "the last lines of what has no end",
    "drills/answers.py": "predictions are of what a terminal shows",
}
"""Who reads the terminal or /rosout itself, and why."""


def _readers() -> Iterator[str]:
    """Modules that judge, and read `seen.lines` or `rosout` of evidence."""
    rooms = (ENGINE / "judge", ENGINE / "capabilities", LEARN / "drills", root() / "graders")
    for room in rooms:
        for file in sorted(room.rglob("*.py")):
            if any(map(_reads, ast.walk(ast.parse(file.read_text("utf-8"))))):
                yield file.relative_to(room.parent).as_posix()


def _reads(node: ast.AST) -> bool:
    if not isinstance(node, ast.Attribute):
        return False
    of = node.value
    name = of.attr if isinstance(of, ast.Attribute) else getattr(of, "id", "")
    processes = isinstance(of, ast.Subscript) and "processes" in ast.dump(of.value)
    return node.attr == "rosout" or (node.attr == "lines" and (name == "seen" or processes))


def test_all_that_judges_lines_asks_one_place() -> None:
    """Else the next one counts what is logged twice, or tells our Ctrl-C as a mistake."""
    assert set(_readers()) == set(LINES_OF_A_PROCESS)


def test_the_number_is_the_same_in_each_way() -> None:
    """A line too many is told with its number, in each way."""
    told = set()
    for way in WAYS:
        with pytest.raises(Fault) as raised:
            wrote(OK[0], OK[0], way=way).must(lambda p: insist_on_at_most(p, OK[:1], 1))
        told.add(str(raised.value))
    assert len(told) == 1 and "2 times" in told.pop()
