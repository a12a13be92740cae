"""What a `ros2` command finds around it: the ROS prefix, and where it may look for nodes."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.profiles import QUICK_DISCOVERY

LOCAL = "LOCALHOST"
LARGEST_DOMAIN = 232


class BadDomain(CommandProblem):
    """ROS_DOMAIN_ID is no number that ROS can use."""

    def __init__(self, text: str) -> None:
        super().__init__(
            f"ROS_DOMAIN_ID is {text!r}. It must be a whole number from 0 to 101."
            " Set another one, for example: export ROS_DOMAIN_ID=0"
        )


class NoMiddleware(CommandProblem):
    """RMW_IMPLEMENTATION names a middleware that is not installed."""

    def __init__(self, name: str, there: list[str]) -> None:
        super().__init__(
            f"RMW_IMPLEMENTATION is '{name}', and that middleware is not installed here."
            f" There is: {', '.join(there)}. Type: unset RMW_IMPLEMENTATION"
        )


def prepare() -> None:
    """Fill in what this terminal leaves open, for us and for the nodes that we start.

    Without a word about the range only this computer is asked: nothing goes to the network.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", LOCAL)
    os.environ.setdefault("FASTRTPS_DEFAULT_PROFILES_FILE", str(QUICK_DISCOVERY))
    _add_own_prefix()


def _add_own_prefix() -> None:
    """The wheels' environment is an ament prefix, whether the terminal says so or not."""
    prefixes = [p for p in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    if sys.prefix not in prefixes and (Path(sys.prefix) / "share" / "ament_index").is_dir():
        os.environ["AMENT_PREFIX_PATH"] = os.pathsep.join([*prefixes, sys.prefix])


def domain_id() -> int:
    """This terminal's ROS domain. Raises BadDomain."""
    text = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    if not text.isdecimal() or int(text) > LARGEST_DOMAIN:
        raise BadDomain(text)
    return int(text)


def check_middleware() -> None:
    """Raises NoMiddleware: rcl itself would end the program with a cryptic line."""
    from ament_index_python.resources import get_resources

    name = os.environ.get("RMW_IMPLEMENTATION")
    there = sorted(set(get_resources("rmw_typesupport")) - {"rmw_implementation"}) if name else []
    if name and there and name not in there:
        raise NoMiddleware(name, there)


def looks_beyond_this_computer() -> bool:
    """Nodes of other computers may answer too, and nobody knows how many there are."""
    return os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") not in (LOCAL, "OFF")
