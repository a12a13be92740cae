"""The terminals of a window: each knows its name, and is ready for ROS when it opens."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from jupyter_server_terminals.terminalmanager import TerminalManager

from roslings import course

NAME, FOLDER = "ROSLINGS_TERMINAL", "ROSLINGS_FOLDER"
"""Variables that `terminal.bash` reads: the number that a task names, and the roslings folder."""
SETUP = "setup.bash"


class NamedTerminals(TerminalManager):
    """Jupyter's terminals, which tell the shell what they are called."""

    def new_named_terminal(self, **wanted: Any) -> Any:
        """As Jupyter makes one: under the name that the page asks for, or the next free number."""
        name = wanted.setdefault("name", self._next_available_name())
        more = {**wanted.get("extra_env", {}), NAME: str(name), FOLDER: str(roslings_folder())}
        return super().new_named_terminal(**{**wanted, "extra_env": more})


def roslings_folder() -> Path:
    """The folder with `roslings` and `setup.bash` in it, where the course's commands are typed."""
    places = (course.root(), Path(__file__).parents[6])
    return next((place for place in places if (place / SETUP).is_file()), places[0])
