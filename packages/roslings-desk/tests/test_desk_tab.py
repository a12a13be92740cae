"""The tab that a student writes: the one of the docstring, offered by a package of its own."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest
from desk_program import Nodes, desk, until

from ros2_on_pip.domain_lease import leased_domain
from roslings_desk import tab
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow


def written(folder: Path) -> Path:
    """A folder of packages with the class of the docstring, and the line that offers it."""
    assert tab.__doc__
    code = tab.__doc__.partition("\n\n")[2].partition("\n\nIt is offered")[0]
    needs = (
        "from roslings_desk.controls import PageText\nfrom roslings_desk.tab import OpenTab\n\n\n"
    )
    (folder / "my_package").mkdir(parents=True)
    (folder / "my_package/__init__.py").touch()
    (folder / "my_package/battery.py").write_text(needs + dedent(code) + "\n", "utf-8")
    (line,) = (each for each in tab.__doc__.split("`") if each.startswith("battery ="))
    info = folder / "my_package-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-package\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{tab.GROUP}]\n{line}\n", "utf-8")
    return folder


def test_the_tab_of_ten_lines_shows_what_a_node_says(browser: Any, tmp_path: Path) -> None:
    """Its page opens first where it is named, and the other tabs are there too."""
    from std_msgs.msg import Float32

    home = tmp_path / "home"
    home.mkdir()
    with (
        leased_domain() as domain,
        desk(domain, home, "battery", more=written(tmp_path / "more")) as opened,
        Nodes(domain) as nodes,
    ):
        publisher = nodes.node.create_publisher(Float32, "/battery", 10)
        nodes.node.create_timer(0.1, lambda: publisher.publish(Float32(data=12.5)))
        page = browser.new_page()
        page.goto(opened.file.as_uri())
        page.wait_for_url(f"{opened.base}/battery")
        expect(page.get_by_role("heading", name="Battery", level=2)).to_be_visible()
        expect(page.get_by_text("12.5 V")).to_be_visible()
        expect(page.get_by_role("link", name="Topics")).to_be_visible()
        page.close()
        until(lambda: not nodes.listeners("/battery"), "the end of the subscription")
