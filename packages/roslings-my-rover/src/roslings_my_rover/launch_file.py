"""The wiring as a launch file: what the rover starts, as day 8 writes it."""

from __future__ import annotations

from collections.abc import Iterator
from xml.sax.saxutils import quoteattr

from roslings_my_rover.chosen import ChosenParts
from roslings_my_rover.wiring import StartArguments, wired

PORT, DEVICE = "/tmp/ttyROVER", "/tmp/rover_camera"
HEAD = """\
<!-- The parts of your rover, wired as in it. ./roslings my-rover has the relay besides,
     and turns the wheels: this file alone drives nothing. -->"""


def launch_file(choice: ChosenParts) -> str:
    """As XML, for `ros2 launch FILE`: a node for each program of each part that is there."""
    return "\n".join(["<launch>", HEAD, *_nodes(choice), "</launch>"])


def _nodes(choice: ChosenParts) -> Iterator[str]:
    programs = wired([each.part for each in choice.there], PORT, DEVICE).programs
    for each in choice.there:
        if each.part.only_in_rooms:
            continue
        package = each.lab.outline.package
        for name in each.part.programs:
            yield from _node(package, name, programs[name])


def _node(package: str, name: str, link: StartArguments) -> Iterator[str]:
    head = f"  <node pkg={quoteattr(package)} exec={quoteattr(name)}"
    if not (link.remaps or link.parameters):
        yield f"{head}/>"
        return
    yield f"{head}>"
    for source, target in link.remaps:
        yield f"    <remap from={quoteattr(source)} to={quoteattr(target)}/>"
    for parameter, value in link.parameters:
        yield f"    <param name={quoteattr(parameter)} value={quoteattr(value)}/>"
    yield "  </node>"
