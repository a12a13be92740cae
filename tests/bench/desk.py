"""The desk: how soon it shows what nodes say, and what that takes.

    .venv/bin/python tests/bench/desk.py [MINUTES]

Prints what the group `desk` adds to `ros2`; the seconds from Enter to the first value in a page;
the time from a message on /odom to other pixels of the map, idle and with all on one processor; the
pictures shown in a second; the server's share of a core, beside that of a bare node that hears the
same; and, where MINUTES are given, its memory after so many over that after one. The browser is
Debian's Chromium.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

import tomllib

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "packages/roslings-desk/tests")]

from desk_program import Desk, Nodes, desk, environment  # noqa: E402
from my_rover import cpu_s, pss_mb  # noqa: E402
from packaging.requirements import Requirement  # noqa: E402

from browser import chromium  # noqa: E402
from ros2_on_pip.domain_lease import leased_domain  # noqa: E402

MOVES, MOVE_EVERY_S, MOVE_M = 120, 0.31, 0.1
"""So far and so seldom that each message is drawn, and falls anywhere in the page's period."""
WATCHED_S, ODOM_HZ, PICTURE_HZ = 20.0, 20.0, 15.0
STAMPS = """() => {
    window.stamps = [];
    const map = document.querySelector(SELECTOR);
    new MutationObserver(() => map.decode().then(() => requestAnimationFrame(
        () => window.stamps.push(Date.now() / 1000)), () => undefined)
    ).observe(map, {attributes: true, attributeFilter: ["src"]});
}"""
"""Keeps when an image was drawn with another source, in seconds since 1970."""
BARE = """
import rclpy
from nav_msgs.msg import Odometry
rclpy.init()
node = rclpy.create_node("bare")
node.create_subscription(Odometry, "/odom", lambda message: None, 10)
rclpy.spin(node)
"""


def closure(*names: str) -> dict[str, float]:
    """Distributions that these lead to, with what their files hold, in MB."""
    found: dict[str, float] = {}
    waiting = list(names)
    while waiting:
        name = waiting.pop().lower().replace("_", "-")
        if name in found:
            continue
        try:
            there = distribution(name)
        except PackageNotFoundError:
            continue  # for another Python or system
        files = (Path(str(there.locate_file(file))) for file in there.files or ())
        found[name] = sum(file.stat().st_size for file in files if file.is_file()) / 1e6
        for line in there.requires or ():
            wanted = Requirement(line)
            if not wanted.marker or wanted.marker.evaluate({"extra": ""}):
                waiting.append(wanted.name)
    return found


def in_group(name: str) -> Iterator[str]:
    """The distributions that a group of pyproject names, with those of groups in it."""
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["dependency-groups"]
    for each in groups[name]:
        if isinstance(each, str):
            yield Requirement(each).name
        else:
            yield from in_group(each["include-group"])


def added() -> str:
    """What the group `desk` adds to the group `ros2`."""
    before = closure(*in_group("ros2"))
    own = {name: mb for name, mb in closure(*in_group("desk")).items() if name not in before}
    return f"{len(own)} packages, {sum(own.values()):.0f} MB"


@contextmanager
def at(browser: Any, opened: Desk, tab: str) -> Iterator[Any]:
    """A page of the desk; the key is used by the file."""
    context = browser.new_context()
    page = context.new_page()
    opened.let_in(page)
    if tab != "rover":
        page.goto(f"{opened.base}/{tab}")
    yield page
    context.close()


class Odom:
    """A node that says where a robot is: at a rate, or when it is told."""

    def __init__(self, nodes: Nodes) -> None:
        from nav_msgs.msg import Odometry

        self._message = Odometry()
        self._message.header.frame_id = "odom"
        self._message.pose.pose.orientation.w = 1.0
        self._publisher = nodes.node.create_publisher(Odometry, "/odom", 10)
        self._ended = threading.Event()

    def say(self, x_m: float) -> float:
        """Publish; when that was, in seconds since 1970."""
        self._message.pose.pose.position.x = x_m
        self._publisher.publish(self._message)
        return time.time()

    @contextmanager
    def at_rate(self) -> Iterator[None]:
        """It goes to and fro."""
        thread = threading.Thread(target=self._go)
        thread.start()
        yield
        self._ended.set()
        thread.join()
        self._ended.clear()

    def _go(self) -> None:
        for number in range(10**9):
            if self._ended.wait(1 / ODOM_HZ):
                return
            self.say(abs(number % 40 - 20) / 20)


def to_pixels_s(page: Any, odom: Odom) -> list[float]:
    """From a message to other pixels; those that no page has shown are left out."""
    page.get_by_role("img", name="Map").wait_for()
    page.evaluate(STAMPS.replace("SELECTOR", "'img.map'"))
    said_s = []
    for number in range(MOVES):
        said_s.append(odom.say(MOVE_M * (number % 10)))
        page.wait_for_timeout(MOVE_EVERY_S * 1000)
    shown_s = page.evaluate("window.stamps")
    firsts = (next((each - said for each in shown_s if each > said), 9.0) for said in said_s)
    return [late_s for late_s in firsts if late_s < MOVE_EVERY_S]


