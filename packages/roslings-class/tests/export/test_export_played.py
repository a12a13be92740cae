"""Each platform, played with the reference package: what it would read is right, and complete.

The folders, users, variables and limits are those that the platforms publish: the sources stand in
`schemas/`. What is not played is said: the platforms' own images, jails and networks.
"""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from pathlib import Path
from xml.etree.ElementTree import fromstring

import jsonschema
import pytest
from played import LAB, ORDINARY, Played, played
from test_export_results import schema

from roslings.course import lab
from skips import needs

pytestmark = [
    pytest.mark.slow,
    needs("root"),
]
TEN_MINUTES_S = 600.0
NO_NAMESPACES = {"ROSLINGS_ISOLATION": "user"}
"""As in a container without further rights: each grading is a user of its own."""


HIDDEN = '''
"""One more check, as the page on hidden checks shows them."""
from roslings.judge import PackageView, check

POINTS = {"secret": 25}


@check()
def test_secret(package: PackageView) -> None:
    """A secret."""
    assert not package.files.name, "the package has a name"
'''
"""The solution fails it: of 125 points it has 100."""
SCORE = 80.0
of_two_labs = pytest.mark.parametrize("name", ["topics", "actions"])
"""The second has message types of its own: they are made in the bundle's own course."""
BROKEN = HIDDEN.replace("from roslings.judge import", "from roslings.no_such_room import")


def valid(file: Path, name: str) -> dict[str, object]:
    """A platform's file, held against the fields that it publishes."""
    table: dict[str, object] = json.loads(file.read_text("utf-8"))
    jsonschema.validate(table, schema(name), jsonschema.Draft202012Validator)
    return table


def done_well(done: subprocess.CompletedProcess[str]) -> None:
    """The command came to its end."""
    assert done.returncode == 0, done.stdout + done.stderr


# --- Gradescope --------------------------------------------------------------------------------


@of_two_labs
def test_gradescope(name: str) -> None:
    """Root in /autograder: setup.sh while the image is built, then each submission.

    With hidden checks, as the text advises: their result is there, for the instructor alone.
    """
    with played(
        "gradescope", "autograder/source", NO_NAMESPACES, hidden=HIDDEN, lab=lab(name)
    ) as gradescope:
        place = gradescope.place / "autograder"
        shutil.copy2(place / "source/run_autograder", place / "run_autograder")
        built = gradescope.run("./setup.sh", cwd=place / "source", within_s=TEN_MINUTES_S)
        done_well(built)
        assert "secret" in built.stdout, "the trial is the grading, hidden checks included"
        gradescope.hand_in(place / "submission")
        (place / "results").mkdir()
        done_well(gradescope.run("./run_autograder", cwd=place, within_s=TEN_MINUTES_S))
        table = valid(place / "results/results.json", "gradescope")
        assert (table["score"], table["extra_data"]["wall"]) == (SCORE, "user")  # type: ignore[index]
        shown = {test["number"]: test["visibility"] for test in table["tests"]}  # type: ignore[attr-defined]
        assert [check for check, seen in shown.items() if seen == "hidden"] == ["secret"]
        _gradescope_refuses(gradescope, place)


def test_an_image_that_cannot_grade_is_not_built() -> None:
    """Hidden checks that cannot be loaded are told while the image is built, not to a class."""
    with played("gradescope", "autograder/source", NO_NAMESPACES, hidden=BROKEN) as gradescope:
        place = gradescope.place / "autograder/source"
        built = gradescope.run("./setup.sh", cwd=place, within_s=TEN_MINUTES_S)
        assert built.returncode == 1, built.stdout + built.stderr
        assert "no_such_room" in built.stdout + built.stderr
        assert "roslings cannot grade here" in built.stderr


def _gradescope_refuses(gradescope: Played, place: Path) -> None:
    """A zip in a zip is opened there too; what holds no package is a zero with its reason."""
    shutil.rmtree(place / "submission")
    (place / "submission").mkdir()
    (place / "submission/readme.txt").write_text("soon")
    (place / "results/results.json").unlink()
    done_well(gradescope.run("./run_autograder", cwd=place, within_s=TEN_MINUTES_S))
    table = valid(place / "results/results.json", "gradescope")
    assert table["score"] == 0
    assert "no ROS package" in str(table["output"])


