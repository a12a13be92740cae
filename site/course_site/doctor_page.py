"""The doctor's checks with their mends, read from the code of the doctor itself.

What a mend says depends on the computer, so the steps are read from the source, not by running it.
What is filled in on the computer stands here in capital letters.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
import textwrap
from collections.abc import Callable, Iterator
from itertools import groupby
from typing import Any

from sphinx.application import Sphinx

from course_site.course import MarkdownDirective
from ros_doctor.finding import MendStep
from ros_doctor.pages import FOLDER, page_of
from ros_doctor.registry import DoctorCheck, all_checks

WORDS_OF_A_STEP = ("do", "say")
DEEPEST = 3
SAID_BETTER = {
    "PLACEPATH": "FILE",
    "JOIN": "NAME",
    "STRIP": "TEXT",
    "FOLDERpackage": "FOLDER/package",
    "setup.MACHINE": "setup.bash",
    "DISTRO": "jazzy",
    "SCRIPT": "FOLDER/setup.bash",
    "source PARENT": "source FOLDER/setup.bash",
    "WHY": "",
}
"""What the code calls it, and what a reader understands."""
COMPUTED = "..."
"""A command that is put together from many parts; only the doctor knows it."""


class DoctorChecks(MarkdownDirective):
    """`{doctor-checks}`: a section a theme, in it a section a check."""

    def markdown(self) -> str:
        """What the doctor knows, as Markdown."""
        themes = groupby(all_checks(), key=lambda check: check.theme)
        return "\n\n".join(_theme(theme, list(checks)) for theme, checks in themes)


def _theme(theme: str, checks: list[DoctorCheck]) -> str:
    title = (FOLDER / f"{theme}.md").read_text("utf-8").splitlines()[0]
    return "\n\n".join([f"#{title}", *map(_section, checks)])


def _section(check: DoctorCheck) -> str:
    steps = dict.fromkeys(_said_better(step) for step in steps_of(check.examine))
    mend = "\n".join(_item(step) for step in steps) or "1. Follow what the doctor says there."
    return (
        f"(check-{check.id})=\n### {check.title}\n\n"
        f"**What you see.** {_plain(check.symptom)}\n\n"
        f"{_plain(page_of(check))}\n\n"
        f"**Ways to mend it.** The doctor says which one fits your computer.\n\n{mend}\n\n"
        f"Look at this alone: `./roslings doctor --explain {check.id}`"
    )


def _said_better(step: MendStep) -> MendStep:
    text, command = step.text, step.command
    for ours, readers in SAID_BETTER.items():
        text, command = text.replace(ours, readers), command.replace(ours, readers)
    return MendStep(text, command)


def _item(step: MendStep) -> str:
    text = _plain(step.text) or "Type:"
    if not step.command:
        return f"1. {text}\n"
    if step.command == COMPUTED or step.command.isupper():
        return f"1. {text} the command that the doctor prints.\n"
    command = textwrap.indent(f"```bash\n{step.command}\n```", "   ")
    return f"1. {text}\n\n{command}\n"


def _plain(text: str) -> str:
    """Text that Markdown shows as it is."""
    return re.sub(r"([*_<\[\]])", r"\\\1", text)


# --- reading the steps -------------------------------------------------------------------------


def steps_of(function: Callable[..., Any], depth: int = DEEPEST) -> Iterator[MendStep]:
    """The steps that a function of the doctor may give, in the order of its code."""
    module = sys.modules[function.__module__]
    for call in _calls(ast.parse(textwrap.dedent(inspect.getsource(function)))):
        if call.func.id in WORDS_OF_A_STEP:  # type: ignore[attr-defined]
            yield _step(call)
        else:
            yield from _steps_behind(getattr(module, call.func.id, None), depth)  # type: ignore[attr-defined]
    for name in _names(function):
        constant = getattr(module, name, None)
        if isinstance(constant, tuple):
            yield from (each for each in constant if isinstance(each, MendStep))


def _steps_behind(called: Any, depth: int) -> Iterator[MendStep]:
    ours = inspect.isfunction(called) and called.__module__.startswith("ros_doctor")
    if ours and depth:
        yield from steps_of(called, depth - 1)


def _calls(tree: ast.AST) -> list[ast.Call]:
    found = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    ]
    return sorted(found, key=lambda node: (node.lineno, node.col_offset))


def _names(function: Callable[..., Any]) -> tuple[str, ...]:
    return function.__code__.co_names


def _step(call: ast.Call) -> MendStep:
    texts = [_text(argument) for argument in call.args]
    if call.func.id == "do" and isinstance(call.args[0], ast.Call):  # type: ignore[attr-defined]
        texts[0] = COMPUTED
    named = {each.arg: _text(each.value) for each in call.keywords}
    if call.func.id == "say":  # type: ignore[attr-defined]
        return MendStep(text=texts[0])
    return MendStep(command=texts[0], text=named.get("text", texts[1] if len(texts) > 1 else ""))


def _text(node: ast.expr) -> str:
    """A text in the code; what is computed is shown by its name."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(_text(part) for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return _text(node.value)
    if isinstance(node, ast.BinOp):
        return _text(node.left) + _text(node.right)
    return _last_name(node)


def _last_name(node: ast.expr) -> str:
    """`machine.workspace` and `quoted(machine.workspace)` are both WORKSPACE."""
    names = [each.id for each in ast.walk(node) if isinstance(each, ast.Name)]
    attributes = [each.attr for each in ast.walk(node) if isinstance(each, ast.Attribute)]
    return (attributes or names or ["..."])[-1].upper()


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_directive("doctor-checks", DoctorChecks)
