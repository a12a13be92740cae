"""Faults of a launch file."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class LaunchFailed(Fault):
    """The launch itself ended with an error."""

    command: str
    how: str
    why = "A launch file starts the whole robot with one command."
    expected = "`{command}` starts its nodes, and goes on until Ctrl-C"
    measured = "it ended by itself ({how})"
    hint = "Read the last lines below, mend what they name, build again, and launch again."


@dataclass(eq=False)
class LaunchMissesNode(LaunchFailed):
    """Not every node is there."""

    missing: str
    found: tuple[str, ...]
    expected = "`{command}` starts {missing}"

    @property
    def measured(self) -> str:  # type: ignore[override]
        """The nodes that are there."""
        return f"the nodes are: {', '.join(self.found) or 'none'}"

    @property
    def hint(self) -> str:  # type: ignore[override]
        """What to compare."""
        line = "<node pkg=... exec=.../>"
        word = "exec"
        if self.command.endswith(".py"):
            line, word = "Node(package=..., executable=...)", "executable"
        return (
            f"Each node needs a line {line} of its own. {word} is the executable of setup.py."
            " Without name=..., a node keeps the name of its code."
        )
