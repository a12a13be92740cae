"""The names that books use: each has a tab or an honest answer, and words behind it work."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any

import pytest
from desk_program import Desk, Nodes, desk, environment, program

from ros2_on_pip.absent import ABSENT
from ros2_on_pip.command_names import COMMANDS
from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.well_known import WELL_KNOWN, absent
from ros2_on_pip.windows import GROUP
from roslings_desk.book_names import WINDOWS
from roslings_desk.shown import TAKE_WORDS
from roslings_desk.tab import BUILT_IN
from roslings_desk.tabs.plot import curves_in, topic_and_path
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)

OF_BOOKS = (
    "rqt",
    "rqt_graph",
    "rqt_plot",
    "rqt_reconfigure",
    "rqt_image_view",
    "rqt_console",
    "rqt_topic",
    "rqt_publisher",
)
RUN = (
    "import sys; {before}from ros2_on_pip.window_commands import {name}; sys.exit({name}({words}))"
)
NO_DESK = "sys.modules['nicegui'] = None; "


def typed(name: str, *words: str, before: str = "", path: str = "", home: Path) -> Any:
    """A name alone in a terminal; what came of it."""
    code = RUN.format(name=name, words=list(words), before=before)
    seen = environment(0, home)
    seen["PATH"] = f"{path}{os.pathsep}{seen['PATH']}"
    return subprocess.run(
        [sys.executable, "-c", code],
        env=seen,
        cwd=home,
        text=True,
        capture_output=True,
        check=False,
    )


# --- the tables --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", sorted({*ABSENT, *WELL_KNOWN, *OF_BOOKS}))
def test_no_absent_name_is_without_a_tab_or_an_answer(name: str) -> None:
    """Each of both tables, and each that books type: what is said, and a tab that is there."""
    told = absent(name)
    assert told is not None and ". Use instead: " in told.told(name)
    if name in WINDOWS:
        assert WINDOWS[name].tab in BUILT_IN
    else:
        assert name not in OF_BOOKS


def test_each_tab_but_none_of_ours_alone_has_the_name_of_a_window() -> None:
    """And each window's name has an answer where no desk is installed."""
    assert {window.tab for window in WINDOWS.values()} == set(BUILT_IN)
    assert all(absent(name) for name in WINDOWS)
    assert set(TAKE_WORDS) <= set(BUILT_IN)


def test_each_name_of_books_is_a_command_of_its_own() -> None:
    """`rqt_graph` is the engine's, which can save a picture, too."""
    commands = {name for _, name, _, _ in COMMANDS}
    assert set(OF_BOOKS) - commands == {"rqt_graph"}
    assert {name for name in commands if name.startswith("rqt")} <= set(WINDOWS)


def test_the_package_offers_them() -> None:
    """By the entry point that its wheel has."""
    (point,) = (each for each in entry_points(group=GROUP) if each.name == "roslings_desk")
    assert isinstance(point, EntryPoint) and point.load() is WINDOWS


# --- what stands behind a name -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "argv", "read"),
    [
        ("rqt_plot", ["/pose/x", "/pose/y"], ("plot", ["/pose/x", "/pose/y"], [])),
        ("rqt_image_view", ["/image"], ("image", ["/image"], [])),
        ("rqt", [], ("rover", [], [])),
        ("rqt", ["--standalone", "rqt_plot"], ("plot", [], [])),
        ("rqt", ["-s", "rqt_plot/Plot", "/a/b"], ("plot", ["/a/b"], [])),
        ("rqt", ["-s", "rqt_image_view.image_view.ImageView"], ("image", [], [])),
        ("rqt", ["-s", "rqt_of_mine"], ("rover", [], [])),
        ("rqt", ["-s"], ("rover", [], [])),
        ("rqt_console", ["--clear-config", "x"], ("log", [], ["--clear-config", "x"])),
        (
            "rqt_image_view",
            ["--ros-args", "-r", "image:=/a", "--", "/b"],
            ("image", ["/b"], ["--ros-args", "-r", "image:=/a", "--"]),
        ),
    ],
)
def test_words_of_the_real_ones_are_read(name: str, argv: list[str], read: object) -> None:
    """What the desk has no use for is left out, and is said to be."""
    assert WINDOWS[name].read(argv) == read


@pytest.mark.parametrize(
    ("word", "curves"),
    [
        ("/pose/x", ["/pose/x"]),
        ("pose/x:y:theta", ["/pose/x", "/pose/y", "/pose/theta"]),
        ("/scan/ranges[0]", ["/scan/ranges[0]"]),
        ("/number", ["/number"]),
        ("", []),
        (":", []),
    ],
)
def test_a_word_of_rqt_plot_names_curves(word: str, curves: list[str]) -> None:
    """One may name several fields of a message."""
    assert curves_in(word) == curves


def test_the_longest_topic_is_meant() -> None:
    """A topic may begin as another one does."""
    there = ["/arm", "/arm/pose", "/arms"]
    assert topic_and_path("/arm/pose/position/x", there) == ("/arm/pose", "position.x")
    assert topic_and_path("/arm/speed", there) == ("/arm", "speed")
    assert topic_and_path("/arms", there) == ("/arms", "")
    assert topic_and_path("/leg/x", there) is None


