"""What the desk has heard is saved as a bag, by a button of each page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk_program import Desk, Nodes, desk, until
from PIL import Image as Picture

from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.rosbag2.reading import opened as opened_bag
from roslings_desk import saving
from roslings_desk.hub import SharedSubscription
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

BUTTON = "Save the last 20 s"


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the desk was started."""
    return tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def opened(home: Path) -> Iterator[Desk]:
    """A desk, started there."""
    with leased_domain() as domain, desk(domain, home) as found:
        yield found


def bags(home: Path) -> list[Path]:
    """Those that were saved."""
    return sorted(each for each in home.glob("desk_*") if each.is_dir())


def test_what_open_tabs_heard_is_in_a_new_bag(
    context: Any, opened: Desk, nodes: Nodes, home: Path
) -> None:
    """The messages as they came, on the pages that show the topic; a second one has its own."""
    from rclpy.serialization import deserialize_message
    from std_msgs.msg import Int32

    publisher = nodes.node.create_publisher(Int32, "/count", 10)
    said = iter(range(10**6))
    nodes.node.create_timer(0.02, lambda: publisher.publish(Int32(data=next(said))))
    page = context.new_page()
    page.goto(f"{opened.base}/topics")
    page.get_by_role("button", name="/count").click()
    expect(page.get_by_text(re.compile(r"^\d{2,} came"))).to_be_visible()
    for number in (1, 2):
        page.get_by_role("button", name=BUTTON).press("Enter")
        expect(page.get_by_text("/count:")).to_be_visible()
        folder = page.get_by_text("Saved in").text_content().split()[2].rstrip(".")
        assert len(bags(home)) == number and Path(folder) in bags(home)
        with opened_bag(Path(folder)) as bag:
            there = list(bag.messages())
        counts = [deserialize_message(raw, Int32).data for topic, _, raw in there]
        assert counts == list(range(counts[0], counts[0] + len(counts))) and len(counts) > 10
        times_ns = [time_ns for _, time_ns, _ in there]
        assert times_ns == sorted(times_ns) and times_ns[-1] - times_ns[0] < 20e9
    page.close()
    until(lambda: not nodes.listeners("/count"), "the end of the subscription")


def test_the_way_of_a_robot_is_a_gif_beside_the_bag(
    context: Any, opened: Desk, nodes: Nodes, home: Path
) -> None:
    """From where it was to where it is, in as many frames as the time has."""
    from nav_msgs.msg import Odometry

    publisher = nodes.node.create_publisher(Odometry, "/odom", 10)
    said = Odometry()

    def drive() -> None:
        said.pose.pose.position.x += 0.05
        publisher.publish(said)

    nodes.node.create_timer(0.05, drive)
    page = context.new_page()
    page.goto(f"{opened.base}/rover")
    expect(page.get_by_text(re.compile(r"^x [12]\.\d+ m"))).to_be_visible()
    page.get_by_role("button", name=BUTTON).press("Enter")
    words = page.get_by_text("The map: ")
    expect(words).to_be_visible()
    file = Path(words.text_content().rpartition("The map: ")[2])
    assert file.parent == home and file.with_suffix("") in bags(home)
    with Picture.open(file) as drawn:
        assert drawn.n_frames >= 4
        first, last = (shot(drawn, number) for number in (0, drawn.n_frames - 1))
    assert first != last
    page.close()
    until(lambda: not nodes.listeners("/odom"), "the end of the subscription")


def shot(drawn: Any, number: int) -> bytes:
    """The pixels of one frame."""
    drawn.seek(number)
    return bytes(drawn.convert("RGB").tobytes())


def heard_poses(places: list[float]) -> SharedSubscription:
    """What a subscription to /odom has kept."""
    from nav_msgs.msg import Odometry
    from rclpy.serialization import serialize_message

    heard = SharedSubscription("/odom", "nav_msgs/msg/Odometry", Odometry)
    for x_m in places:
        said = Odometry()
        said.pose.pose.position.x = x_m
        heard.add(serialize_message(said))
    return heard


def test_without_matplotlib_the_bag_is_saved_all_the_same(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """And it is said why there is no GIF."""
    monkeypatch.setattr(saving, "can_draw", lambda: False)
    saved = saving.save([heard_poses([1.0, 2.0])], tmp_path)
    assert saved.folder.is_dir() and not list(tmp_path.glob("*.gif"))
    assert "No GIF of the map: matplotlib is not installed here." in saved.words


def test_a_place_that_is_no_number_is_left_out_of_the_map(tmp_path: Path) -> None:
    """Where none is left, there is no map, and no word of it."""
    nan = float("nan")
    assert "map" not in saving.save([heard_poses([nan, nan])], tmp_path).words
    saved = saving.save([heard_poses([1.0, nan])], tmp_path)
    with Picture.open(saved.folder.with_name(f"{saved.folder.name}.gif")) as drawn:
        assert drawn.n_frames == 1


def test_nothing_heard_is_told_and_nothing_written(context: Any, opened: Desk, home: Path) -> None:
    """With the next step."""
    before = bags(home)
    page = context.new_page()
    page.goto(f"{opened.base}/services")
    page.get_by_role("button", name=BUTTON).click()
    expect(page.get_by_role("alert").filter(has_text="Open a tab that shows it")).to_be_visible()
    assert bags(home) == before


def test_a_folder_that_takes_no_file_is_told(browser: Any, tmp_path: Path) -> None:
    """The page goes on."""
    home = tmp_path / "gone"
    home.mkdir()
    with leased_domain() as domain, desk(domain, home) as own, Nodes(domain) as nodes:
        from nav_msgs.msg import Odometry

        publisher = nodes.node.create_publisher(Odometry, "/odom", 10)
        nodes.node.create_timer(0.05, lambda: publisher.publish(Odometry()))
        home.rmdir()
        home.touch()
        page = browser.new_page()
        page.goto(own.file.as_uri())
        expect(page.get_by_text("x 0.00 m")).to_be_visible()
        page.get_by_role("button", name=BUTTON).click()
        expect(page.get_by_role("alert").filter(has_text="cannot be written")).to_be_visible()
        page.close()
