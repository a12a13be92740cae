"""Evidence that is kept with the course tells nothing of the machine that measured it."""

from __future__ import annotations

import getpass
import re
import socket
import sys
from pathlib import Path

import pytest

from kills_of_old import LABS, read_kills
from roslings.capabilities.camera.record import CameraSeen, PictureKept
from roslings.course import lab, root
from roslings.evidence import Evidence, LogLine, evidence_json, read_json
from roslings.judge import judge
from roslings.verdict import CheckResult
from roslings_prove.anonymous import for_judging, replacements, without_machine

GRADING = "/var/tmp/roslings-1000-a_b1c2d3"
PYTHON = "/python" if len(Path(sys.base_prefix).parts) > 2 else sys.base_prefix
"""A Python in /usr tells nothing of the machine."""
SAID = {
    f'File "{GRADING}/room/build/chatter/talker.py", line 3': (
        'File "/grading/room/build/chatter/talker.py", line 3'
    ),
    f"copying {GRADING}/builds/ab12/x.py -> {GRADING}/room/x.py": (
        "copying /grading/builds/ab12/x.py -> /grading/room/x.py"
    ),
    f"no port {GRADING}/devices/tmp8_x1/ttyROVER": "no port /grading/devices/it/ttyROVER",
    f"in /run/roslings-user-7-{'q' * 8}/log": "in /grading/log",
    f'File "{root()}/src/roslings/x.py"': 'File "/course/src/roslings/x.py"',
    f'File "{sys.base_prefix}/lib/python3/runpy.py"': f'File "{PYTHON}/lib/python3/runpy.py"',
    f"in /x/log/2026-11-26-21-20-25-657616-{socket.gethostname()}-2": (
        "in /x/log/2026-11-26-21-20-25-657616-computer-2"
    ),
    f"{root()}s is another folder": f"{root()}s is another folder",
    "/tmp/rover_camera is what the card says": "/tmp/rover_camera is what the card says",
    f"{socket.gethostname()} is a word": f"{socket.gethostname()} is a word",
}
"""What a node wrote, and what is kept of it."""


def some_evidence(name: str = "topics") -> Evidence:
    """Of a wrong package of a lab."""
    return next(read_kills(name))[1]


@pytest.mark.parametrize("said", SAID)
def test_words_of_the_machine_are_replaced(said: str) -> None:
    """And nothing else is."""
    evidence = some_evidence()
    seen = next(iter(evidence.experiments.values()))
    seen.rosout["/talker"] = [LogLine(arrival_ns=1, text=said, source="rosout")]
    kept = without_machine(evidence).experiments[seen.name].rosout["/talker"]
    assert [line.text for line in kept] == [SAID[said]]


@pytest.mark.parametrize("name", LABS)
def test_real_evidence_tells_nothing_of_its_machine(name: str) -> None:
    """No folder of a grading, of this course, of a person or of Python; no kernel."""
    own = "|".join(map(re.escape, (str(root()), f"/home/{getpass.getuser()}", sys.base_prefix)))
    for kill, evidence in read_kills(name):
        text = evidence_json(without_machine(evidence)).decode()
        assert not re.search(rf"roslings-\d+-|devices/tmp|(?:{own})/", text), kill.package
        assert not re.search(r"Linux \d", text), kill.package


@pytest.mark.parametrize("name", LABS)
def test_what_is_kept_is_judged_in_the_same_words(name: str) -> None:
    """But for the names of folders in what is quoted."""
    for kill, evidence in read_kills(name):
        kept = for_judging(without_machine(evidence))
        before, now = (judge(lab(name), each).checks for each in (evidence, kept))
        assert [facts(check) for check in now] == [facts(check) for check in before], kill.package


def facts(check: CheckResult) -> tuple[object, ...]:
    """What a proof compares, and what is asked for."""
    expected = check.expected or ""
    for pattern, word in replacements():
        expected = re.sub(pattern, word, expected)
    return check.id, check.outcome, check.fault, check.points, expected


def test_it_is_as_if_measured_on_no_machine() -> None:
    """Once is enough, and the evidence itself is not changed."""
    evidence = some_evidence("serial-bridge")
    before = evidence_json(evidence)
    once = for_judging(without_machine(evidence))
    assert evidence_json(for_judging(without_machine(once))) == evidence_json(once)
    assert evidence_json(evidence) == before
    assert read_json(evidence_json(once)) == once


def test_pictures_for_the_reader_are_not_kept() -> None:
    """They are two thirds of what a camera's evidence takes, and no check reads them."""
    evidence = some_evidence("pi-camera")
    seen = next(iter(evidence.experiments.values()))
    picture = PictureKept(title="A ball", caption="A ball.", png="AAAA", width=1, height=1)
    seen.recording(CameraSeen).pictures.append(picture)
    kept = for_judging(evidence)
    assert kept.experiments[seen.name].part(CameraSeen).pictures == []
    assert kept.timeline == []
    assert seen.part(CameraSeen).pictures == [picture]
