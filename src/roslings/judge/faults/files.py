"""Faults in the package's own files."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.python_words import syntax_hint


@dataclass(eq=False)
class InvalidPackageXml(Fault):
    """package.xml does not hold what every package.xml holds."""

    problem: str
    why = "ROS tools read package.xml first. If it is not valid, they do not see a ROS package."
    hint = "Open package.xml and mend the line named above. Compare with the lesson's example."

    @property
    def expected(self) -> str:
        """A valid file."""
        return "a valid package.xml"

    @property
    def measured(self) -> str:
        """The first problem."""
        return self.problem


@dataclass(eq=False)
class WrongBuildType(Fault):
    """The package is not of the kind that the lab asks for."""

    wanted: str
    found: str
    why = "colcon looks at the build type to know how to build the package."

    @property
    def expected(self) -> str:
        """The wanted kind."""
        return f"the build type {self.wanted}"

    @property
    def measured(self) -> str:
        """The kind that is there."""
        return f"the build type {self.found}" if self.found else "no build type in package.xml"

    @property
    def hint(self) -> str:
        """The line to write."""
        return "Look at <build_type> inside <export> at the end of package.xml."


@dataclass(eq=False)
class MissingFile(Fault):
    """A file that every ament_python package has is not there."""

    path: str
    why = "Each of these files tells ROS one thing: where the code is, and what it is called."

    @property
    def expected(self) -> str:
        """The file."""
        return f"the file {self.path}"

    @property
    def measured(self) -> str:
        """That it is missing."""
        return f"there is no {self.path} in the package"

    @property
    def hint(self) -> str:
        """Where it comes from."""
        return (
            "`ros2 pkg create` makes this file. Make a package beside yours and see what it holds."
        )


@dataclass(eq=False)
class SyntaxErrorInCode(Fault):
    """Python cannot read one of the files."""

    place: str
    why = "Python reads a whole file before it runs one line of it."

    @property
    def expected(self) -> str:
        """Readable code."""
        return "Python code that Python can read"

    @property
    def measured(self) -> str:
        """File, line and Python's words."""
        return self.place

    @property
    def hint(self) -> str:
        """What these words ask for."""
        return syntax_hint(self.place) or (
            "Look at that line and the one above it: a missing colon, bracket or quotation mark?"
        )


@dataclass(eq=False)
class UnlistedDependency(Fault):
    """The code imports a package that package.xml does not name."""

    package: str
    place: str
    why = (
        "On another machine ROS installs only what package.xml names. There, your node would stop."
    )

    @property
    def expected(self) -> str:
        """The package in package.xml."""
        return f"{self.package} in package.xml, because {self.place} imports it"

    @property
    def measured(self) -> str:
        """That it is not named."""
        return f"package.xml does not name {self.package}"

    @property
    def hint(self) -> str:
        """Where to look."""
        if self.package.startswith("python3-"):
            return f"Add one line: this library has the name {self.package} in package.xml."
        return (
            "Look at the <exec_depend> lines in package.xml: one for each ROS package that you"
            " import."
        )


@dataclass(eq=False)
class BuildFailed(Fault):
    """colcon did not build the package."""

    seconds: float
    why = "What is not built cannot be run with `ros2 run`."
    hint = "Run `colcon build` in your workspace. Read the first error, not the last one."

    @property
    def expected(self) -> str:
        """A build."""
        return "`colcon build` ends without an error"

    @property
    def measured(self) -> str:
        """That it failed."""
        return f"`colcon build` failed after {self.seconds:.1f} s"


@dataclass(eq=False)
class NotAnAmentPackage(Fault):
    """colcon built it, but as plain Python that ROS does not see."""

    found: str | None
    why = "colcon built it as plain Python. ROS does not find such a package."
    hint = "Mend package.xml: name, e-mail and <build_type>ament_python</build_type>."

    @property
    def expected(self) -> str:
        """A ROS package."""
        return "colcon takes it for a ROS package (ros.ament_python)"

    @property
    def measured(self) -> str:
        """What colcon took it for."""
        return f"colcon took it for {self.found or 'nothing that it knows'}"


@dataclass(eq=False)
class NoExecutable(Fault):
    """An executable of the contract is not installed."""

    wanted: str
    found: tuple[str, ...]
    package: str
    why = "`ros2 run` starts what setup.py lists under console_scripts, and nothing else."

    @property
    def expected(self) -> str:
        """The executable."""
        return f"`ros2 run {self.package} {self.wanted}` finds an executable"

    @property
    def measured(self) -> str:
        """What there is."""
        there = ", ".join(self.found) if self.found else "none"
        return f"the package has these executables: {there}"

    @property
    def hint(self) -> str:
        """Where to look."""
        return "Look at entry_points in setup.py: one text 'name = module:function' for each node."
