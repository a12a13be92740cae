"""Programs that print without end, graded as a student would: a failed check, with their lines."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from roslings.course import lab
from until_told import checked

SPIN = "        rclpy.spin(Talker())"
LOOP = "while True: print('again', file=__import__('sys').{stream})"
FLOODS = {
    "a node": ("topics", "chatter/talker.py", SPIN, "        talker = Talker()\n        {loop}"),
    "a callback": ("topics", "chatter/talker.py", "        self.count += 1", "        {loop}"),
    "a logger": (
        "topics",
        "chatter/talker.py",
        SPIN,
        "        talker = Talker()\n        while True: talker.get_logger().info('again')",
    ),
    "a program with one task": (
        "black-box",
        "black_box/read_drive.py",
        "def main(",
        "{loop}\n\n\ndef main(",
    ),
    "a launch file": (
        "bring-up",
        "launch/bring_up.launch.py",
        "    return LaunchDescription(",
        "    {loop}\n    return LaunchDescription(",
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("stream", ["stdout", "stderr"])
@pytest.mark.parametrize("where", FLOODS)
def test_it_is_a_failed_check_and_not_a_verdict_that_nobody_knows(
    tmp_path: Path, where: str, stream: str
) -> None:
    """Of nodes, of a program that ends, and of a launch file; on both streams."""
    name, file, find, replace = FLOODS[where]
    (solution,) = (lab(name).folder / "solution").iterdir()
    package = tmp_path / solution.name
    shutil.copytree(solution, package)
    text = (package / file).read_text("utf-8")
    assert text.count(find) == 1
    loop = LOOP.format(stream=stream)
    (package / file).write_text(text.replace(find, replace.format(loop=loop)), "utf-8")
    found = checked(name, package, folder=tmp_path)
    floods = [check for check in found.verdict["checks"] if check["fault"] == "PrintsWithoutEnd"]
    assert [check["outcome"] for check in floods] == ["fail"]
    assert re.search(r"it wrote [1-9][\d,]+ lines", floods[0]["measured"])
    assert found.outcomes("inconclusive") == []
