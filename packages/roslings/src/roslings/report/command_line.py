"""The commands that a verdict names, in the words with which it was asked for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class CommandLine:
    """How to ask for a lab's verdict again, as it was asked for; every word is quoted already."""

    lab: str
    program: str = "./roslings"
    place: tuple[str, ...] = ()
    """Where the package lies, if it was named."""
    options: tuple[str, ...] = ()
    """What else decides what is checked, for example `--port /dev/ttyACM0`."""
    handed_in: bool = True
    """Somebody wants to have the package; nobody wants what only shows how a check works."""

    def check(self, *more: str) -> str:
        """`./roslings check LAB PATH`, then `more`."""
        return " ".join([self.program, "check", self.lab, *self.place, *self.options, *more])

    @property
    def pack(self) -> str:
        """`./roslings pack LAB PATH`."""
        return " ".join([self.program, "pack", self.lab, *self.place])

    @property
    def picture(self) -> str:
        """`./roslings graph --for LAB PATH`."""
        return " ".join([self.program, "graph", "--for", self.lab, *self.place])

    def told(self, text: str) -> str:
        """A fault's text, with the commands in it as they must be typed here."""
        return text.replace(CommandLine(self.lab).picture, self.picture)
