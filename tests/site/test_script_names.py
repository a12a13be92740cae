"""In the site's scripts no name of a value hides a function of the same script."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from roslings.course import root

SCRIPTS = sorted((root() / "site/static").glob("*.js"))
FUNCTION = re.compile(r"\bfunction (\w+)\(")
PARAMETERS = re.compile(
    r"(?:\bfunction \w*|[=(,] ?)\(([\w, ={}\[\]]*)\) (?:=>|\{)|\bfunction \w+\((.*)\) \{"
)
DECLARED = re.compile(r"\b(?:let|const|var) (\w+) =")


def hidden(script: str) -> set[str]:
    """Functions that a parameter or a variable of the same name hides: a call of them fails."""
    lists = (one or other for one, other in PARAMETERS.findall(script))
    parameters = {name for each in lists for name in re.findall(r"\b[a-z]\w*", each)}
    return {*FUNCTION.findall(script)} & (parameters | {*DECLARED.findall(script)})


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.name)
def test_no_value_hides_a_function(script: Path) -> None:
    """`text(...)` in a function whose parameter is `text` is no call of ours."""
    assert hidden(script.read_text("utf-8")) == set()


@pytest.mark.parametrize(
    "script",
    [
        "function text(id) {}\nfunction check(text) {\n}",
        "function text(id) {}\nconst f = (a, text) => {};",
        "function text(id) {}\nlet text = null;",
    ],
)
def test_each_way_to_hide_one_is_found(script: str) -> None:
    """By a parameter of either kind of function, or a variable."""
    assert hidden(script) == {"text"}
