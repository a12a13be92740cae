"""The whole examination: order, summary, JSON, redaction, screen, words and exit codes."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from clinic import Clinic, public_key

from ros_doctor import cli
from ros_doctor.document import SCHEMA, document
from ros_doctor.examine import Examination, ExaminedCheck, examine
from ros_doctor.finding import Finding, Status, do, fault, ok, unknown
from ros_doctor.redact import Secrets, redacted
from ros_doctor.registry import DoctorCheck, all_checks
from ros_doctor.screen import Paint, lines_of

SOURCE = Path(cli.__file__).resolve().parents[1]
SCHEMA_FILE = Path(cli.__file__).parent / "schema.json"
QUICK = [check for check in all_checks() if not check.live]
PLAIN = Paint(False)
NO_ROS_NEEDED = ["--only", "python", "domain-id", "discovery-range"]


def eight_faults(clinic: Clinic) -> Clinic:
    clinic.apt(sourced=False).ubuntu("24.04", "noble")
    clinic.change(free_bytes=lambda path: 100_000_000)
    clinic.file("/usr/share/keyrings/ros-archive-keyring.gpg").write_bytes(public_key(1000, 500))
    folder = clinic.package()
    (folder / "setup.cfg").unlink()
    (folder / "resource/greeter").unlink()
    (clinic.root / "dev/ttyACM0").symlink_to(clinic.root / "dev/gone")
    clinic.set(ROS_DOMAIN_ID="seven", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF")
    clinic.give_to_student()
    return clinic


def test_eight_faults_at_once_get_eight_mends_causes_first(clinic: Clinic) -> None:
    seen = examine(eight_faults(clinic).machine, QUICK)
    faults = [one for one in seen.worst_first() if one.finding.status == Status.FAULT]
    assert [one.check.id for one in faults] == [
        "disk-space",
        "ros-found",
        "apt-key",
        "domain-id",
        "discovery-range",
        "ws-setup-cfg",
        "ws-marker",
        "serial-open",
    ]
    assert all(one.finding.mend for one in faults)
    assert {
        one.check.id for one in seen.results if one.finding.found == "first mend ros-found"
    } == {
        "rclpy-python",
        "middleware",
        "colcon",
    }


def test_each_thing_to_mend_has_a_mend(clinic: Clinic) -> None:
    for one in examine(eight_faults(clinic).machine, QUICK).results:
        assert bool(one.finding.mend) == one.finding.status.needs_a_mend, one


def test_a_check_that_fails_hides_no_other(clinic: Clinic) -> None:
    def stumble(machine: object) -> Finding:
        raise RuntimeError("no such luck")

    broken = replace(QUICK[0], id="broken", examine=stumble)
    results = examine(clinic.machine, [broken, *QUICK]).results
    assert results[0].finding.status == Status.UNKNOWN
    assert "RuntimeError: no such luck" in results[0].finding.found
    assert len(results) == len(QUICK) + 1


def test_root_is_not_told_to_use_sudo(clinic: Clinic) -> None:
    clinic.no_ros().change(architecture="aarch64")
    as_user = clinic.look("ros-found")
    as_root = clinic.change(user=0).look("ros-found")
    commands = "\n".join(step.command for step in as_root.mend)
    assert any(step.command.startswith("sudo ") for step in as_user.mend)
    assert "apt install" in commands
    assert "sudo" not in commands


# --- JSON -------------------------------------------------------------------------------------


KINDS = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int}
RULES: dict[str, Callable[[Any, Any], bool]] = {
    "const": lambda value, wanted: value == wanted,
    "enum": lambda value, wanted: value in wanted,
    "pattern": lambda value, wanted: re.search(wanted, value) is not None,
    "minimum": lambda value, wanted: value >= wanted,
    "type": lambda value, wanted: isinstance(value, KINDS.get(wanted, (int, float))),
}
PARTS = {"$schema", "title", "description", "properties", "required", "items"}


def complaints(value: Any, schema: dict[str, Any], place: str = "$") -> list[str]:
    """Return where a value breaks a schema, for the words of JSON Schema that ours uses."""
    assert set(schema) <= PARTS | set(RULES) | {"additionalProperties"}, "a word unknown here"
    broken = [word for word in RULES if word in schema and not RULES[word](value, schema[word])]
    found = [f"{place}: {word} {schema[word]}" for word in broken]
    if isinstance(value, dict):
        found += _object_complaints(value, schema, place)
    if isinstance(value, list):
        for number, item in enumerate(value):
            found += complaints(item, schema["items"], f"{place}[{number}]")
    return found


def _object_complaints(value: dict[str, Any], schema: dict[str, Any], place: str) -> list[str]:
    parts = schema["properties"]
    found = [f"{place}.{name} is missing" for name in schema["required"] if name not in value]
    found += [f"{place}.{name} is not in the schema" for name in value if name not in parts]
    for name, part in value.items():
        found += complaints(part, parts.get(name, {}), f"{place}.{name}")
    return found


def schema() -> dict[str, Any]:
    read: dict[str, Any] = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))
    return read


def test_json_follows_its_schema(clinic: Clinic) -> None:
    for machine in (clinic.machine, eight_faults(clinic).machine):
        value = json.loads(json.dumps(document(examine(machine, QUICK))))
        assert complaints(value, schema()) == []


def test_the_schema_refuses_what_is_wrong(clinic: Clinic) -> None:
    value = document(examine(clinic.machine, QUICK))
    value["checks"][0] |= {"status": "fine", "more": 1}
    del value["summary"]["ok"]
    assert len(complaints(value, schema())) == 3
    assert schema()["properties"]["schema"]["const"] == SCHEMA


def test_json_counts_what_it_lists(clinic: Clinic) -> None:
    value = document(examine(eight_faults(clinic).machine, QUICK))
    assert sum(value["summary"].values()) == len(value["checks"]) == len(QUICK)
    assert value["outcome"] == "fault"
    assert value["summary"]["fault"] == 8


# --- redaction --------------------------------------------------------------------------------

SECRETS = Secrets(Path("/home/maria"), ("maria", "Garcia", "pi", ""), ("thinkpad-x1", "thinkpad"))


@pytest.mark.parametrize(
    ("text", "hidden"),
    [
        ("/home/maria/roslings_ws/src", "~/roslings_ws/src"),
        ("/home/mariana/ws belongs to root", "/home/USER/ws belongs to root"),
        ("/Users/someone/ws", "/Users/USER/ws"),
        ("/mnt/c/Users/Some.One/ws", "/mnt/c/Users/USER/ws"),
        ("/data/maria_garcia/ws", "/data/USER_USER/ws"),
        ("thinkpad-x1 says no", "HOST says no"),
        ("raspberry pi, marianne", "raspberry pi, marianne"),
        ("at 192.168.1.17:11811", "at ADDRESS:11811"),
        ("at fe80::1ff:fe23:4567:890a", "at ADDRESS"),
        ("at 02:42:ac:11:00:02", "at ADDRESS"),
        ("maria@uni.example.org", "EMAIL"),
        ("224.0.0.0/4 and 127.0.0.1", "224.0.0.0/4 and 127.0.0.1"),
        ("greeter.hello:main at 12:30:45", "greeter.hello:main at 12:30:45"),
        ("std::runtime_error", "std::runtime_error"),
    ],
)
def test_what_tells_who_you_are_is_hidden(text: str, hidden: str) -> None:
    assert SECRETS.hidden(text) == hidden


def test_a_redacted_report_holds_no_name(clinic: Clinic) -> None:
    eight_faults(clinic).set(USER="zacharias", HOSTNAME="nebuchadnezzar")
    clinic.set(AMENT_PREFIX_PATH="/data/zacharias/install:/net/nebuchadnezzar/ws")
    clinic.set(CYCLONEDDS_URI="file:///data/10.11.12.13.xml")
    seen = examine(clinic.machine, QUICK)
    open_text = json.dumps(document(seen)) + "\n".join(lines_of(seen, PLAIN, True))
    hidden = redacted(seen)
    text = json.dumps(document(hidden)) + "\n".join(lines_of(hidden, PLAIN, True))
    for name in ("zacharias", str(clinic.machine.home), "10.11.12.13"):
        assert name in open_text
        assert name not in text
    assert "nebuchadnezzar" not in text


# --- screen -----------------------------------------------------------------------------------


def screen(machine_or_seen: Examination, detailed: bool = False) -> str:
    return "\n".join(lines_of(machine_or_seen, PLAIN, detailed))


def test_no_line_is_wider_than_80_columns_but_a_command(clinic: Clinic) -> None:
    seen = examine(eight_faults(clinic).machine, QUICK)
    commands = {
        line for one in seen.results for s in one.finding.mend for line in s.command.split("\n")
    }
    for line in lines_of(seen, PLAIN, True):
        path_in_it = str(clinic.root) in line  # a path is never broken
        assert len(line) <= 80 or line.strip() in commands or path_in_it, line


def test_a_command_is_printed_whole(clinic: Clinic) -> None:
    seen = examine(eight_faults(clinic).machine, QUICK)
    lines = {line.strip() for line in lines_of(seen, PLAIN, False)}
    for one in seen.results:
        if one.finding.status.needs_a_mend:
            for step in one.finding.mend:
                assert {line.strip() for line in step.command.splitlines()} <= lines


def pretend(*findings: Finding, machine: Clinic) -> Examination:
    check = QUICK[0]
    return Examination(
        machine.machine, tuple(ExaminedCheck(check, one, 0.0) for one in findings), 0.1
    )


@pytest.mark.parametrize(
    ("findings", "said"),
    [
        ([ok("x")], "1 check: 1 well. Nothing to mend."),
        ([ok("x"), unknown("y")], "Nothing to mend in what was looked at."),
        ([ok("x"), fault("y", do("z"))], "2 checks: 1 fault, 1 well. Mend the first fault"),
        ([Finding(Status.WARNING, "w", (do("z"),))] * 2, "2 checks: 2 warnings. The labs can"),
        ([Finding(Status.ADVICE, "w", (do("z"),))], "1 check: 1 piece of advice. The labs can"),
    ],
)
def test_the_summary_tells_the_truth(clinic: Clinic, findings: list[Finding], said: str) -> None:
    assert said in " ".join(screen(pretend(*findings, machine=clinic)).split())


def test_what_could_not_be_looked_at_is_named_with_its_reason(clinic: Clinic) -> None:
    text = screen(examine(eight_faults(clinic).machine, QUICK))
    assert "NOT LOOKED AT" in text
    assert "rclpy-python: first mend ros-found." in text
    assert "3 could not be looked" in " ".join(text.split())


def test_colour_is_only_paint(clinic: Clinic) -> None:
    seen = examine(eight_faults(clinic).machine, QUICK)
    coloured = "\n".join(lines_of(seen, Paint(True), False))
    assert "\033[" in coloured
    assert re.sub(r"\033\[[0-9;]*m", "", coloured) == screen(seen)


# --- words and exit codes ---------------------------------------------------------------------


def run(*words: str, **env: str) -> subprocess.CompletedProcess[str]:
    """Run the doctor as its own process, with this Python and few variables."""
    return subprocess.run(
        [sys.executable, "-m", "ros_doctor", *words],
        env={"PATH": os.environ["PATH"], "PYTHONPATH": str(SOURCE), **env},
        capture_output=True,
        text=True,
        check=False,
    )


def test_exit_0_without_a_fault() -> None:
    done = run(*NO_ROS_NEEDED)
    assert (done.returncode, done.stderr) == (0, "")
    assert "3 checks: 3 well. Nothing to mend." in done.stdout


def test_exit_1_at_a_fault() -> None:
    done = run(*NO_ROS_NEEDED, ROS_DOMAIN_ID="seven")
    assert done.returncode == 1
    assert done.stdout.startswith(("roslings doctor\n", "ros-doctor\n"))  # in a course, or alone
    assert "FAULT  ROS_DOMAIN_ID is 'seven'." in done.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--only", "domainid"], "Is it domain-id"),
        (["--only"], "expected at least one argument"),
        (["--explain", "x"], "there is no check 'x'"),
        (["--workspace", "/no/such/folder"], "there is no folder /no/such/folder"),
        (["everything"], "unrecognized arguments: everything"),
        (["--js"], "unrecognized arguments"),
    ],
)
def test_exit_2_at_wrong_use(words: list[str], said: str) -> None:
    done = run(*words)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_json_is_json_and_nothing_else() -> None:
    value = json.loads(run("--json", *NO_ROS_NEEDED).stdout)
    assert complaints(value, schema()) == []
    assert [one["id"] for one in value["checks"]] == ["python", "domain-id", "discovery-range"]


def test_only_takes_commas_and_spaces() -> None:
    value = json.loads(run("--json", "--only", "python,domain-id", "clock").stdout)
    assert {one["id"] for one in value["checks"]} == {"python", "domain-id", "clock"}


def test_list_shows_every_check() -> None:
    lines = run("--list").stdout.splitlines()
    assert {line.split()[0] for line in lines if line.startswith("  ")} == {
        check.id for check in all_checks()
    }
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("check", all_checks(), ids=[check.id for check in all_checks()])
def test_explain_tells_what_why_and_where(
    check: DoctorCheck,
    clinic: Clinic,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cli, "this_machine", lambda: clinic.no_ros().machine)
    code = cli.main(["--explain", check.id])
    text = capsys.readouterr().out
    assert code in (0, 1)
    assert text.startswith(f"{check.id}: {check.title}\n")
    assert "On this machine: " in text
    assert text.endswith(f"Read more: {check.lesson}\n")


@pytest.mark.parametrize("words", [[], ["--json"], ["--explain", "python"]])
def test_nothing_goes_wrong_without_home_locale_and_variables(words: list[str]) -> None:
    env = {"PYTHONPATH": str(SOURCE), "LC_ALL": "C", "PATH": "/usr/bin:/bin"}
    done = subprocess.run(
        [sys.executable, "-m", "ros_doctor", *words],
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1), done.stderr
    assert "the check itself failed" not in done.stdout
    assert done.stderr == ""


def test_a_reader_that_has_read_enough_is_no_error() -> None:
    words = f"'{sys.executable}' -m ros_doctor --list | head -n 1"
    env = {"PYTHONPATH": str(SOURCE), "PATH": os.environ["PATH"]}
    done = subprocess.run(
        ["bash", "-o", "pipefail", "-c", words],
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""


@pytest.mark.parametrize("inside", ["", "src", "src/greeter", "src/greeter/greeter"])
def test_any_folder_of_a_workspace_means_the_workspace(clinic: Clinic, inside: str) -> None:
    clinic.package()
    meant = cli.workspace_root(clinic.machine.workspace / inside)
    if inside != "src/greeter/greeter":
        assert meant == clinic.machine.workspace


def test_the_doctor_changes_nothing(clinic: Clinic) -> None:
    """Every file of the machine is the same afterwards, to the nanosecond."""
    eight_faults(clinic)
    before = {path: path.lstat().st_mtime_ns for path in clinic.root.rglob("*")}
    examine(clinic.machine, all_checks())
    assert {path: path.lstat().st_mtime_ns for path in clinic.root.rglob("*")} == before


def test_importing_the_doctor_imports_no_ros_and_nothing_from_outside() -> None:
    script = "import sys; old = set(sys.modules); import ros_doctor.cli\n"
    script += "import ros_doctor.breaks\nfrom ros_doctor.registry import all_checks\n"
    script += "all_checks(); print(*{name.partition('.')[0] for name in set(sys.modules) - old})"
    done = subprocess.run(
        [sys.executable, "-S", "-c", script],
        env={"PYTHONPATH": str(SOURCE)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert set(done.stdout.split()) - set(sys.stdlib_module_names) == {"ros_doctor"}
