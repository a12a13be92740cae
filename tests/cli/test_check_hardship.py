"""`check` where things go wrong: each a clear answer, nothing left behind, nothing lost."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from impatient import IMPATIENT
from ros2_on_pip.errors import INCONCLUSIVE
from roslings.course import Edit, Lab, Mutant, lab
from skips import skip_without
from until_told import ROSLINGS, Checked, checked, run_until_told, until_told

TOPICS = lab("topics")
LONG_S = 120.0
START = '"""'
CONSTRUCTOR = "super().__init__("
SOON = (IMPATIENT, "8")
"""For a node that never comes up: twenty seconds, three times and more, would show nothing more."""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A right package in a workspace of the test's own."""
    return copy(TOPICS, tmp_path / "ws/src/chatter")


@pytest.fixture(autouse=True)
def nothing_left(tmp_path: Path) -> Iterator[None]:
    """No folder of a run, no shared memory and no process stays behind."""
    yield
    wait_until(lambda: not run_folders(tmp_path))
    assert not (tmp_path / ".ros").exists()
    wait_until(lambda: not processes_of(tmp_path))


def copy(lab: Lab, to: Path) -> Path:
    """The solution at a place where it may be injured."""
    shutil.copytree(lab.solution, to)
    return to


def injured(tmp_path: Path, *edits: Edit) -> Path:
    """The solution with edits."""
    mutant = Mutant(name="it", what="it", fails=("rate",), edits=edits)
    return mutant.make(TOPICS.solution, tmp_path / "ws/src/chatter")


def edit(find: str, replace: str, file: str = "chatter/talker.py") -> Edit:
    """One edit of the talker."""
    return Edit(file=file, find=find, replace=replace)


def at_start(code: str) -> Edit:
    """Code that runs when the talker's program starts."""
    return edit("def main(", f"{code}\n\n\ndef main(")


def command(*words: str | Path) -> list[str]:
    """The command line, as `./roslings` runs it."""
    return [sys.executable, "-m", "roslings", *map(str, words)]


def surroundings(tmp_path: Path, **more: str) -> dict[str, str]:
    """This environment, with home, workspace and temporary files inside the test's folder."""
    temporary = tmp_path / "tmp"
    temporary.mkdir(exist_ok=True)
    own = {"HOME": str(tmp_path), "ROSLINGS_WS": str(tmp_path / "ws"), "TMPDIR": str(temporary)}
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONUNBUFFERED"}
    return {**kept, **own, **more}


