"""What `./roslings export` makes: whole, without an answer, each platform's files well formed."""

from __future__ import annotations

import json
import re
import shutil
import stat
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from test_export_results import schema

from roslings import course
from roslings_class.export import SYSTEMS, CannotExport, System, bundle, export
from roslings_class.export.systems import OF_SYSTEM
from roslings_class.release import leaks
from roslings_launcher import built_interfaces
from roslings_launcher.cli import main

LAB = "topics"
HIDDEN = "POINTS = {}\n# secret: 4711\n"
each_system = pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS.keys())
WANTED = {
    "gradescope": ("setup.sh", "run_autograder"),
    "github": ("template/.github/workflows/classroom.yml", "grader/grade.sh"),
    "classroom50": (f"autograders/{LAB}/autograder.py", "runtime.json"),
    "prairielearn": ("Containerfile", "grade.sh", "question/info.json", "question/question.html"),
    "moodle-vpl": ("vpl_run.sh", "vpl_evaluate.sh", "prepare.sh"),
    "gitlab": (".gitlab-ci.yml", "grade.sh"),
    "github-ci": (".github/workflows/roslings.yml",),
}


@pytest.fixture(scope="module")
def bundles(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One bundle of each platform."""
    folder = tmp_path_factory.mktemp("bundles")
    for name in SYSTEMS:
        export(name, course.lab(LAB), folder / name)
    return folder


def own_files(whole: Path, system: System) -> list[Path]:
    """The platform's files, without the course."""
    inside = whole / system.course.replace("@LAB@", LAB)
    files = (path for path in whole.rglob("*") if path.is_file())
    return [path for path in files if not path.is_relative_to(inside)]


@each_system
def test_a_bundle_is_whole(bundles: Path, system: System) -> None:
    """The platform's files, the course that grades, this lab and no other, and a page."""
    whole = bundles / system.name
    inside = whole / system.course.replace("@LAB@", LAB)
    for name in (*WANTED[system.name], "README.md"):
        assert (whole / name).is_file(), name
    parts = (
        "roslings",
        "pyproject.toml",
        "constraints.txt",
        "packages/roslings/src/roslings/commands/check.py",
    )
    of_lab = (f"graders/grade_{LAB}.py", f"labs/{LAB}/card.yaml", f"labs/{LAB}/starter")
    for name in (*parts, *of_lab):
        assert (inside / name).exists(), name
    assert (inside / "roslings").stat().st_mode & stat.S_IXUSR
    assert [path.name for path in (inside / "labs").iterdir()] == [LAB]
    assert not [path for path in (inside / "tests", inside / ".git") if path.exists()]


@each_system
def test_no_answer_is_in_it(bundles: Path, system: System) -> None:
    """No solution and no mutant, as a file or as text."""
    folders = {path.name for path in (bundles / system.name).rglob("*") if path.is_dir()}
    assert not folders & {"solution", "mutants", "tests"}


def test_an_answer_would_be_found(
    bundles: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """As a text, in any file of the course: then nothing is left of the bundle."""
    assert list(leaks(bundles / "gradescope", [course.lab(LAB)])) == []
    answer = course.lab(LAB).solution / "chatter" / "talker.py"
    name = answer.relative_to(course.root()).as_posix()
    monkeypatch.setattr(bundle, "names_for", lambda lab, found: [name])
    assert main(["export", "gradescope", LAB, "--to", str(tmp_path / "to")]) == 2
    assert "An answer would leak" in capsys.readouterr().err
    assert not (tmp_path / "to").exists()


@each_system
def test_its_words_are_filled_in(bundles: Path, system: System) -> None:
    """No placeholder of ours is left; the page names the wall and the lab."""
    for path in own_files(bundles / system.name, system):
        assert not re.search(r"@[A-Z]+@", path.read_text("utf-8")), path
    page = (bundles / system.name / "README.md").read_text("utf-8")
    assert "**The wall.**" in page
    assert course.lab(LAB).card.title in page


@each_system
def test_its_scripts_are_sound(bundles: Path, system: System) -> None:
    """shellcheck says nothing, and each can be run."""
    scripts = [
        path
        for path in own_files(bundles / system.name, system)
        if path.read_text("utf-8").startswith("#!")
    ]
    for script in scripts:
        done = subprocess.run(
            ["shellcheck", "--shell=bash", str(script)], capture_output=True, text=True, check=False
        )
        assert done.stdout + done.stderr == ""
        assert script.stat().st_mode & stat.S_IXUSR
    programs = [path for path in own_files(bundles / system.name, system) if path.suffix == ".py"]
    for program in programs:
        compile(program.read_text("utf-8"), str(program), "exec")


def test_prairielearn_reads_the_question(bundles: Path) -> None:
    """Within the limits that it publishes."""
    info = json.loads((bundles / "prairielearn/question/info.json").read_text("utf-8"))
    import jsonschema  # two seconds of a processor

    jsonschema.validate(info, schema("prairielearn_info"), jsonschema.Draft202012Validator)


@pytest.mark.parametrize(
    ("file", "job"),
    [
        ("github/template/.github/workflows/classroom.yml", "run-autograding-tests"),
        ("github-ci/.github/workflows/roslings.yml", "check"),
    ],
)
def test_a_workflow_is_well_formed(bundles: Path, file: str, job: str) -> None:
    """The job has a bound, no right to write code, and a step that takes the result on."""
    table = yaml.load((bundles / file).read_text("utf-8"), yaml.BaseLoader)  # `on` is no boolean
    assert {"name", "on", "permissions", "jobs"} <= table.keys()
    assert table["permissions"]["contents"] == "read"
    assert list(table["jobs"]) == [job]
    steps = table["jobs"][job]["steps"]
    assert all(("uses" in step) != ("run" in step) for step in steps)
    assert int(table["jobs"][job]["timeout-minutes"]) <= 60
    checkouts = [step for step in steps if step.get("uses", "").startswith("actions/checkout")]
    assert all(step["with"]["persist-credentials"] == "false" for step in checkouts)


def test_the_reporter_is_given_the_graders_result(bundles: Path) -> None:
    """It reads NAME_RESULTS for each of its runners, from a step of that id."""
    file = bundles / "github/template/.github/workflows/classroom.yml"
    table = yaml.load(file.read_text("utf-8"), yaml.BaseLoader)
    steps = table["jobs"]["run-autograding-tests"]["steps"]
    reporter = next(s for s in steps if "autograding-grading-reporter" in s.get("uses", ""))
    for runner in reporter["with"]["runners"].split(","):
        assert f"{runner.upper()}_RESULTS" in reporter["env"]
        assert runner in [step.get("id") for step in steps]


def test_gitlab_shows_the_score_as_a_badge(bundles: Path) -> None:
    """The line that grade.sh prints is the one that the CI file looks for."""
    table = yaml.safe_load((bundles / "gitlab/.gitlab-ci.yml").read_text("utf-8"))
    pattern = table["roslings"]["coverage"].strip("/")
    found = re.search(pattern, "Score: 87.5 of 100")
    assert found is not None
    assert found[1] == "87.5"
    assert table["roslings"]["artifacts"]["reports"]["junit"] == "junit.xml"


# --- hidden checks, and what is refused --------------------------------------------------------


@each_system
def test_hidden_checks_go_only_where_students_cannot_read(tmp_path: Path, system: System) -> None:
    """There they are closed to others; elsewhere nothing is made."""
    file = tmp_path / "hidden_topics.py"
    file.write_text(HIDDEN)
    to = tmp_path / "to"
    if not system.keeps_hidden:
        with pytest.raises(CannotExport, match="Students could read"):
            export(system.name, course.lab(LAB, file), to)
        assert not to.exists()
        return
    export(system.name, course.lab(LAB, file), to)
    (kept,) = [path for path in to.rglob("hidden_checks.py")]
    assert "4711" in kept.read_text("utf-8")
    assert not kept.stat().st_mode & 0o077
    texts = "".join(path.read_text("utf-8") for path in own_files(to, system))
    assert texts.count("--hidden course/graders/hidden_checks.py") == 1


def test_an_unknown_platform_is_told_with_the_known_ones(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2."""
    assert main(["export", "gradscope", LAB, "--to", str(tmp_path / "x")]) == 2
    told = capsys.readouterr().err
    assert all(name in told for name in SYSTEMS)


def test_the_example_is_not_for_a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its solution is in every edition."""
    assert main(["export", "gradescope", "example", "--to", str(tmp_path / "x")]) == 2
    assert "new-lab" in capsys.readouterr().err


def test_it_replaces_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder that holds something stays as it is."""
    (tmp_path / "mine").write_text("")
    assert main(["export", "gradescope", LAB, "--to", str(tmp_path)]) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
    assert main(["export", "gradescope", LAB, "--to", str(tmp_path / "new")]) == 0
    assert "The wall:" in capsys.readouterr().out


INSTALLS = {
    "gradescope": "setup.sh",
    "github": "template/.github/workflows/classroom.yml",
    "classroom50": "runtime.json",
    "prairielearn": "prepare.sh",
    "moodle-vpl": "README.md",
    "gitlab": ".gitlab-ci.yml",
    "github-ci": ".github/workflows/roslings.yml",
}
"""Which file of the bundle says what apt is to bring."""
WITHOUT_SYSTEM = {"ros2", "vision"}
"""Groups whose Python packages bring all that they need."""


@each_system
@pytest.mark.parametrize("name", [each.name for each in course.all_labs()])
def test_every_platform_brings_what_the_labs_card_needs(
    tmp_path: Path, system: System, name: str
) -> None:
    """No compiler: the course's own message types come built."""
    bundle.write_own_files(system, course.lab(name), tmp_path)
    assert "g++" not in (tmp_path / INSTALLS[system.name]).read_text("utf-8")


@each_system
def test_every_platform_brings_a_compiler_for_other_types(tmp_path: Path, system: System) -> None:
    """And the headers of its Python, where the image has none: an instructor has own types."""
    folder = Path(shutil.copytree(course.lab("actions").folder, tmp_path / "labs/actions"))
    with (folder / "interfaces/rover_interfaces/action/Charge.action").open("a") as types:
        types.write("float32 current\n")
    lab = replace(course.lab("actions"), folder=folder)
    bundle.write_own_files(system, lab, tmp_path)
    text = (tmp_path / INSTALLS[system.name]).read_text("utf-8")
    assert "g++" in text
    image = "".join(each.read_text("utf-8") for each in tmp_path.rglob("Containerfile"))
    assert ("python3-dev" in text) == ("python:3.12" not in text + image)
    if system.name == "classroom50":
        assert json.loads(text)["apt"] == ["bubblewrap", "g++", "python3-dev"]


def test_every_group_of_a_card_is_known() -> None:
    """A new one is put into one of the two tables: whether it needs something of the system."""
    groups = {group for lab in course.all_labs() for group in lab.card.groups}
    assert groups <= WITHOUT_SYSTEM | set(OF_SYSTEM)
    assert not WITHOUT_SYSTEM & set(OF_SYSTEM)


@pytest.mark.parametrize("name", ["distance-sensor", "pi-camera", "actions"])
def test_other_labs_can_be_exported_too(tmp_path: Path, name: str) -> None:
    """Those with message types of their own as well: they go along, as sources and built."""
    export("gradescope", course.lab(name), tmp_path / "it")
    own = course.lab(name).folder / "interfaces"
    assert (tmp_path / f"it/course/labs/{name}/interfaces").exists() == own.exists()
    assert list((tmp_path / "it/course").glob(f"{built_interfaces.FOLDER}/rover_interfaces.tar.gz"))


def test_the_page_lists_every_platform() -> None:
    """Platform, command, what to upload, which wall: one row each."""
    page = (course.root() / "site/pages/teachers/exports.md").read_text("utf-8")
    for system in SYSTEMS.values():
        assert f"`./roslings export {system.name} LAB --to DIR`" in page