def pictures_hz(page: Any, nodes: Nodes) -> float:
    """Pictures of 640 x 480 that a page shows, of 15 a second."""
    from sensor_msgs.msg import Image

    message = Image(encoding="rgb8", width=640, height=480, step=1920)
    publisher = nodes.node.create_publisher(Image, "/camera", 10)
    shades = [bytes([shade, 80, 120]) * (640 * 480) for shade in range(0, 250, 10)]

    def film() -> None:
        message.header.stamp.nanosec = (message.header.stamp.nanosec + 1) % len(shades)
        message.data = shades[message.header.stamp.nanosec]
        publisher.publish(message)

    timer = nodes.node.create_timer(1 / PICTURE_HZ, film)
    topic = page.get_by_label("Topic", exact=True)
    topic.get_by_text("/camera", exact=True).wait_for(state="attached")
    topic.select_option("/camera")
    page.get_by_text("Brightness").first.wait_for()
    page.evaluate(STAMPS.replace("SELECTOR", "'.picture'"))
    page.wait_for_timeout(WATCHED_S * 1000)
    shown = page.evaluate("window.stamps.length")
    nodes.node.destroy_timer(timer)
    return float(shown) / WATCHED_S


def share(pid: int) -> float:
    """Of one core, while it is watched."""
    before_s, began_s = cpu_s([pid]), time.monotonic()
    time.sleep(WATCHED_S)
    return (cpu_s([pid]) - before_s) / (time.monotonic() - began_s)


@contextmanager
def bare(domain: int, home: Path) -> Iterator[int]:
    """A node that hears /odom, and does nothing with it."""
    with subprocess.Popen(
        [sys.executable, "-c", BARE], env=environment(domain, home), start_new_session=True
    ) as process:
        time.sleep(3.0)
        yield process.pid
        process.kill()


def told(late_s: list[float]) -> str:
    """Median and p95."""
    ranks = statistics.quantiles(late_s, n=20)
    return (
        f"median {statistics.median(late_s) * 1000:.0f} ms, p95 {ranks[-1] * 1000:.0f} ms,"
        f" {len(late_s)} of {MOVES} seen alone"
    )


def first_value_s(browser: Any, domain: int, home: Path) -> float:
    """From Enter to a page that tells where the robot is."""
    began_s = time.monotonic()
    with desk(domain, home) as opened, at(browser, opened, "rover") as page:
        page.get_by_text("heading").first.wait_for()
        seconds = time.monotonic() - began_s
        opened.interrupt()  # it says goodbye, so the next one waits for nobody who is gone
        return seconds


def main(minutes: float) -> None:
    """Print the figures."""
    print(f"added to the group ros2: {added()}", flush=True)
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    with (
        leased_domain() as domain,
        tempfile.TemporaryDirectory() as folder,
        chromium() as browser,
        Nodes(domain) as nodes,
    ):
        home, odom = Path(folder), Odom(nodes)
        with odom.at_rate():
            first_s = sorted(first_value_s(browser, domain, home) for _ in range(5))
            print(
                f"Enter to the first value: median of 5 {first_s[2]:.2f} s,"
                f" {first_s[0]:.2f} to {first_s[-1]:.2f}",
                flush=True,
            )
            with bare(domain, home) as pid:
                alone = share(pid)
        with desk(domain, home) as opened:
            measure(browser, opened, odom, nodes, alone)
            if minutes:
                print(f"memory: {growth(browser, opened, odom, minutes):.2f}", flush=True)


def measure(browser: Any, opened: Desk, odom: Odom, nodes: Nodes, alone: float) -> None:
    """Of a desk that is open: times, pictures, processors."""
    pid = opened.process.pid
    with at(browser, opened, "rover") as page:
        print(f"/odom to pixels: {told(to_pixels_s(page, odom))}", flush=True)
        with on_one_processor():
            print(f"... all on one processor: {told(to_pixels_s(page, odom))}", flush=True)
        with odom.at_rate():
            busy = share(pid)
    with at(browser, opened, "image") as page:
        print(f"pictures shown: {pictures_hz(page, nodes):.1f} a second of {PICTURE_HZ:g}")
    time.sleep(3.0)
    with odom.at_rate():
        idle = share(pid)
    print(
        f"of a core: bare node {alone:.1%}; one page {busy:.1%}, nothing open {idle:.1%}",
        flush=True,
    )


@contextmanager
def on_one_processor() -> Iterator[None]:
    """This process, and each that descends from it, threads too."""
    from my_rover import family

    def put(places: set[int]) -> None:
        for pid in family(os.getpid()):
            for task in Path(f"/proc/{pid}/task").glob("*"):
                os.sched_setaffinity(int(task.name), places)

    before = os.sched_getaffinity(0)
    put({min(before)})
    yield
    put(before)


def growth(browser: Any, opened: Desk, odom: Odom, minutes: float) -> float:
    """Memory after so many minutes, over that after one."""
    with at(browser, opened, "rover"), odom.at_rate():
        time.sleep(60.0)
        first_mb = pss_mb([opened.process.pid])
        time.sleep(60.0 * (minutes - 1))
        return pss_mb([opened.process.pid]) / first_mb


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 0.0)
