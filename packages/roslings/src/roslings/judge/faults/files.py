"""Faults in the package's own files."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.python_words import SYNTAX_HINTS, syntax_mistake
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class InvalidPackageXml(Fault):
    """package.xml does not hold what every package.xml holds."""

    problem: str
    why = "ROS tools read package.xml first. If it is not valid, they do not see a ROS package."
    hint = "Open package.xml and mend the line named above. Compare with the lesson's example."
    expected = "a valid package.xml"

    measured = "{problem}"


@dataclass(eq=False)
class WrongBuildType(Fault):
    """The package is not of the kind that the lab asks for."""

    wanted: str
    found: str
    why = "colcon looks at the build type to know how to build the package."
    expected = "the build type {wanted}"
    hint = "Look at <build_type> inside <export> at the end of package.xml."

    measured = one_of(
        another="the build type {found}",
        none="no build type in package.xml",
    )

    @property
    def which_measured(self) -> str:
        """Whether one is there."""
        return "another" if self.found else "none"


@dataclass(eq=False)
class MissingFile(Fault):
    """A file that every ament_python package has is not there."""

    path: str
    why = "Each of these files tells ROS one thing: where the code is, and what it is called."
    expected = "the file {path}"
    measured = "there is no {path} in the package"
    hint = "`ros2 pkg create` makes this file. Make a package beside yours and see what it holds."


@dataclass(eq=False)
class SyntaxErrorInCode(Fault):
    """Python cannot read one of the files."""

    place: str
    why = "Python reads a whole file before it runs one line of it."
    expected = "Python code that Python can read"

    measured = "{place}"

    hint = one_of(
        **SYNTAX_HINTS,
        other="Look at that line and the one above it: a missing colon, bracket or quotation mark?",
    )

    @property
    def which_hint(self) -> str:
        """What Python's words ask for."""
        return syntax_mistake(self.place) or "other"


@dataclass(eq=False)
class UnlistedDependency(Fault):
    """The code imports a package that package.xml does not name."""

    package: str
    place: str
    why = (
        "On another machine ROS installs only what package.xml names. There, your node would stop."
    )
    expected = "{package} in package.xml, because {place} imports it"
    measured = "package.xml does not name {package}"

    hint = one_of(
        library="Add one line: this library has the name {package} in package.xml.",
        package="Look at the <exec_depend> lines in package.xml: one for each ROS package that you"
        " import.",
    )

    @property
    def which_hint(self) -> str:
        """A Python library, or a package of ROS."""
        return "library" if self.package.startswith("python3-") else "package"


@dataclass(eq=False)
class BuildFailed(Fault):
    """colcon did not build the package."""

    seconds: float
    why = "What is not built cannot be run with `ros2 run`."
    hint = "Run `colcon build` in your workspace. Read the first error, not the last one."
    expected = "`colcon build` ends without an error"
    measured = "`colcon build` failed after {seconds:.1f} s"


@dataclass(eq=False)
class NotAnAmentPackage(Fault):
    """colcon built it, but as plain Python that ROS does not see."""

    found: str | None
    why = "colcon built it as plain Python. ROS does not find such a package."
    hint = "Mend package.xml: name, e-mail and <build_type>ament_python</build_type>."
    expected = "colcon takes it for a ROS package (ros.ament_python)"

    measured = one_of(
        another="colcon took it for {found}",
        nothing="colcon took it for nothing that it knows",
    )

    @property
    def which_measured(self) -> str:
        """Whether colcon took it for anything."""
        return "another" if self.found else "nothing"


@dataclass(eq=False)
class NoExecutable(Fault):
    """An executable of the contract is not installed."""

    wanted: str
    found: tuple[str, ...]
    package: str
    why = "`ros2 run` starts what setup.py lists under console_scripts, and nothing else."
    expected = "`ros2 run {package} {wanted}` finds an executable"
    hint = "Look at entry_points in setup.py: one text 'name = module:function' for each node."

    measured = one_of(
        some="the package has these executables: {found}",
        none="the package has these executables: none",
    )

    @property
    def which_measured(self) -> str:
        """Whether there are others."""
        return "some" if self.found else "none"