# --- PrairieLearn ------------------------------------------------------------------------------


@of_two_labs
def test_prairielearn(name: str) -> None:
    """Root in a container without a network; the student's zip file lies in /grade/student.

    With hidden checks, as the text advises, and the trial that builds the image.
    """
    own = lab(name)
    with played("prairielearn", "roslings", NO_NAMESPACES, hidden=HIDDEN, lab=own) as grader:
        prepare = str(grader.bundle / "prepare.sh")
        built = grader.run("bash", prepare, cwd=grader.place, within_s=TEN_MINUTES_S)
        done_well(built)
        assert "secret" in built.stdout, "the trial is the grading, hidden checks included"
        grade = grader.place / "grade"
        (grade / "student").mkdir(parents=True)
        (grade / "data").mkdir()
        zipped = str(grade / "student" / own.name)
        shutil.make_archive(zipped, "zip", own.solution.parent, own.solution.name)
        done = grader.run(
            "unshare",
            "--net",
            "sh",
            "-c",
            'ip link set lo up && exec "$0" "$1"',
            str(grader.bundle / "grade.sh"),
            str(grade),
            cwd=grade,
            within_s=TEN_MINUTES_S,
        )
        done_well(done)
        table = valid(grade / "results/results.json", "prairielearn")
        assert (table["gradable"], table["score"]) == (True, SCORE / 100), done.stdout + done.stderr
        assert (grade / "results/results.json").stat().st_size < 1_000_000


def test_without_even_a_loopback_nothing_is_graded() -> None:
    """No node would hear another: that is no fault of the student's, and no zero."""
    with played("prairielearn", "roslings", NO_NAMESPACES) as grader:
        grade = grader.place / "grade"
        grader.hand_in(grade / "student")
        entry = str(grader.bundle / "grade.sh")
        done_well(
            grader.run("unshare", "--net", entry, str(grade), cwd=grade, within_s=TEN_MINUTES_S)
        )
        table = valid(grade / "results/results.json", "prairielearn")
        assert table["gradable"] is False
        assert "no fault of yours" in str(table["message"])


# --- Moodle VPL --------------------------------------------------------------------------------


def test_moodle_vpl() -> None:
    """A user without rights, in a folder with the student's files and VPL's own."""
    with played("moodle-vpl", "opt", user=ORDINARY) as jail:
        home = jail.hand_in(jail.place / "p12345")
        for script in ("vpl_run.sh", "vpl_evaluate.sh"):
            shutil.copy2(jail.bundle / script, home / script)
        (home / "vpl_environment.sh").write_text(
            "#!/bin/bash\nexport VPL_GRADEMIN=0\nexport VPL_GRADEMAX=10\n"
        )
        jail.give(home)
        course_at = {"ROSLINGS_COURSE": str(jail.bundle / "course")}
        done_well(jail.run("./vpl_evaluate.sh", cwd=home, within_s=TEN_MINUTES_S, env=course_at))
        done = jail.run("./vpl_execution", cwd=home, within_s=TEN_MINUTES_S, env=course_at)
        *comments, grade = done.stdout.splitlines()
        assert grade == "Grade :=>> 10.00", done.stdout + done.stderr
        assert all(line.startswith("Comment :=>>") for line in comments)
        assert any("namespaces" in line for line in comments)


def test_moodle_vpl_without_namespaces_grades_nothing() -> None:
    """One user for all is no wall: no grade is proposed, and the student reads why."""
    with played("moodle-vpl", "opt", user=ORDINARY) as jail:
        home = jail.hand_in(jail.place / "p12345")
        shutil.copy2(jail.bundle / "vpl_evaluate.sh", home)
        jail.give(home)
        env = {"ROSLINGS_COURSE": str(jail.bundle / "course"), "ROSLINGS_ISOLATION": "user"}
        done_well(jail.run("./vpl_evaluate.sh", cwd=home, within_s=TEN_MINUTES_S, env=env))
        done = jail.run("./vpl_execution", cwd=home, within_s=TEN_MINUTES_S, env=env)
        assert "Grade :=>>" not in done.stdout
        assert "no fault of yours" in done.stdout


