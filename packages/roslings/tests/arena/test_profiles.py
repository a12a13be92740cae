"""The profiles of the middleware, which passes over a file that it cannot read."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.arena import environment

PROFILES = sorted(environment.HERE.glob("*.xml"))
ONE_NODE = "import rclpy; rclpy.init(); rclpy.create_node('it'); rclpy.shutdown()"


def said_of(profile: Path) -> str:
    """What the middleware says of a profile when a node is made."""
    told = {
        "RMW_IMPLEMENTATION": environment.MIDDLEWARE,
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(profile),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "RMW_FASTRTPS_PUBLICATION_MODE": "ASYNCHRONOUS",  # paced.xml asks for it
    }
    ran = subprocess.run(
        [sys.executable, "-c", ONE_NODE],
        env=os.environ | told,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout + ran.stderr


@pytest.mark.parametrize("profile", PROFILES, ids=lambda profile: profile.stem)
def test_it_can_be_read(profile: Path) -> None:
    """Every word in it is one that this middleware knows."""
    assert "XML" not in said_of(profile)


def test_a_word_that_is_not_known_is_told(tmp_path: Path) -> None:
    """Else the test above could not fail."""
    wrong = tmp_path / "wrong.xml"
    text = environment.LOSSY_LINK.read_text("utf-8")
    wrong.write_text(text.replace("heartbeatPeriod", "heartbeatPause"))
    assert "XML" in said_of(wrong)
