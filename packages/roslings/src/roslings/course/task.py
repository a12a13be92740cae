"""`task.md`: its prose is written by hand, the contract in it is drawn from the card.

A section between `<!-- card: NAME -->` and `<!-- /card -->` belongs to this module; NAME is one
of `SECTIONS`. After a change of the card, `python -m roslings.course.task` writes them anew.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable

from roslings.capability import Words, capabilities
from roslings.course.card import (
    Card,
    GiveUpContract,
    NodeContract,
    OutcomeContract,
    PictureContract,
    QosContract,
    TopicContract,
)
from roslings.course.contract import NUMBERS_WITHIN, as_typed
from roslings.course.files import BadCourseFile
from roslings.course.labs import Lab, all_labs, lab

_SECTION = re.compile(r"(<!-- card: (\w+) -->\n)(.*?)(<!-- /card -->)", re.DOTALL)
_MARK = re.compile(r"<!-- /?card\b")
_EXAMPLES = 3


def task_text(lab: Lab) -> str:
    """What `task.md` should say: the text as it stands, its sections drawn from today's card.

    Raises BadCourseFile for a section that has no end or that `SECTIONS` does not know.
    """
    text = lab.task.read_text("utf-8")
    _insist_on_whole_sections(lab, text)
    return _SECTION.sub(lambda found: _section(lab, text, found), text)


def is_current(lab: Lab) -> bool:
    """Whether `task.md` says what the card says."""
    return lab.task.read_text("utf-8") == task_text(lab)


def write_task(lab: Lab) -> bool:
    """Bring `task.md` up to date with the card; returns whether anything changed."""
    if is_current(lab):
        return False
    lab.task.write_text(task_text(lab), "utf-8")
    return True


def _insist_on_whole_sections(lab: Lab, text: str) -> None:
    rest = _SECTION.sub(lambda found: "\n" * found[0].count("\n"), text)
    if mark := _MARK.search(rest):
        line = rest.count("\n", 0, mark.start()) + 1
        raise BadCourseFile(lab.task, line, "this section of the card has no start or no end")


def _section(lab: Lab, text: str, found: re.Match[str]) -> str:
    start, name, old, end = found.groups()
    if name not in SECTIONS or _MARK.search(old):
        line = text.count("\n", 0, found.start()) + 1
        known = ", ".join(SECTIONS)
        raise BadCourseFile(lab.task, line, f"no such section: {name!r}; there are {known}")
    return start + "\n".join(SECTIONS[name](lab)) + "\n" + end


def _contract(lab: Lab) -> Iterable[str]:
    card = lab.card
    yield from _table(("The package", ""), _package_rows(card))
    for node in card.nodes:
        yield ""
        yield from _table((f"The node `{node.node}`", ""), _node_rows(node))


def _package_rows(card: Card) -> Iterable[tuple[str, ...]]:
    yield "name", f"`{card.package}`"
    yield "build type", f"`{card.build_type}`"
    for picture in card.pictures:
        yield "picture", _picture(picture)
    for document in card.documents:
        yield "file", f"`{document}`"
    for words in _words():
        yield from words.package(card)
    if card.nodes:
        yield "Ctrl-C", f"ends each node within {card.ends_within_s:g} s"


def _picture(picture: PictureContract) -> str:
    least = f"{picture.min_width_px} x {picture.min_height_px}"
    return f"`{picture.path}`, a {picture.format} of at least {least} pixels"


def _node_rows(node: NodeContract) -> Iterable[tuple[str, ...]]:
    yield "executable", f"`{node.executable}`"
    yield from _speaking_rows(node)
    for constant in node.constants:
        yield constant.name.replace("_", " "), f"{constant.value:g} {constant.about}"
    for words in _words():
        yield from words.settings(node)
    if node.other_names:
        yield "also runs as", ", ".join(f"`{name}`" for name in node.other_names)
    if node.log:
        yield "logs", f"`{node.log.format(text='TEXT')}`, TEXT being {node.log_about}"
    for outcome in node.outcomes.values():
        yield outcome.when, _outcome(outcome)
    if node.gives_up:
        yield "without a server", _giving_up(node.gives_up)


def _speaking_rows(node: NodeContract) -> Iterable[tuple[str, ...]]:
    """What goes in and out: topics, then what capabilities know of."""
    topics = {"publishes on": node.publishes, "subscribes to": node.subscribes}
    for verb, topic in ((verb, topic) for verb, each in topics.items() for topic in each):
        yield verb, f"`{topic.topic}`"
        yield from _topic_rows(topic)
    for words in _words():
        yield from words.interface(node)


def _words() -> Iterable[Words]:
    """What the cards of each capability say."""
    return (words for each in capabilities() if (words := each.words_here))


def _outcome(outcome: OutcomeContract) -> str:
    about = f", TEXT being {outcome.log_about}" if outcome.log_about else ""
    text = outcome.log.format(text="TEXT")
    return f"logs `{text}`{about}; ends by itself with exit code {outcome.exit_code}"


def _giving_up(contract: GiveUpContract) -> str:
    return (
        f"logs `{contract.log}` and ends by itself within {contract.within_s:g} s,"
        f" with exit code {contract.exit_code}"
    )


def _topic_rows(topic: TopicContract) -> Iterable[tuple[str, ...]]:
    if topic.about:
        yield "which says", topic.about
    yield "message type", f"`{topic.type}`"
    yield "QoS", _qos(topic.qos)
    if topic.rate:
        rate = topic.rate
        yield "rate", f"{rate.hz:g} Hz; {rate.low_hz:.4g} Hz to {rate.high_hz:.4g} Hz is right"
    if topic.text:
        yield "text", _text(topic.text)
    for name, value in topic.fields.items():
        yield f"field `{name}`", f"`{as_typed(value)}`"
    if topic.numbers_within != NUMBERS_WITHIN:
        yield "its numbers", f"may be off by {topic.numbers_within:g}"


def _qos(qos: QosContract) -> str:
    default = " (the default)" if qos == QosContract() else ""
    if qos.exact:
        return f"just {qos.reliability}, {qos.durability}"
    return f"fits {qos.reliability}, {qos.durability}{default}"


def _text(template: str) -> str:
    if "{n}" not in template:
        return f"`{template}`"
    return f"`{template.format(n=0)}`, next `{template.format(n=1)}`, and so on"


def _points(lab: Lab) -> Iterable[str]:
    rows = ((f"`{check}`", f"{points:g}") for check, points in lab.card.points.items())
    return _table(("check", "points"), rows)


def _free(lab: Lab) -> Iterable[str]:
    return (f"- {freedom}" for freedom in lab.card.not_judged)


def _success(lab: Lab) -> Iterable[str]:
    for node in (node for node in lab.card.nodes if node.log):
        yield f"`{node.executable}` writes:"
        yield ""
        yield "```text"
        yield from _log_lines(lab.card, node)
        yield "```"
        yield ""


def _log_lines(card: Card, node: NodeContract) -> Iterable[str]:
    texts = [topic.text for topic in _all_published(card) if topic.text]
    for text in node.log_examples or [texts[0].format(n=n) for n in range(_EXAMPLES)]:
        line = (node.log or "").format(text=text)
        yield f"[INFO] [...] [{node.node[1:]}]: {line}"


def _all_published(card: Card) -> Iterable[TopicContract]:
    return (topic for node in card.nodes for topic in node.publishes)


def _save_picture(lab: Lab) -> Iterable[str]:
    yield "```bash"
    yield f"./roslings graph --for {lab.name}"
    yield "```"


def _table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> Iterable[str]:
    yield _row(head)
    yield _row(("---",) * len(head))
    yield from map(_row, rows)


def _row(cells: tuple[str, ...]) -> str:
    return "| " + " | ".join(cells) + " |"


SECTIONS: dict[str, Callable[[Lab], Iterable[str]]] = {
    "contract": _contract,
    "points": _points,
    "free": _free,
    "success": _success,
    "picture": _save_picture,
}
"""What a section's name stands for, in the words of the card."""


if __name__ == "__main__":
    for each in [lab(name) for name in sys.argv[1:]] or all_labs():
        print(each.task, "written" if write_task(each) else "unchanged")