# --- GitHub and GitLab -------------------------------------------------------------------------


def test_github_classroom() -> None:
    """The runner's user; the reporter's points are the sum of the tests'."""
    with played("github", "work", {"CI": "true", "GITHUB_ACTIONS": "true"}, ORDINARY) as runner:
        submission = runner.hand_in(runner.place / "submission")
        output = runner.place / "home/output"
        env = {"GITHUB_OUTPUT": str(output)}
        grade = str(runner.bundle / "grader/grade.sh")
        done_well(
            runner.run("bash", grade, str(submission), cwd=runner.place, within_s=900, env=env)
        )
        word, _, encoded = output.read_text("utf-8").strip().partition("=")
        assert word == "result"
        file = runner.place / "result.json"
        file.write_bytes(base64.b64decode(encoded))
        table = valid(file, "classroom")
        points = sum(test["score"] for test in table["tests"])  # type: ignore[attr-defined]
        assert (table["status"], points, table["max_score"]) == ("pass", 100, 100)


def test_classroom50() -> None:
    """The runner's user, in the student's checkout, with the variables of its contract."""
    identity = {
        "CLASSROOM": "ros",
        "ASSIGNMENT": LAB.name,
        "USERNAME": "anna",
        "OWNER": "anna",
        "ASSIGNMENT_TYPE": "individual",
        "SUBMISSION_TAG": "submit/2026-11-20T22-14-05Z-a1b2c3d",
        "COMMIT_URL": "https://example.org/c",
        "RELEASE_URL": "https://example.org/r",
        "REVIEW_URL": "https://example.org/d",
        "CI": "true",
    }
    with played("classroom50", "bundle", identity, ORDINARY) as runner:
        checkout = runner.hand_in(runner.place / "checkout")
        script = str(runner.bundle / "autograders" / LAB.name / "autograder.py")
        done_well(runner.run("python3", script, cwd=checkout, within_s=900))
        table = valid(checkout / "result.json", "classroom50")
        assert (table["owner"], table["score"], table["max-score"]) == ("anna", 100, 100)
        shutil.rmtree(checkout / LAB.card.package)
        (checkout / "result.json").unlink()
        done_well(runner.run("python3", script, cwd=checkout, within_s=900))
        table = valid(checkout / "result.json", "classroom50")
        assert (table["score"], table["max-score"]) == (0, 100)


def test_gitlab() -> None:
    """Root in the runner's container; the job leaves JUnit's file and the line of the badge."""
    with played("gitlab", "opt/grader", {"CI": "true", **NO_NAMESPACES}) as runner:
        project = runner.hand_in(runner.place / "builds/anna")
        words = ("bash", str(runner.bundle / "grade.sh"), str(project))
        done = runner.run(*words, cwd=project, within_s=900)
        done_well(done)
        assert "Score: 100 of 100" in done.stdout.splitlines()
        suite = fromstring((project / "junit.xml").read_text("utf-8"))
        assert (suite.get("failures"), suite.get("errors")) == ("0", "0")


def test_github_actions_with_a_badge() -> None:
    """The runner's user, in the student's own repository: the exit code makes the badge."""
    with played("github-ci", "repository", {"CI": "true"}, ORDINARY) as runner:
        runner.hand_in(runner.bundle)
        words = (
            "./.roslings/roslings",
            "check",
            LAB.name,
            LAB.card.package,
            "--junit",
            "junit.xml",
        )
        done_well(runner.run(*words, cwd=runner.bundle, within_s=900))
        suite = fromstring((runner.bundle / "junit.xml").read_text("utf-8"))
        assert (suite.get("failures"), suite.get("errors")) == ("0", "0")