def run(tmp_path: Path, *words: str | Path, **more: str) -> subprocess.CompletedProcess[str]:
    """Run a command to its end; our own traceback is never an answer."""
    ran = subprocess.run(
        command(*words),
        cwd=tmp_path,
        env=surroundings(tmp_path, **more),
        text=True,
        capture_output=True,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert "Traceback" not in ran.stderr, ran.stderr
    return ran


def verdict(
    tmp_path: Path, *words: str | Path, roslings: Sequence[str | Path] = ROSLINGS, **more: str
) -> dict[str, Any]:
    """The verdict on a package."""
    env = surroundings(tmp_path, **more)
    found: Checked = checked("topics", *words, folder=tmp_path, roslings=roslings, env=env)
    assert "Traceback" not in found.ran.stderr, found.ran.stderr
    return found.verdict


def faults(found: dict[str, Any]) -> dict[str, str]:
    """Failed check to its kind of fault."""
    return {c["id"]: c["fault"] for c in found["checks"] if c["outcome"] == "fail"}


def fingerprint(folder: Path) -> dict[str, str]:
    """Every file under a folder, and what is in it."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def run_folders(tmp_path: Path) -> list[Path]:
    """Folders of runs that are not gone."""
    return list((tmp_path / "tmp").glob("roslings-*"))


def processes_of(tmp_path: Path) -> list[str]:
    """Living processes that name the test's folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                line = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:
                continue
            if str(tmp_path) in line:
                found.append(line)
    return found


def wait_until(condition: Callable[[], bool]) -> None:
    """Wait for a condition; fail when it never holds."""
    deadline_s = time.monotonic() + LONG_S
    while not condition():
        assert time.monotonic() < deadline_s
        time.sleep(0.02)


# --- packages ----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_students_files_stay_as_they_are(package: Path, tmp_path: Path) -> None:
    """Spaces and letters of other alphabets in the path, an old build, a read-only folder."""
    place = tmp_path / "my wörkspace 工作/src/chatter"
    place.parent.mkdir(parents=True)
    package.rename(place)
    for name in ("build", "install", "log"):
        (place / name).mkdir()
        (place / name / "old.py").write_text("raise RuntimeError('another Python built this')")
    place.chmod(0o555)
    before = fingerprint(place)
    found = verdict(tmp_path, place.parent.parent)
    place.chmod(0o755)
    assert found["score"] == 100
    assert fingerprint(place) == before


@pytest.mark.slow
def test_windows_line_ends_are_no_fault(package: Path, tmp_path: Path) -> None:
    """A package that was edited on Windows."""
    for path in package.rglob("*"):
        if path.is_file() and path.suffix != ".png":
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert verdict(tmp_path, package)["score"] == 100


@pytest.mark.parametrize(
    ("injury", "words"),
    [
        (lambda p: p.rename(p.parent / "gone"), "no"),
        (lambda p: (p / "setup.py").unlink(), "setup.py"),
        (lambda p: (p / "package.xml").unlink(), "package.xml"),
        (lambda p: shutil.copytree(p, p.parent / "again"), "several"),
        (
            lambda p: (p / "package.xml").write_text(
                (p / "package.xml").read_text().replace("<name>chatter<", "<name>chatty<")
            ),
            "chatty",
        ),
    ],
    ids=["no-path", "no-setup", "no-manifest", "two", "named-otherwise"],
)
def test_what_is_no_package_is_said(
    package: Path, tmp_path: Path, injury: Callable[[Path], object], words: str
) -> None:
    """Wrong use, one clear message, the next step, and no measuring."""
    injury(package)
    path = package if words == "no" else package.parent
    ran = run(tmp_path, "check", "topics", path)
    assert ran.returncode == 2
    assert words in ran.stderr
    assert len(ran.stderr.splitlines()) <= 8


@pytest.mark.slow
def test_a_build_that_fails_shows_why(tmp_path: Path) -> None:
    """The last words of colcon stand in the verdict."""
    place = injured(tmp_path, edit("setup(\n", "raise SystemExit('no glue')\nsetup(\n", "setup.py"))
    found = verdict(tmp_path, place)
    assert faults(found) == {"builds": "BuildFailed"}
    log = next(c["log"] for c in found["checks"] if c["id"] == "builds")
    assert any("no glue" in line for line in log)


# --- nodes -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_node_that_never_starts_is_given_up(tmp_path: Path) -> None:
    """It hangs before it makes a node."""
    place = injured(tmp_path, at_start("import time\ntime.sleep(10000)"))
    assert faults(verdict(tmp_path, place, roslings=SOON)) == {"talker_runs": "DidNotComeUp"}


@pytest.mark.slow
def test_a_flood_of_output_is_survived(tmp_path: Path) -> None:
    """Endless output beside the right one is told as such; the other node is judged."""
    flood = (
        "import threading\n\n\ndef flood():\n    while True:\n        print('x' * 1000)\n\n\n"
        "threading.Thread(target=flood, daemon=True).start()"
    )
    found = verdict(tmp_path, injured(tmp_path, at_start(flood)))
    assert faults(found)["talker_runs"] == "PrintsWithoutEnd"
    assert next(c for c in found["checks"] if c["id"] == "hears")["outcome"] == "pass"


@pytest.mark.slow
def test_a_daemon_is_found_and_ended(tmp_path: Path) -> None:
    """A process that the node leaves behind."""
    daemon = "import subprocess\nsubprocess.Popen(['sleep', '10000'], start_new_session=True)"
    found = verdict(tmp_path, injured(tmp_path, at_start(daemon)))
    assert faults(found) == {"ends": "LeavesProcesses"}


@pytest.mark.slow
def test_bytes_that_are_no_text_harm_nobody(tmp_path: Path) -> None:
    """They are shown as such, and the verdict is the same."""
    noise = "import sys\nsys.stdout.buffer.write(bytes(range(256)) * 10)"
    assert verdict(tmp_path, injured(tmp_path, at_start(noise)))["score"] == 100


# --- machines ----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("wall", ["domain", "auto"])
def test_the_solution_passes_behind_both_walls(package: Path, tmp_path: Path, wall: str) -> None:
    """With namespaces and without, the verdict is the same."""
    found = verdict(tmp_path, package, ROSLINGS_ISOLATION=wall)
    assert found["score"] == 100, faults(found)
    assert wall == "auto" or found["environment"]["isolation"] == "domain"


@pytest.mark.slow
@pytest.mark.parametrize("wall", ["domain", "auto"])
def test_the_solution_passes_on_a_platform(package: Path, tmp_path: Path, wall: str) -> None:
    """Unobserved as well; without namespaces nodes share memory, and no packet is to be seen."""
    results = ("--gradescope", tmp_path / "results.json")
    env = surroundings(tmp_path, ROSLINGS_ISOLATION=wall)
    found = checked("topics", package, "--trust", *results, folder=tmp_path, env=env)
    assert found.verdict["score"] == 100


@pytest.mark.slow
def test_a_parent_that_ignores_ctrl_c_changes_nothing(package: Path, tmp_path: Path) -> None:
    """A background job, or CI."""
    file = tmp_path / "verdict.json"
    words = command("check", "topics", package, "--json", file)
    ignoring = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", *words]
    run_until_told(ignoring, env=surroundings(tmp_path), cwd=tmp_path)
    assert json.loads(file.read_text())["score"] == 100


@pytest.mark.slow
def test_an_ordinary_user_gets_the_same_verdict(package: Path, tmp_path: Path) -> None:
    """Without a single capability, as user 1000."""
    skip_without("root", "user without rights")
    drop = ["unshare", "--user", "--map-user=1000", "--map-group=1000"]
    file = tmp_path / "verdict.json"
    words = [*drop, *command("check", "topics", package, "--json", file)]
    run_until_told(words, env=surroundings(tmp_path), cwd=tmp_path)
    assert json.loads(file.read_text())["score"] == 100


@pytest.mark.slow
def test_two_at_once_do_not_meet(package: Path, tmp_path: Path) -> None:
    """Two gradings on one machine, without namespaces: neither hears the other."""
    files = [tmp_path / f"{number}.json" for number in range(2)]
    env = surroundings(tmp_path, ROSLINGS_ISOLATION="domain")

    def both() -> list[int]:
        words = [command("check", "topics", package, "--json", file) for file in files]
        running = [subprocess.Popen(each, env=env, cwd=tmp_path) for each in words]
        return [each.wait() for each in running]

    told = until_told(both, lambda codes: INCONCLUSIVE in codes and set(codes) <= {0, INCONCLUSIVE})
    assert told == [0, 0]


DEAF = """
import pathlib, time
deaf = pathlib.Path({flag!r})
if {once}not deaf.exists():
    deaf.touch()
    print("[RTPS_TRANSPORT_SHM Error] Failed init_port fastrtps_port7004", flush=True)
    time.sleep(600)
"""


@pytest.mark.slow
def test_a_run_without_a_working_middleware_is_made_again(tmp_path: Path) -> None:
    """As it was seen on a busy machine: the node runs, and nobody can see it."""
    deaf = at_start(DEAF.format(flag=str(tmp_path / "flag"), once="") + "\n")
    found = verdict(tmp_path, injured(tmp_path, deaf), ROSLINGS_ISOLATION="domain")
    assert (tmp_path / "flag").exists() and found["score"] == 100, faults(found)


@pytest.mark.slow
def test_a_middleware_that_never_works_is_not_held_against_the_student(tmp_path: Path) -> None:
    """No verdict on that node, and the reason."""
    deaf = at_start(DEAF.format(flag=str(tmp_path / "flag"), once="True or ") + "\n")
    file = tmp_path / "verdict.json"
    run(tmp_path, "check", "topics", injured(tmp_path, deaf), "--json", file)  # once: it stays so
    found = json.loads(file.read_text("utf-8"))
    (runs,) = (each for each in found["checks"] if each["id"] == "talker_runs")
    assert runs["outcome"] == "inconclusive", runs
    assert "middleware could not open a port" in json.dumps(runs)


@pytest.mark.slow
def test_a_full_disk_is_said(package: Path, tmp_path: Path) -> None:
    """A temporary folder without room: the machine's fault, so no verdict."""
    small = tmp_path / "small"
    small.mkdir()
    mount = f'mount -t tmpfs -o size=40k none {small} && exec "$@"'
    inside = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", mount, "sh"]
    skip_without("small disk")
    env = surroundings(tmp_path, TMPDIR=str(small))
    ran = subprocess.run(
        [*inside, *command("check", "topics", package)],
        env=env,
        cwd=tmp_path,
        text=True,
        capture_output=True,
        check=False,
    )
    assert ran.returncode == 3, ran.stderr
    assert "Traceback" not in ran.stderr
    assert "disk" in ran.stderr or "space" in ran.stderr


# --- the end -----------------------------------------------------------------------------------


def started(package: Path, tmp_path: Path) -> subprocess.Popen[str]:
    """A check in a session of its own, far enough that the student's nodes run."""
    running = subprocess.Popen(
        command("check", "topics", package),
        cwd=tmp_path,
        env=surroundings(tmp_path),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    wait_until(lambda: any("lib/chatter/talker" in line for line in processes_of(tmp_path)))
    return running


@pytest.mark.slow
def test_ctrl_c_ends_all_at_once(package: Path, tmp_path: Path) -> None:
    """The nodes, the probe and the guardian end; the message is one line."""
    running = started(package, tmp_path)
    os.killpg(running.pid, signal.SIGINT)
    _, errors = running.communicate()
    assert running.returncode == 130
    assert "Stopped." in errors
    assert "Traceback" not in errors
    assert processes_of(tmp_path) == []


@pytest.mark.slow
def test_a_killed_check_leaves_nothing_that_runs(package: Path, tmp_path: Path) -> None:
    """The kernel ends the nodes; the next check removes the folder."""
    running = started(package, tmp_path)
    running.kill()
    running.communicate()
    wait_until(lambda: processes_of(tmp_path) == [])
    assert run_folders(tmp_path)
    assert verdict(tmp_path, package)["score"] == 100


ENDED_WHILE = """
import os, signal, shutil
from pathlib import Path
from roslings.experiment import run_folder as module

def end(*_, **__):
    os.kill(os.getpid(), signal.SIGKILL)

{when}
with module.run_folder() as folder:
    (folder / "src/chatter").mkdir(parents=True)
    (folder / "src/chatter").chmod(0o500)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "when",
    [
        "module.fcntl.flock = end",
        "Path.rename = end",
        "shutil.rmtree = end",
        "whole = shutil.rmtree; shutil.rmtree = lambda *a, **k: (whole(*a, **k), end())",
        "Path.iterdir = end",
    ],
)
def test_whoever_is_killed_meanwhile_leaves_what_is_swept(
    when: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """While the folder is made, and while it is removed."""
    from roslings.experiment.run_folder import sweep

    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    script = ENDED_WHILE.format(when=when)
    ran = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert ran.returncode == -signal.SIGKILL, ran.stderr
    assert list(tmp_path.iterdir())
    sweep()
    assert not list(tmp_path.iterdir())


def test_temporary_files_of_others_are_left_alone(tmp_path: Path) -> None:
    """The sweep takes folders of runs, and no other."""
    from roslings.experiment.run_folder import sweep

    other = Path(tempfile.mkdtemp(prefix="roslings-other-"))
    sweep()
    assert other.is_dir()
    other.rmdir()
