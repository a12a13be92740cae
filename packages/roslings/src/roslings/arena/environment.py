"""The whole environment that a student's process gets: an allow-list, never our own.

What is not listed does not reach the process, so that it behaves the same for everybody:
PYTHONUNBUFFERED, PYTHONPATH of another project, ROS_LOCALHOST_ONLY, proxies, secrets.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Literal

from ros2_on_pip.profiles import QUICK_DISCOVERY

Wall = Literal["namespace", "domain", "user"]
HERE = Path(__file__).parent

INHERITED = (
    "PATH",
    "LD_LIBRARY_PATH",
    "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
    "AMENT_PREFIX_PATH",
    "ROS_DISTRO",
    "ROS_VERSION",
    "ROS_PYTHON_VERSION",
    "SYSTEMROOT",
)
MIDDLEWARE = "rmw_fastrtps_cpp"
LOOPBACK_ONLY = HERE / "loopback_only.xml"
PACED = HERE / "paced.xml"
LOSSY_LINK = HERE / "lossy_link.xml"

TRANSPORT: dict[Wall, dict[str, str]] = {
    # A private /dev/shm has no use for shared memory, and LOCALHOST would ignore UDPv4: a wrong
    # mix shows the publisher and delivers nothing.
    "namespace": {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
        "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
    },
    "domain": {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
    # The profile's own transport: every other range puts its own in the profile's place.
    "user": {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT"},
}


def ros_environment(wall: Wall, paced: bool = False) -> dict[str, str]:
    """What both sides, the probe and the student's nodes, must agree on.

    Where it is `paced`, messages of many pieces arrive whole, though a kernel has little room for
    them before their receiver. What a node offers and asks for stays its own.
    """
    profile = LOOPBACK_ONLY if wall == "user" else PACED if paced else QUICK_DISCOVERY
    return {
        "RMW_IMPLEMENTATION": MIDDLEWARE,
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(profile),
        **({"RMW_FASTRTPS_PUBLICATION_MODE": "ASYNCHRONOUS"} if paced else {}),
        **TRANSPORT[wall],
    }


def base_environment(home: Path, hidden_package: str | None = None) -> dict[str, str]:
    """What a build or a node may see of this machine.

    `hidden_package` is the package under test. A version of it that the student has sourced in this
    terminal must not stand in for the one that is handed in.
    """
    kept = {name: os.environ[name] for name in INHERITED if name in os.environ}
    if "LD_LIBRARY_PATH" not in kept:
        kept.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    return {
        **kept,
        "PATH": _path(kept.get("PATH", os.defpath)),
        "AMENT_PREFIX_PATH": _prefixes(kept.get("AMENT_PREFIX_PATH", ""), hidden_package),
        **_python_path(),
        "HOME": str(home),
        "TMPDIR": str(home),
        "ROS_LOG_DIR": str(home / "log"),
        "TERM": "dumb",
        "LANG": "C.UTF-8",
        "NO_COLOR": "1",
        "RCUTILS_COLORIZED_OUTPUT": "0",
    }


def _path(inherited: str) -> str:
    """This environment's own programs first."""
    return os.pathsep.join([str(Path(sys.executable).parent), inherited])


def _prefixes(inherited: str, hidden_package: str | None) -> str:
    """The ament prefixes: the sourced ones, or this environment where nothing is sourced."""
    prefixes = [p for p in inherited.split(os.pathsep) if p and Path(p).is_dir()]
    if hidden_package:
        prefixes = [p for p in prefixes if not (Path(p) / "share" / hidden_package).exists()]
    if not prefixes or (Path(sys.prefix) / "share" / "ament_index").is_dir():
        prefixes = [sys.prefix, *(p for p in prefixes if p != sys.prefix)]
    return os.pathsep.join(prefixes)


def _python_path() -> dict[str, str]:
    """An apt installation reaches Python through PYTHONPATH; keep only ROS's part and ours."""
    parts = [Path(part) for part in os.environ.get("PYTHONPATH", "").split(os.pathsep) if part]
    kept = [p for p in parts if (p / "rclpy").is_dir() or p.is_relative_to(sys.prefix)]
    ours = [str(part) for part in kept]
    return {"PYTHONPATH": os.pathsep.join(ours)} if ours else {}
