"""The grading platforms: what each is given, and what keeps a student's code from the grade there.

The files of a platform are `templates/NAME/`. A word between two `@` in their text or names is
filled in. There are `@LAB@`, `@TITLE@`, `@PACKAGE@`, `@UUID@`, and `@HIDDEN@`, the option for
hidden checks. Others say what apt is to bring for this lab: `@SYSTEM@`, `@ALSO@` behind other
packages, `@QUOTED@` in JSON.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.language import Text

TEMPLATES = Path(__file__).parent / "templates"
COMPILER, HEADERS = "g++", "python3-dev"
OF_SYSTEM = {"interfaces": (COMPILER, HEADERS)}
"""Group of a lab's card to the packages of Debian and Ubuntu that its Python packages need. Message
types that come built with the course need none."""


@dataclass(frozen=True)
class System:
    """One platform."""

    name: str
    about: Text
    upload: Text
    """What the instructor puts where."""
    wall: Text
    course: str
    """Where in the bundle the course goes."""
    keeps_hidden: bool
    """Students cannot read what is uploaded: hidden checks may be in it."""
    has: frozenset[str] = frozenset()
    """Packages of the system that its image has in a way of its own."""

    @property
    def templates(self) -> Path:
        """The folder with its files."""
        return TEMPLATES / self.name


PYTHON_IMAGE = frozenset({HEADERS})
"""The image `python:3.12` has a Python of its own, with its headers."""
_ALL = (
    System(
        "gradescope",
        Text("export.gradescope.about", "Gradescope, a programming assignment"),
        Text(
            "export.gradescope.upload",
            "all that is in the folder, as one zip file: Configure Autograder",
        ),
        Text(
            "export.gradescope.wall",
            "the sandbox of namespaces where the container may make one, else a user of its "
            "own; without either nothing is run, and there is no grade. A user of its own "
            "does not stop the network",
        ),
        "course",
        keeps_hidden=True,
    ),
    System(
        "github",
        Text("export.github.about", "GitHub Classroom, with its autograding reporter"),
        Text(
            "export.github.upload",
            "template/ as the assignment's template repository, grader/ as a repository of yours",
        ),
        Text(
            "export.github.wall",
            "the sandbox of namespaces. It does not keep students from editing the workflow: "
            "protect .github/, and grade their clones once more with ./roslings grade",
        ),
        "grader/course",
        keeps_hidden=False,
    ),
    System(
        "classroom50",
        Text("export.classroom50.about", "Classroom 50"),
        Text(
            "export.classroom50.upload",
            "autograders/ into your classroom's folder of the classroom50 repository",
        ),
        Text(
            "export.classroom50.wall",
            "the sandbox of namespaces. The grader comes from your repository, but runs in "
            "the student's: grade their clones once more with ./roslings grade",
        ),
        "autograders/@LAB@/course",
        keeps_hidden=False,
    ),
    System(
        "prairielearn",
        Text("export.prairielearn.about", "PrairieLearn, an external grader"),
        Text(
            "export.prairielearn.upload",
            "the image that Containerfile makes, and question/ into your course",
        ),
        Text(
            "export.prairielearn.wall",
            "the sandbox of namespaces where the container may make one, else a user of its "
            "own; without either nothing is run, and there is no grade. PrairieLearn itself "
            "stops the network",
        ),
        "course",
        keeps_hidden=True,
        has=PYTHON_IMAGE,
    ),
    System(
        "moodle-vpl",
        Text("export.moodle-vpl.about", "Moodle, Virtual Programming Lab"),
        Text(
            "export.moodle-vpl.upload",
            "vpl_run.sh and vpl_evaluate.sh as execution files; course/ onto the execution server",
        ),
        Text(
            "export.moodle-vpl.wall",
            "the sandbox of namespaces alone: VPL runs everything as one user without rights."
            " Where its jail allows no namespaces, nothing is run, and there is no grade",
        ),
        "course",
        keeps_hidden=False,
    ),
    System(
        "gitlab",
        Text("export.gitlab.about", "GitLab CI, with a badge"),
        Text(
            "export.gitlab.upload",
            "the folder as a project of yours; students' projects take its .gitlab-ci.yml",
        ),
        Text(
            "export.gitlab.wall",
            "the sandbox of namespaces where the container may make one, else a user of its "
            "own; without either nothing is run, and there is no grade. It does not keep "
            "students from editing their own CI file: name yours in the settings of their "
            "projects",
        ),
        "course",
        keeps_hidden=False,
        has=PYTHON_IMAGE,
    ),
    System(
        "github-ci",
        Text("export.github-ci.about", "GitHub Actions, with a badge"),
        Text("export.github-ci.upload", "the folder into a student's repository"),
        Text(
            "export.github-ci.wall",
            "the sandbox of namespaces. Students own the repository: the badge is for "
            "themselves, it is no grade",
        ),
        ".roslings",
        keeps_hidden=False,
    ),
)
SYSTEMS = {system.name: system for system in _ALL}
