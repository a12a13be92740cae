"""The picture of the desk: each of its tabs, beside a real rover made of all labs' solutions.

    .venv/bin/python tests/site/desk_picture.py [FILE]      draws it anew

A browser opens each tab, does what the tab is for, and takes its picture as soon as it shows what a
node said; all of them stand on one sheet.
"""

from __future__ import annotations

import base64
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import root
from roslings_desk.tab import BUILT_IN
from roslings_my_rover.parts import PARTS

sys.path += [
    str(root() / each)
    for each in ("packages/roslings-my-rover/tests", "packages/roslings-desk/tests", "tests")
]
from carried import Carried, carried, put
from desk_program import Desk, desk

from browser import chromium

PICTURE = root() / "packages/roslings-desk/pictures/desk.png"
TAB_PX = {"width": 860, "height": 780}
ACROSS, SHOWN_PX = 3, 480
WAIT_MS = 120_000
SHEET = """
body {{ margin: 0; width: {wide}px; background: #dfe3e8; font: 600 17px "DejaVu Sans", sans-serif }}
main {{ display: grid; grid-template-columns: repeat({across}, {shown}px); gap: 14px;
  padding: 14px; }}
figure {{ margin: 0; }} figcaption {{ padding: 0 0 6px 2px; color: #1d2733; }}
img {{ width: 100%; display: block; border-radius: 6px; box-shadow: 0 1px 5px #0006; }}
"""


def rover(page: Any, robot: Carried) -> None:
    """It has driven, and its way is drawn."""
    robot.drive(0.4, 0.35, until_it=lambda: robot.pose[0] > 1.0)
    page.get_by_text(re.compile(r"^x [1-9]")).wait_for()


def graph(page: Any, robot: Carried) -> None:
    """Around one node: the whole of it is wider than a picture."""
    page.get_by_role("img", name=re.compile("raph")).first.wait_for()


def topics(page: Any, robot: Carried) -> None:
    """The newest message of one of them."""
    page.get_by_role("button", name="/robot_status").click()
    page.get_by_text("Robot status count").first.wait_for()


def frames(page: Any, robot: Carried) -> None:
    """The tree, with a body that moves and a laser that does not."""
    page.get_by_role("row").filter(has_text="laser").get_by_text("static").wait_for()
    page.get_by_role("row").filter(has_text="base_link").get_by_text("Hz").wait_for()


def plot(page: Any, robot: Carried) -> None:
    """How fast it drives, and how fast it turns."""
    for field in ("twist.twist.linear.x", "twist.twist.angular.z"):
        page.get_by_label("Topic", exact=True).select_option("/odom")
        page.get_by_label("Or type a field").fill(field)
        page.get_by_role("button", name="Add the curve").click()
    began = [robot.pose[2]]
    robot.drive(0.3, 0.6, until_it=lambda: abs(robot.pose[2] - began[0]) > 60)
    robot.drive(0.1, -0.5, until_it=lambda: abs(robot.pose[2] - began[0]) < 20)


def services(page: Any, robot: Carried) -> None:
    """A speed limit that was asked for, and the answer."""
    page.get_by_role("button", name="/set_max_speed").click()
    page.get_by_role("checkbox", name="data (boolean)").check()
    page.get_by_role("button", name="Call", exact=True).click()
    page.get_by_role("region", name="The answer").get_by_text("message").wait_for()


def actions(page: Any, robot: Carried) -> None:
    """A goal that runs."""
    page.get_by_role("button", name="/drive_to").click()
    page.get_by_label("x (double)").fill("0.5")
    page.get_by_label("tolerance (double)").fill("0.1")
    page.get_by_role("button", name="Send goal").click()
    page.get_by_role("region", name="The feedback").get_by_text("distance").wait_for()


def parameters(page: Any, robot: Carried) -> None:
    """The sliders of the node that limits the speed."""
    node = page.get_by_label("Node", exact=True)
    node.get_by_text("/speed_limiter", exact=True).wait_for(state="attached")
    node.select_option("/speed_limiter")
    page.get_by_role("slider").first.wait_for()


def image(page: Any, robot: Carried) -> None:
    """What the camera sees: the ball."""
    from geometry_msgs.msg import PointStamped

    balls = robot.hear(PointStamped, "/ball")
    robot.drive(0.0, 0.4, until_it=lambda: bool(balls) and 250 < balls[-1].point.x < 390)
    robot.drive(0.0, until_it=lambda: not robot.pose[3])
    topic = page.get_by_label("Topic", exact=True)
    topic.get_by_text("/camera/image_raw", exact=True).wait_for(state="attached")
    topic.select_option("/camera/image_raw")
    page.get_by_text(re.compile("Brightness [0-9]")).first.wait_for()


def log(page: Any, robot: Carried) -> None:
    """What the nodes say."""
    page.get_by_role("row").nth(4).wait_for()


SHOWN: dict[str, Callable[[Any, Carried], None]] = {
    "rover": rover,
    "graph": graph,
    "topics": topics,
    "frames": frames,
    "plot": plot,
    "services": services,
    "actions": actions,
    "parameters": parameters,
    "image": image,
    "log": log,
}
"""A tab's name to what is done in it before its picture is taken."""


def alt() -> str:
    """What the picture shows, in words."""
    *names, last = (name.capitalize() for name in BUILT_IN)
    return f"The desk beside a rover of all twelve days. Its tabs: {', '.join(names)} and {last}."


@contextmanager
def robot_and_desk(home: Path) -> Iterator[tuple[Carried, Desk]]:
    """A rover of the labs' solutions, and the desk on its domain."""
    for part in PARTS:
        put(home, part)
    with (
        leased_domain() as domain,
        carried(home, "--keys", keys=True, domain=domain) as robot,
        desk(domain, home) as opened,
    ):
        robot.press(" ")  # it begins stopped
        yield robot, opened


def taken(browser: Any, opened: Desk, robot: Carried) -> Iterator[tuple[str, bytes]]:
    """Each tab's title and its picture."""
    context = browser.new_context(viewport=TAB_PX, color_scheme="light")
    context.set_default_timeout(WAIT_MS)
    page = context.new_page()
    opened.let_in(page)
    for name, shows in SHOWN.items():
        page.goto(f"{opened.base}/{name}")
        shows(page, robot)
        yield name.capitalize(), page.screenshot()
    context.close()


def sheet(browser: Any, pictures: list[tuple[str, bytes]]) -> bytes:
    """All on one, as a PNG."""
    figures = "".join(
        f"<figure><figcaption>{title}</figcaption>"
        f'<img src="data:image/png;base64,{base64.b64encode(png).decode()}"></figure>'
        for title, png in pictures
    )
    wide = ACROSS * (SHOWN_PX + 14) + 14
    style = SHEET.format(wide=wide, across=ACROSS, shown=SHOWN_PX)
    page = browser.new_page(viewport={"width": wide, "height": 100})
    page.set_content(f"<style>{style}</style><main>{figures}</main>")
    png: bytes = page.screenshot(full_page=True)
    page.close()
    return png


def drawn(browser: Any, home: Path) -> tuple[list[tuple[str, bytes]], bytes]:
    """Each tab's picture, and the sheet."""
    with robot_and_desk(home) as (robot, opened):
        pictures = list(taken(browser, opened, robot))
    return pictures, sheet(browser, pictures)


def main(file: Path) -> None:
    """Draw it."""
    with tempfile.TemporaryDirectory() as home, chromium() as browser:
        _, png = drawn(browser, Path(home))
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(png)
    print(f"{file}: {len(png) / 1000:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURE)
