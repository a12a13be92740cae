"""What matches what: our rules are those of the real middleware, and the table asks it."""

from __future__ import annotations

import os
from typing import Any

import pytest

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

from roslings_learn.lessons.qos import RULES, PolicyRule, broken_rules
from roslings_learn.notebook.qos_table import Meeting, QosTable, as_text, meet

WEAKEST = {rule.name: rule.choices[0].words for rule in RULES}
STRONGEST = {rule.name: rule.choices[-1].words for rule in RULES}
PAIRS = [
    pytest.param(rule, o.words, a.words, id=f"{rule.title}: {o.words}, {a.words}")
    for rule in RULES
    for o in rule.choices
    for a in rule.choices
]


@pytest.mark.parametrize(("rule", "offered", "asked"), PAIRS)
def test_a_rule_is_what_the_middleware_does(rule: PolicyRule, offered: str, asked: str) -> None:
    """A real publisher and subscription, alike but for this rule."""
    meeting = meet({**WEAKEST, rule.name: offered}, {**WEAKEST, rule.name: asked})
    assert meeting.matched == rule.holds(offered, asked)
    assert meeting.matched or rule.title in meeting.failed


def test_the_strongest_offer_fits_all_and_the_weakest_breaks_every_rule() -> None:
    """By our rules, and by the middleware, which names one of them."""
    assert not broken_rules(STRONGEST, WEAKEST)
    assert meet(STRONGEST, WEAKEST) == Meeting(matched=True)
    assert broken_rules(WEAKEST, STRONGEST) == list(RULES)
    assert not meet(WEAKEST, STRONGEST).matched


def test_the_text_names_each_rule_with_its_choices() -> None:
    """From weak to strong, for a terminal."""
    lines = as_text().splitlines()
    for rule, line in zip(RULES, lines[:-1], strict=True):
        assert line.startswith(rule.title)
        places = [line.index(choice.words) for choice in rule.choices]
        assert places == sorted(places)


def test_the_table_asks_again_at_each_choice() -> None:
    """It says what ROS said, and each rule that fails."""
    table = QosTable()
    assert "matched" in table.says.value
    table.asked["reliability"].value = "reliable"
    said = table.says.value
    assert "incompatible QoS" in said and "reliability" in said and "No message comes" in said
    table.asked["durability"].value = "transient local"
    assert _named(table) == ["reliability", "durability"]
    table.offered["reliability"].value = "reliable"
    assert _named(table) == ["durability"]
    table.offered["durability"].value = "transient local"
    assert "matched" in table.says.value


def _named(table: Any) -> list[str]:
    return [rule.title for rule in RULES if f"<li><b>{rule.title}</b>" in table.says.value]
