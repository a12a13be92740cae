"""Takes names out of a report, so that it can be pasted into a request for help."""

from __future__ import annotations

import os
import re
import socket
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from ros_doctor.examine import Examination, ExaminedCheck
from ros_doctor.finding import MendStep
from ros_doctor.machine import ExaminedMachine

# Names that tell nothing about a person, and that stand in many paths and texts.
COMMON = frozenset(
    [
        "root",
        "user",
        "ubuntu",
        "debian",
        "pi",
        "ros",
        "student",
        "admin",
        "vscode",
        "robot",
        "raspberrypi",
        "localhost",
        "home",
        "docker",
        "jovyan",
        "penguin",
        "roslings",
    ]
)
SHORTEST = 3

HOMES = re.compile(r"(/home/|/Users/|/mnt/[a-z]/Users/)(?!USER\b)[^/\s'\":]+")
MAC = re.compile(r"\b(?:[0-9A-Fa-f]{2}:){5}[0-9A-Fa-f]{2}\b")
IPV4 = re.compile(r"\b(?:\d{1,3}\.){3}\d{1,3}\b(?!/)")
GROUPS = r"[0-9A-Fa-f]{1,4}(?::[0-9A-Fa-f]{1,4})*"
IPV6 = re.compile(
    rf"(?<![\w:])(?:(?:{GROUPS})?::(?:{GROUPS})?|(?:[0-9A-Fa-f]{{1,4}}:){{7}}[0-9A-Fa-f]{{1,4}})(?![\w:])"
)
EMAIL = re.compile(r"[\w.+-]+@[\w-]+(?:\.[\w-]+)+")
NOT_SOMEONE = frozenset(("127.0.0.1", "0.0.0.0", "225.0.0.1"))


@dataclass(frozen=True)
class Secrets:
    """What a report must not show: the home folder, the user's names, the computer's names."""

    home: Path
    people: tuple[str, ...] = ()
    hosts: tuple[str, ...] = ()

    def hidden(self, text: str) -> str:
        """Return the text with all of it replaced."""
        if len(self.home.parts) > 1:
            text = re.sub(re.escape(str(self.home)) + r"(?![\w-])", "~", text)
        text = HOMES.sub(r"\1USER", text)
        text = _words(text, self.people, "USER")
        text = _words(text, self.hosts, "HOST")
        text = EMAIL.sub("EMAIL", text)
        text = IPV6.sub("ADDRESS", MAC.sub("ADDRESS", text))
        return IPV4.sub(lambda found: _address(found.group()), text)


def _address(text: str) -> str:
    return text if text in NOT_SOMEONE else "ADDRESS"


def _words(text: str, names: Iterable[str], cover: str) -> str:
    for name in sorted(names, key=len, reverse=True):
        if len(name) >= SHORTEST and name.lower() not in COMMON:
            text = re.sub(
                rf"(?<![A-Za-z0-9]){re.escape(name)}(?![A-Za-z0-9])", cover, text, flags=re.I
            )
    return text


def secrets_of(machine: ExaminedMachine) -> Secrets:
    """Return what identifies this machine's user and host."""
    names = {machine.env.get(name, "") for name in ("USER", "LOGNAME", "USERNAME", "SUDO_USER")}
    hosts = {machine.env.get("HOSTNAME", ""), socket.gethostname()}
    hosts |= {host.partition(".")[0] for host in hosts}
    return Secrets(machine.home, tuple(sorted(names | _account())), tuple(sorted(hosts)))


def _account() -> set[str]:
    """Return the login name and the words of the full name."""
    try:
        import pwd

        entry = pwd.getpwuid(os.getuid())
    except (ImportError, KeyError):
        return set()
    return {entry.pw_name, *re.split(r"[\s,]+", entry.pw_gecos)}


def redacted(examination: Examination) -> Examination:
    """Return the same examination, fit to be shown to strangers."""
    secrets = secrets_of(examination.machine)
    results = tuple(_result(secrets, one) for one in examination.results)
    workspace = Path(secrets.hidden(str(examination.machine.workspace)))
    machine = replace(examination.machine, workspace=workspace)
    return replace(examination, machine=machine, results=results)


def _result(secrets: Secrets, result: ExaminedCheck) -> ExaminedCheck:
    finding = result.finding
    mend = tuple(
        MendStep(secrets.hidden(step.text), secrets.hidden(step.command)) for step in finding.mend
    )
    return replace(result, finding=replace(finding, found=secrets.hidden(finding.found), mend=mend))
