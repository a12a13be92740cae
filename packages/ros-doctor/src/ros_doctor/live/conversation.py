"""Starts the programs of this folder with the Python that has ROS, and always ends them.

They stay on this computer: discovery range LOCALHOST sends nothing to the network card.
"""

from __future__ import annotations

import contextlib
import os
import random
import secrets
import select
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.machine import ExaminedMachine
from ros_doctor.ros import Ros

HERE = Path(__file__).parent
ENDING_S = 3.0
STEP_S = 0.05
FIRST_PORT, PORTS_PER_DOMAIN, LAST_DOMAIN = 7400, 250, 101  # the DDS standard's port numbers
# Settings of the student's that would send packets out, or that change the transport.
DROPPED = (
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
    "ROS_DISCOVERY_SERVER",
    "FASTDDS_BUILTIN_TRANSPORTS",
    "FASTDDS_DEFAULT_PROFILES_FILE",
    "FASTRTPS_DEFAULT_PROFILES_FILE",
    "CYCLONEDDS_URI",
    "PYTHONSTARTUP",
)

Process = subprocess.Popen[str]


@dataclass(frozen=True)
class ConversationOutcome:
    """Did the word arrive? `error` is what a process that ended too early wrote last."""

    heard: bool
    error: str = ""


def exchange(machine: ExaminedMachine, ros: Ros, seconds: float) -> ConversationOutcome:
    """Let a talker and a listener run until the listener has heard a random word.

    Waits at most `seconds`; both processes have ended when this returns.
    """
    word = secrets.token_hex(4)
    topic = f"/roslings_doctor_{word}"
    with tempfile.TemporaryDirectory() as logs:
        env = quiet(machine, ros, Path(logs), str(free_domain(machine)))
        with (
            process(ros, env, "hear.py", topic, word) as listener,
            process(ros, env, "speak.py", topic, word) as talker,
        ):
            return _wait(listener, talker, time.monotonic() + seconds)


def _wait(listener: Process, talker: Process, deadline: float) -> ConversationOutcome:
    while time.monotonic() < deadline:
        if _readable(listener, STEP_S):
            heard = listener.stdout is not None and "HEARD" in listener.stdout.readline()
            return ConversationOutcome(heard, "" if heard else _last_words(listener))
        if talker.poll() is not None:
            return ConversationOutcome(False, _last_words(talker))
    return ConversationOutcome(False)


def _readable(running: Process, seconds: float) -> bool:
    return bool(running.stdout and select.select([running.stdout], [], [], seconds)[0])


def _last_words(ended: Process) -> str:
    with contextlib.suppress(subprocess.TimeoutExpired):
        return ended.communicate(timeout=ENDING_S)[1]
    return ""


def look(machine: ExaminedMachine, ros: Ros, expected: int, seconds: float) -> list[str] | None:
    """Observe the student's own domain until `expected` nodes are seen, at most `seconds`.

    Returns what the observer printed, or None where it could not run.
    """
    with tempfile.TemporaryDirectory() as logs:
        env = quiet(machine, ros, Path(logs), str(domain_of(machine)))
        with process(ros, env, "look.py", str(expected), str(seconds)) as observer:
            try:
                answer, _ = observer.communicate(timeout=seconds + 10)
            except subprocess.TimeoutExpired:
                return None
    return answer.splitlines() if '"topics"' in answer else None


def quiet(machine: ExaminedMachine, ros: Ros, logs: Path, domain: str) -> dict[str, str]:
    """Return variables for a ROS process that stays on this computer and leaves no log."""
    env = {name: value for name, value in machine.env.items() if name not in DROPPED}
    if ros.python != Path(sys.executable):
        env.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)  # another Python sets its own paths
    return env | {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": domain,
        "ROS_LOG_DIR": str(logs),
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(HERE / "quick_discovery.xml"),
    }


def domain_of(machine: ExaminedMachine) -> int:
    """Return the student's domain; 0 where nothing or no number is set."""
    value = machine.env.get("ROS_DOMAIN_ID", "")
    return int(value) if value.isdigit() else 0


def udp_ports(machine: ExaminedMachine) -> set[int]:
    """Return the UDP ports that programs of this computer hold (Linux only)."""
    lines = machine.read("/proc/net/udp").splitlines()[1:]
    return {int(line.split()[1].rpartition(":")[2], 16) for line in lines if ":" in line}


def participants(machine: ExaminedMachine, domain: int) -> int:
    """Count the ROS programs of a domain on this computer, by the ports that DDS gives them.

    A program holds port 7400 + 250 * domain + 10 + 2 * n, with an n of its own.
    """
    first = FIRST_PORT + PORTS_PER_DOMAIN * domain
    places = {port - first for port in udp_ports(machine)}
    return sum(10 <= place < PORTS_PER_DOMAIN and place % 2 == 0 for place in places)


def free_domain(machine: ExaminedMachine) -> int:
    """Return a domain in which no program of this computer has a port."""
    ports = udp_ports(machine)
    used = {(port - FIRST_PORT) // PORTS_PER_DOMAIN for port in ports if port >= FIRST_PORT}
    free = [domain for domain in range(1, LAST_DOMAIN + 1) if domain not in used]
    return random.choice(free or [LAST_DOMAIN])


@contextlib.contextmanager
def process(ros: Ros, env: dict[str, str], program: str, *words: str) -> Iterator[Process]:
    """Run a program of this folder; it has ended when the block is left.

    Its standard input is its leash: closing it asks the program to end.
    """
    running = subprocess.Popen(
        [str(ros.python), str(HERE / program), *words],
        env=env,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        cwd=os.sep,
        start_new_session=True,  # Ctrl-C goes to the doctor, which then ends it
    )
    try:
        yield running
    finally:
        _end(running)


def _end(running: Process) -> None:
    for pipe in (running.stdin, running.stdout, running.stderr):
        if pipe is not None:
            with contextlib.suppress(OSError):
                pipe.close()
    try:
        running.wait(ENDING_S)
    except subprocess.TimeoutExpired:
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
