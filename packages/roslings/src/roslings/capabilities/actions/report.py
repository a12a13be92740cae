"""Goals on the page: when each was given, its feedback, and how it ended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.markup import Markup, tag
from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.actions.record import ActionsSeen, GoalSeen
from roslings.evidence import Evidence, ExperimentSeen
from roslings.report.html.scale import time_text
from roslings.report.html.timeline_svg import (
    Bar,
    Look,
    TimelineRow,
    fields_text,
    in_experiment,
    table,
    timeline,
)

MOST_GOALS = 30
HEAD = (
    Text("page.goals.goal", "goal"),
    Text("page.goals.end", "end"),
    Text("page.goals.after", "after"),
    Text("page.goals.feedback", "feedback"),
    Text("page.goals.fields", "fields"),
    Text("page.goals.result", "result"),
)


def sections(evidence: Evidence) -> Iterator[Markup]:
    """For each experiment with goals, given to the node or by it: a timeline and a table."""
    figures = [_figure(seen) for seen in evidence.experiments.values() if _goals_of(seen)]
    if figures:
        words = (
            "The first bar of a goal is the wait for its answer, the second the work; a dot is"
            " a feedback. A red bar has no end."
        )
        note = tag("p", said("page.goals.about", words), class_="about")
        yield tag("section", tag("h2", said("page.goals", "Goals of actions")), note, *figures)


def _goals_of(seen: ExperimentSeen) -> list[GoalSeen]:
    part = seen.part(ActionsSeen)
    return sorted((*part.goals, *part.orders), key=lambda goal: goal.sent_ns)


def _figure(seen: ExperimentSeen) -> Markup:
    goals = _goals_of(seen)[:MOST_GOALS]
    lines = [_line(seen, goal, goals) for goal in goals]
    rows = [_row(seen, goal) for goal in goals]
    ends = Counter(_end_of(seen, goal) for goal in goals)
    told = ", ".join(f"{number} {end}" for end, number in ends.items())
    words = counted(
        "page.goals.count",
        len(goals),
        one="{count} goal: {ends}.",
        other="{count} goals: {ends}.",
        ends=told,
    )
    heading = tag("h3", in_experiment(seen.name))
    return tag(
        "figure",
        heading,
        timeline(lines, words),
        tag("figcaption", words),
        table(said("page.goals.table", "goals of actions"), HEAD, rows),
    )


def _line(seen: ExperimentSeen, goal: GoalSeen, goals: Sequence[GoalSeen]) -> TimelineRow:
    began_ns, last_ns = goals[0].sent_ns, max(map(_last_ns, goals))

    def bar(from_ns: int, to_ns: int | None, look: Look) -> Bar:
        end_ns, look = (last_ns, "missing") if to_ns is None else (to_ns, look)
        return Bar((from_ns - began_ns) / NS_PER_S, (end_ns - began_ns) / NS_PER_S, look)

    bars = [bar(goal.sent_ns, goal.answered_ns, "answered")]
    if goal.accepted and goal.answered_ns and not _is_order(seen, goal):
        bars.append(bar(goal.answered_ns, goal.ended_ns, "working"))
    dots = tuple((at_ns - began_ns) / NS_PER_S for at_ns in _feedback_ns(seen, goal))
    return TimelineRow(goal.part or goal.action, tuple(bars), dots)


def _is_order(seen: ExperimentSeen, goal: GoalSeen) -> bool:
    """A node gave it to the grader, which knows how it ended: it is no news."""
    return any(goal is order for order in seen.part(ActionsSeen).orders)


def _last_ns(goal: GoalSeen) -> int:
    return max(filter(None, (goal.sent_ns, goal.answered_ns, goal.ended_ns)))


def _feedback_ns(seen: ExperimentSeen, goal: GoalSeen) -> list[int]:
    """When the feedback of this goal came, where the topic was watched."""
    heard = seen.topics.get(goal.feedback_topic)
    contents = [(each.arrival_ns, each.content) for each in heard.messages] if heard else []
    return [
        at_ns
        for at_ns, content in contents
        if isinstance(content, dict) and _id_of(content) == goal.id
    ]


def _id_of(content: dict[str, object]) -> object:
    held = content.get("goal_id")
    return held.get("uuid") if isinstance(held, dict) else None


def _row(seen: ExperimentSeen, goal: GoalSeen) -> tuple[str, ...]:
    feedback = len(_feedback_ns(seen, goal))
    ended = goal.ended_ns is not None
    took = time_text(((goal.ended_ns or 0) - goal.sent_ns) / NS_PER_S) if ended else "-"
    result = fields_text(goal.result) if goal.result else "-"
    return (
        goal.part or goal.action,
        _end_of(seen, goal),
        took,
        f"{feedback}",
        fields_text(goal.goal),
        result,
    )


def _end_of(seen: ExperimentSeen, goal: GoalSeen) -> str:
    if goal.answered_ns is None:
        return said("page.goals.not_answered", "not answered")
    if not goal.accepted:
        return said("page.goals.refused", "refused")
    if _is_order(seen, goal):
        return said("page.goals.by_grader", "accepted by the grader")
    return goal.status or said("page.goals.no_end", "without an end")
