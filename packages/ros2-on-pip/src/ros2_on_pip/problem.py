"""What a command cannot do, said in words that name the next step."""

from __future__ import annotations

from collections.abc import Iterable

from ros2_on_pip.errors import RoslingsError


class CommandProblem(RoslingsError):
    """A command cannot go on; its text is shown, and `ros2` hands `exit_code` to the shell.

    It is ROS's own code; a command of roslings that meets it ends with its `exit_status`.
    """

    exit_code = 1


def did_you_mean(wanted: str, names: Iterable[str]) -> str:
    """` Did you mean NAME?` for the most similar name; empty where none is similar."""
    from ros2_on_pip.near_names import nearest

    near = nearest(wanted, names)
    return f" Did you mean {near.found}?" if near and near.how != "other" else ""


class ServiceNotThere(CommandProblem):
    """No node offers the service."""

    def __init__(self, service: str, there: Iterable[str]) -> None:
        super().__init__(
            f"Unknown service '{service}'.{did_you_mean(service, there)}\n"
            "To see what there is: ros2 service list"
        )
