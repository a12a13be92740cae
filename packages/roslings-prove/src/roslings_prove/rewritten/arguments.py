"""Arguments by their names in place of their order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import libcst as cst

from roslings_prove.rewritten.source import Sources, dotted
from roslings_prove.rewritten.trees import (
    all_of,
    argument,
    called,
    classes,
    functions,
    parameters,
    swapped,
)

OF_ROS: Mapping[str, Sequence[str]] = {
    "create_publisher": ("msg_type", "topic", "qos_profile"),
    "create_subscription": ("msg_type", "topic", "callback", "qos_profile"),
    "create_timer": ("timer_period_sec", "callback"),
    "create_service": ("srv_type", "srv_name", "callback"),
    "create_client": ("srv_type", "srv_name"),
    "declare_parameter": ("name", "value", "descriptor"),
    "get_parameter": ("name",),
    "ActionServer": ("node", "action_type", "action_name", "execute_callback"),
    "ActionClient": ("node", "action_type", "action_name"),
    "spin": ("node",),
}
"""How rclpy calls what it takes."""


def keyword_arguments(sources: Sources) -> Sources:
    """`create_timer(timer_period_sec=0.5, callback=self.say_hello)`."""
    known = {**_own(sources), **OF_ROS}
    return sources.mapped(lambda tree: swapped(tree, _by_keyword(tree, known)))


def _own(sources: Sources) -> dict[str, list[str]]:
    """What the package's own functions and methods take; two of one name are left alone."""
    found: dict[str, list[str]] = {}
    for tree in sources.modules.values():
        every = [*functions(tree), *(each for one in classes(tree) for each in functions(one))]
        for each in every:
            is_new = each.name.value not in found
            stars = (each.params.star_arg, each.params.star_kwarg)
            plain = not any(isinstance(star, cst.Param) for star in stars)
            found[each.name.value] = _taken(each) if is_new and plain else []
    return found


def _taken(function: cst.FunctionDef) -> list[str]:
    return [name for name in parameters(function) if name != "self"]


def _by_keyword(
    tree: cst.Module, known: Mapping[str, Sequence[str]]
) -> dict[cst.CSTNode, cst.CSTNode]:
    """The outermost calls; those inside of them stay as they are."""
    found: dict[cst.CSTNode, cst.CSTNode] = {}
    inside: set[cst.CSTNode] = set()
    for call in all_of(tree, cst.Call):
        if call in inside or not _can_name(call, known):
            continue
        found[call] = _named(call, known[called(call)])
        inside |= set(all_of(call, cst.Call))
    return found


def _can_name(call: cst.Call, known: Mapping[str, Sequence[str]]) -> bool:
    """It is called on `self`, by its plain name, or by `rclpy`; all arguments have a name."""
    names = known.get(called(call), ())
    said = dotted(call.func).split(".")
    ours = len(said) == 1 or said[:-1] in (["self"], ["rclpy"], ["self", "node"])
    plain = [arg for arg in call.args if arg.keyword is None]
    stars = any(arg.star for arg in call.args)
    return bool(plain) and ours and not stars and len(plain) <= len(names)


def _named(call: cst.Call, names: Sequence[str]) -> cst.Call:
    args = [
        arg if arg.keyword else argument(arg.value, name).with_changes(comma=arg.comma)
        for arg, name in zip(call.args, (*names, *(" ",) * len(call.args)), strict=False)
    ]
    return call.with_changes(args=args)
