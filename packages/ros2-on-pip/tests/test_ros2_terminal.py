"""What `source setup.bash` gives a terminal: the Tab key, and nodes that announce quickly."""

from __future__ import annotations

import subprocess
import sys

import pytest
from terminal import Shell

from ros2_on_pip.profiles import QUICK_DISCOVERY
from skips import skip_without
from sources import ROOT

pytestmark = pytest.mark.slow

PRESS_TAB = """
source "$1"
complete -p ros2 >/dev/null || exit 1
press() {
    COMP_LINE=$1 COMP_POINT=${#1} COMP_TYPE=9 COMP_KEY=9
    read -ra COMP_WORDS <<<"$1"
    [[ $1 == *" " ]] && COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
    for try in 1 2; do
        spec=$(complete -p ros2)
        spec=${spec##*-F } function=${spec%% *}
        "$function" ros2 "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
        [ $? = 124 ] || break
    done
    echo "${COMPREPLY[*]}"
}
press "$2"
"""
"""As bash does it: 124 means that the words to complete with have only now been read."""


def bash(shell: Shell, script: str, *words: str, **changes: str) -> str:
    """What a script of bash prints."""
    done = subprocess.run(
        ["bash", "-c", script, "bash", str(ROOT / "setup.bash"), *words],
        env=shell.environment | changes,
        cwd=shell.folder,
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    return done.stdout.strip()


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("ros2 to", "topic"),
        ("ros2 topic ec", "echo"),
        ("ros2 topic echo /cm", "/cmd_vel"),
        ("ros2 node info /tu", "/tuner"),
        ("ros2 interface show std_msgs/msg/Str", "std_msgs/msg/String"),
    ],
)
def test_the_tab_key_in_bash(stage: Shell, typed: str, offered: str) -> None:
    """Verbs, nodes, topics and types, from the first time that it is pressed."""
    skip_without("environment for setup.bash")
    assert bash(stage, PRESS_TAB, typed) == offered


def test_nodes_of_a_sourced_terminal_announce_themselves_quickly(empty: Shell) -> None:
    """As those do that `ros2 run` starts; a file of one's own stays."""
    show = 'source "$1"; echo "$FASTRTPS_DEFAULT_PROFILES_FILE"'
    assert bash(empty, show) == str(QUICK_DISCOVERY)
    assert bash(empty, show, FASTRTPS_DEFAULT_PROFILES_FILE="/own.xml") == "/own.xml"


def test_only_our_own_words_are_on_standard_output(empty: Shell) -> None:
    """What a library below Python writes goes where it disturbs no script."""
    code = (
        "import os, sys\nfrom ros2_on_pip import own_output\nown_output.keep()\n"
        "os.write(1, b'from below\\n')\nprint('ours')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=empty.environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert (done.stdout, done.stderr) == ("ours\n", "from below\n")
