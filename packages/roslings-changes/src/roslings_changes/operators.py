"""The ways in which a solution is made wrong, each by its name.

They were fixed before any run. After the first whole one, what does the same by its form was left
out, by rules that know no lab. That was the depth of a queue, a text that no card names, and
statements moved past others that they do not touch. It was also calls that end ROS or wait for an
end. After the second, a line that writes what no card names was left out. So were a number that no
card names and that is changed a little, and what the starter has word for word. After the third, a
second `close` was left out, and the name of an encoding in other letters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import libcst as cst

from roslings_changes import flow, values
from roslings_changes.source import ModuleSource, New

Operator = Callable[[cst.CSTNode, ModuleSource], Iterator[New]]
"""Gives all that may stand in the place of a node; nothing for most nodes."""

OPERATORS: Mapping[str, Operator] = {
    "number": values.number,
    "unit": values.unit,
    "sign": values.sign,
    "arithmetic": values.arithmetic,
    "comparison": values.comparison,
    "condition": values.condition,
    "name": values.name,
    "text": values.text,
    "drop": flow.drop,
    "double": flow.double,
    "early-return": flow.early_return,
    "blocks": flow.blocks,
    "breaks": flow.breaks,
    "too-early": flow.too_early,
}
