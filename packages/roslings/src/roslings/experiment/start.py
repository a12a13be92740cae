"""How a node is started: with parameters, and under another name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from roslings.course import NodeContract
from roslings.course.contract import as_typed


@dataclass(frozen=True)
class Start:
    """What stands behind `ros2 run PACKAGE EXECUTABLE`.

    >>> Start(named="/left/first", parameters={"period": 0.2}).arguments()
    ['--ros-args', '-r', '__node:=first', '-r', '__ns:=/left', '-p', 'period:=0.2']
    """

    named: str | None = None
    """The full name that the node is to take; None leaves it its own."""
    parameters: Mapping[str, bool | int | float | str] = field(default_factory=dict)

    def arguments(self, remaps: Sequence[str] = (), simulated: bool = False) -> list[str]:
        """The words of the command line; `simulated` makes the node follow /clock."""
        rules = [word for rule in (*self._names(), *remaps) for word in ("-r", rule)]
        values = [
            word
            for name, value in {**self.parameters, **(SIMULATED if simulated else {})}.items()
            for word in ("-p", f"{name}:={as_typed(value)}")
        ]
        return ["--ros-args", *rules, *values] if rules or values else []

    def label(self, node: NodeContract) -> str:
        """What the process is called in the evidence."""
        return self.named or node.executable

    def _names(self) -> list[str]:
        if self.named is None:
            return []
        space, _, name = self.named.rpartition("/")
        return [f"__node:={name}", f"__ns:={space or '/'}"]


SIMULATED = {"use_sim_time": True}
PLAIN = Start()
"""As it is, with nothing behind the name of the executable."""
