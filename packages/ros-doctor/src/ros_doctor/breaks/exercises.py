"""The ten exercises: what is broken, what to look for, and which checks grade the mend."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.breaks import injuries

RUN = ("colcon build", "source install/setup.bash", "ros2 run greeter hello")
LAUNCH = ("colcon build", "source install/setup.bash", "ros2 launch greeter greet.launch.xml")


@dataclass(frozen=True)
class Exercise:
    """One exercise. `checks` are the doctor's checks that must be well after the mend.

    A workspace exercise has an `injure`; a terminal exercise has `variables`, which a file
    sets when the student sources it. `builds` marks an injury that needs a real build.
    """

    number: int
    name: str
    title: str
    commands: tuple[str, ...]
    look_for: str
    checks: tuple[str, ...]
    learned: str
    injure: Callable[[Path], None] | None = None
    variables: tuple[tuple[str, str], ...] = ()
    builds: bool = False

    @property
    def in_terminal(self) -> bool:
        """True where a terminal is injured and not a workspace."""
        return bool(self.variables)


EXERCISES = (
    Exercise(
        1,
        "entry-point",
        "The program that does not start",
        RUN,
        "Which error comes? Read its last line, and find that word in your files.",
        ("ws-entry-points",),
        "An entry point has three parts: program = file:function. All must exist.",
        injure=injuries.misspell_function,
    ),
    Exercise(
        2,
        "no-executable",
        "The program that ros2 does not find",
        RUN,
        "The build is fine. What does ros2 run say? Where did the program go in install?",
        ("ws-setup-cfg",),
        "setup.cfg puts programs into lib/PACKAGE, where ros2 run looks.",
        injure=injuries.remove_setup_cfg,
    ),
    Exercise(
        3,
        "missing-depend",
        "The package that works only here",
        ("cat src/greeter/package.xml", "cat src/greeter/greeter/hello.py"),
        "Which import of hello.py has no line in package.xml?",
        ("ws-depends",),
        "package.xml names each package that your code imports.",
        injure=injuries.forget_depend,
    ),
    Exercise(
        4,
        "launch-file",
        "The launch file that is not there",
        LAUNCH,
        "The file is in src. What does ros2 launch say? Look into install/greeter/share.",
        ("ws-launch",),
        "data_files in setup.py installs what is not Python code.",
        injure=injuries.forget_launch_file,
    ),
    Exercise(
        5,
        "twins",
        "The backup in the workspace",
        ("colcon build",),
        "colcon stops before it builds. Which two folders does it name?",
        ("ws-twins",),
        "Each package in a workspace has a name of its own. COLCON_IGNORE hides a folder.",
        injure=injuries.leave_a_backup,
    ),
    Exercise(
        6,
        "wrong-folder",
        "The build in the wrong folder",
        ("ls", "ls src"),
        "Which folders in src do not belong there? Where should they be?",
        ("ws-in-src",),
        "Build in the root of the workspace: the folder that holds src.",
        injure=injuries.build_inside_src,
    ),
    Exercise(
        7,
        "old-build",
        "The change that does nothing",
        ("source install/setup.bash", "ros2 run greeter hello", "cat src/greeter/greeter/hello.py"),
        "What does the node say? What does the file say?",
        ("ws-stale",),
        "A build makes copies. After a change, build again.",
        builds=True,
    ),
    Exercise(
        8,
        "domain",
        "The domain that is no number",
        ("ros2 run demo_nodes_py talker",),
        "Which variable does the error name? What is its value?",
        ("domain-id",),
        "ROS_DOMAIN_ID is a whole number from 0 to 101.",
        variables=(("ROS_DOMAIN_ID", "seven"),),
    ),
    Exercise(
        9,
        "discovery",
        "The nodes that never meet",
        ("ros2 run demo_nodes_py talker", "ros2 topic list"),
        "Use two injured terminals, one for each command. Why is /chatter not in the list?",
        ("discovery-range",),
        "The range OFF hides a node even on its own computer.",
        variables=(("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"),),
    ),
    Exercise(
        10,
        "middleware",
        "The middleware that does not exist",
        ("ros2 run demo_nodes_py talker",),
        "Which name does the error give? Compare it letter by letter with rmw_fastrtps_cpp.",
        ("middleware",),
        "RMW_IMPLEMENTATION must name an installed middleware, or not be set.",
        variables=(("RMW_IMPLEMENTATION", "rmw_fastrtps_ccp"),),
    ),
)