# --- in a terminal -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", [name for name in OF_BOOKS if name != "rqt_graph"])
def test_without_a_desk_there_is_the_answer(name: str, tmp_path: Path) -> None:
    """In words, with what to use instead; and it ends with 2."""
    done = typed(name, "/a/b", before=NO_DESK, home=tmp_path)
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert done.stderr.startswith(absent(name).told(name))  # type: ignore[union-attr]


def test_no_name_is_taken_where_the_real_one_is(tmp_path: Path) -> None:
    """As in a terminal in which a ROS is sourced; its words reach it."""
    real = tmp_path / "rqt_plot"
    real.write_text('#!/bin/sh\necho "the real one: $*"\n')
    real.chmod(0o755)
    done = typed("rqt_plot", "/a/b", path=str(tmp_path), home=tmp_path)
    assert (done.returncode, done.stdout) == (0, "the real one: /a/b\n")


def test_help_says_what_may_stand_behind_it(tmp_path: Path) -> None:
    """And opens nothing."""
    done = typed("rqt_plot", "--help", home=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "the tab 'plot' of the desk" in done.stdout and "TOPIC/FIELD" in done.stdout


# --- in a browser ------------------------------------------------------------------------------


def numbers(nodes: Nodes, topic: str) -> None:
    """A node that says 1.25, 20 times a second."""
    from std_msgs.msg import Float64

    publisher = nodes.node.create_publisher(Float64, topic, 10)
    nodes.node.create_timer(0.05, lambda: publisher.publish(Float64(data=1.25)))


def come_in(browser: Any, opened: Desk, tab: str) -> Any:
    """A page of a browser that the file has let in."""
    page = browser.new_page()
    page.goto(opened.file.as_uri())
    page.wait_for_url(f"{opened.base}/{tab}")
    return page


@pytest.mark.slow
def test_ros2_run_opens_the_tab_with_what_was_typed(browser: Any, tmp_path: Path) -> None:
    """`ros2 run rqt_plot rqt_plot /number`, before a node has that topic; then it is drawn."""
    words = ["run", "rqt_plot", "rqt_plot", "/number", "/number/nothing"]
    with leased_domain() as domain, program("ros2_on_pip", words, domain, tmp_path) as process:
        opened = Desk(process, domain)
        threading.Thread(target=opened.read, daemon=True).start()
        page = come_in(browser, opened, "plot")
        waiting = page.get_by_text("No node has such a topic yet: /number, /number/nothing")
        expect(waiting).to_be_visible()
        with Nodes(domain) as nodes:
            numbers(nodes, "/number")
            row = page.get_by_role("row", name="/number data")
            expect(row).to_contain_text("1.25")
            expect(waiting).to_have_count(0)
            expect(
                page.get_by_role("alert").filter(has_text="has no number at 'nothing'")
            ).to_be_visible()
        page.close()
        assert opened.interrupt() == 0


@pytest.mark.slow
def test_a_picture_is_shown_that_was_named(browser: Any, tmp_path: Path) -> None:
    """`rqt_image_view image`, as a word behind the tab; nothing has to be chosen."""
    from sensor_msgs.msg import Image

    with (
        leased_domain() as domain,
        desk(domain, tmp_path, "image", "image") as opened,
        Nodes(domain) as nodes,
    ):
        page = come_in(browser, opened, "image")
        publisher = nodes.node.create_publisher(Image, "/image", 10)
        grey = Image(height=2, width=2, step=2, encoding="mono8", data=[81] * 4)
        nodes.node.create_timer(0.1, lambda: publisher.publish(grey))
        expect(page.get_by_text("Brightness 81 of 255")).to_be_visible()
        expect(page.get_by_label("Topic")).to_have_value("/image")
        page.close()


@pytest.mark.slow
def test_parameters_of_the_node_that_was_named(browser: Any, tmp_path: Path) -> None:
    """`rqt_reconfigure /tester`: its parameters are there as soon as it is."""
    with leased_domain() as domain, desk(domain, tmp_path, "parameters", "tester") as opened:
        page = come_in(browser, opened, "parameters")
        expect(page.get_by_text("No node is called /tester yet.")).to_be_visible()
        with Nodes(domain):
            expect(page.get_by_label("use_sim_time (boolean)")).to_be_visible()
        page.close()


@pytest.mark.slow
def test_the_topic_that_was_named_is_listened_to(browser: Any, tmp_path: Path) -> None:
    """`./roslings desk topics /number`."""
    with (
        leased_domain() as domain,
        desk(domain, tmp_path, "topics", "/number") as opened,
        Nodes(domain) as nodes,
    ):
        page = come_in(browser, opened, "topics")
        expect(page.get_by_text("No node has a topic /number yet")).to_be_visible()
        numbers(nodes, "/number")
        newest = page.get_by_role("region", name="The newest message")
        expect(newest).to_contain_text("data: 1.25")
        page.close()


@pytest.mark.slow
def test_a_tab_that_takes_no_words_says_so(tmp_path: Path) -> None:
    """With those that take some."""
    with leased_domain() as domain, desk(domain, tmp_path, "log", "/rosout") as found:
        assert found.process.wait(60) == 2
    assert "The tab 'log' takes no words, so '/rosout' is left over." in "\n".join(found.lines)
