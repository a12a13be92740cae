"""The page of what matches what: its fields follow the rules that the notebook's table has."""

from __future__ import annotations

from typing import Any

import pytest
from two_days_site import Visit

from roslings_learn.lessons.qos import RULES, broken_rules
from skips import imported

pytestmark = pytest.mark.slow

Axe = imported("axe_playwright_python.sync_playwright").Axe
PAGE = "reference/qos.html"


def choose(page: Any, side: str, choices: dict[str, str]) -> None:
    """Choose, by hand as a reader does, what one side says."""
    for rule in RULES:
        field = page.locator("fieldset", has=page.locator("legend", has_text=rule.title)).first
        field.locator(f'select[data-side="{side}"]').select_option(label=choices[rule.name])


def test_a_pair_is_judged_by_the_rules(visit: Visit) -> None:
    """All weak, all strong, and each rule alone."""
    page = visit.go(PAGE)
    weak = {rule.name: rule.choices[0].words for rule in RULES}
    says = page.locator(".qos-says")
    assert says.inner_text() == "They match: messages come."
    for rule in RULES:
        asked = {**weak, rule.name: rule.choices[-1].words}
        choose(page, "asked", asked)
        assert broken_rules(weak, asked) == [rule]
        assert rule.broken in says.inner_text()
        assert page.locator("form.qos-play fieldset.wrong").count() == 1
    choose(page, "offered", {rule.name: rule.choices[-1].words for rule in RULES})
    assert says.inner_text() == "They match: messages come."


def test_the_pair_stands_there_in_python(visit: Visit) -> None:
    """As the lesson writes it; what is not limited is left out."""
    page = visit.go(PAGE)
    code = page.locator(".qos-code")
    assert "deadline" not in code.inner_text()
    page.locator('select[data-side="asked"]').nth(2).select_option(label="0.2 s")
    assert "asked = QoSProfile(" in code.inner_text()
    assert "deadline=Duration(seconds=0.2)" in code.inner_text()
    names: dict[str, Any] = {"Duration": lambda seconds: seconds, "QoSProfile": dict}
    policies = ("ReliabilityPolicy", "DurabilityPolicy", "LivelinessPolicy")
    names |= {name: Named() for name in policies}
    exec(code.inner_text(), names)  # it is Python
    assert names["asked"]["deadline"] == 0.2


class Named:
    """Stands for a class of policies: each of its names is its own value."""

    def __getattr__(self, name: str) -> str:
        """The name."""
        return name


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_pair_that_fails_is_accessible(browser: Any, site: Any, scheme: str) -> None:
    """On a phone too."""
    context = browser.new_context(viewport={"width": 390, "height": 900}, color_scheme=scheme)
    page = Visit(context, site.as_uri()).go(PAGE)
    page.locator('select[data-side="asked"]').first.select_option(index=1)
    assert page.locator("fieldset.wrong").count() == 1
    assert Axe().run(page).generate_snapshot() == ""
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    context.close()


def test_without_javascript_the_tables_say_the_same(browser: Any, site: Any) -> None:
    """One for each rule, with as many pairs as it has."""
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / PAGE).as_uri())
    assert not page.locator("form.qos-play").is_visible()
    for rule in RULES:
        section = page.locator("section", has=page.locator("h2", has_text=rule.title.capitalize()))
        cells = section.last.locator("tbody td").all_inner_texts()
        found = [text for text in cells if text in ("yes", "no")]
        holds = [rule.holds(o.words, a.words) for o in rule.choices for a in rule.choices]
        assert found == ["yes" if each else "no" for each in holds]
    context.close()
