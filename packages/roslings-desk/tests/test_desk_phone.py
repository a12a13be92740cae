"""One telephone may drive: its code, its page, and whoever else tries to come in by that way."""

from __future__ import annotations

import re
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import httpx
import numpy as np
import pytest
from desk_program import Desk, Nodes, desk, until
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from ros2_on_pip.domain_lease import leased_domain
from roslings_desk import phone
from roslings_desk.qr_code import BLACK_ON_WHITE, HALVES, qr_lines
from skips import imported

Axe = imported("axe_playwright_python.sync_playwright").Axe
expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
ADDRESS = "127.0.0.2"
"""Another address than the desk's own, on this computer only."""
SOCKET = "/_nicegui_ws/socket.io/?EIO=4&transport=websocket"
MODULE_PX = 6


def scanned(lines: list[str]) -> str:
    """What a telephone reads in the code that these lines show."""
    modules = {letter: pair for pair, letter in HALVES.items()}
    drawn = [line for line in lines if len(line) > 20 and set(line) <= modules.keys()]
    rows = [[modules[letter][half] for letter in line] for line in drawn for half in (0, 1)]
    dark = np.array(rows, dtype=np.uint8).repeat(MODULE_PX, 0).repeat(MODULE_PX, 1)
    # OpenCV's older reader finds nothing in one of a hundred codes.
    found, _, _ = cv2.QRCodeDetectorAruco().detectAndDecode(
        np.pad((1 - dark) * 255, 40, "constant", constant_values=255)
    )
    return str(found)


def test_the_code_is_read_back() -> None:
    """In plain letters; in colours the same, and without blocks where the encoding has none."""
    plain = qr_lines("http://192.168.1.7:4711/enter?key=abc", "utf-8", coloured=False)
    assert scanned(plain) == "http://192.168.1.7:4711/enter?key=abc"
    coloured = qr_lines("http://192.168.1.7:4711/enter?key=abc", "utf-8", coloured=True)
    assert [line.removeprefix(BLACK_ON_WHITE)[:-4] for line in coloured] == plain
    poor = qr_lines("http://192.168.1.7:4711/enter?key=abc", "ascii", coloured=False)
    assert set("".join(poor)) == {"#", " "} and len(poor[0]) == 2 * len(plain[0])


def test_without_a_network_the_next_step_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """The kernel knows no way, and no card has an address."""
    monkeypatch.setattr(phone, "SOMEWHERE", ("255.255.255.255", 9))
    monkeypatch.setattr(phone, "cards", lambda: [])
    with pytest.raises(phone.NoNetwork, match="Join the network of your telephone"):
        phone.own_address()


@pytest.fixture
def shared(tmp_path: Path) -> Iterator[Desk]:
    """A desk for one telephone, that none has used yet."""
    words = ("--phone", "--phone-address", ADDRESS)
    with leased_domain() as domain, desk(domain, tmp_path, *words) as found:
        until(lambda: any("is not encrypted" in line for line in found.lines), "the code")
        yield found


def base(url: str) -> str:
    """Where the telephone comes in."""
    return url.partition("/enter")[0]


def come_in(url: str) -> httpx.Client:
    """Press the button of the first page."""
    client = httpx.Client(base_url=base(url), headers={"Origin": base(url)})
    assert "Drive with this telephone" in client.get(url).text
    answer = client.post("/enter", data={"key": url.partition("key=")[2]})
    assert answer.status_code == 200, answer.text
    return client


def knocked(where: str, **headers: str) -> int:
    """What a websocket is answered; 101 lets it in."""
    try:
        with connect(
            where.replace("http", "ws") + SOCKET,
            additional_headers=headers,
            origin=None,
            proxy=None,
        ):
            return 101
    except InvalidStatus as refused:
        return int(refused.response.status_code)


@pytest.mark.slow
def test_the_code_is_good_for_one_telephone(shared: Desk) -> None:
    """A look does not use it up; the second telephone is refused, and the first may come again."""
    url = scanned(shared.lines)
    assert url.startswith(f"http://{ADDRESS}:")
    assert f"the desk listens at {base(url)[7:]}, where all of your network" in "\n".join(
        shared.lines
    )
    for _ in range(2):
        assert httpx.get(url).status_code == 200
    first = come_in(url)
    assert first.get("/phone").status_code == 200
    until(lambda: any("A telephone has come in, from 127." in line for line in shared.lines), "it")
    second = httpx.Client(base_url=base(url), headers={"Origin": base(url)})
    assert second.get(url).status_code == 403
    refused = second.post("/enter", data={"key": url.partition("key=")[2]})
    assert refused.status_code == 403 and "good for one" in refused.text
    assert second.get("/phone").status_code == 403
    assert first.get(url).status_code == 200


@pytest.mark.slow
def test_bad_tries_are_refused(shared: Desk) -> None:
    """Foreign Host and Origin, no key, another desk's key, a websocket alone, and other pages."""
    url = scanned(shared.lines)
    key = {"key": url.partition("key=")[2]}
    for headers in (
        {"Host": "evil.example"},
        {"Host": base(shared.url)[7:]},
        {"Origin": "https://evil.example"},
        {"Origin": "null"},
    ):
        assert httpx.get(url, headers=headers).status_code == 403
        assert httpx.post(f"{base(url)}/enter", data=key, headers=headers).status_code == 403
    for path in ("/", "/enter", "/enter?key=", "/enter?key=x", "/phone", "/rover", "/docs"):
        assert httpx.get(base(url) + path).status_code == 403, path
    for body in (b"", b"key=", b"key=x", b"key=" + b"x" * 10_000, b"\xff\xfe"):
        assert httpx.post(f"{base(url)}/enter", content=body).status_code == 403
    assert httpx.put(url).status_code == 403
    own_key = re.sub(r".*key=([\w-]+).*", r"\1", shared.url)
    assert httpx.get(f"{base(url)}/enter?key={own_key}").status_code == 403
    client = come_in(url)
    (pass_,) = (f"{name}={value}" for name, value in client.cookies.items())
    for path in ("/", "/rover", "/topics", "/docs", "/phones", "/phone/topics", "/_nicegui"):
        assert client.get(path).status_code == 403, path
    assert knocked(base(url), Origin=base(url)) == 403
    assert knocked(base(url), Cookie=pass_) == 403
    assert knocked(base(url), Cookie=pass_, Origin=shared.base) == 403
    assert knocked(base(url), Cookie=pass_, Origin=base(url)) == 101


@pytest.mark.slow
def test_it_opens_nothing_of_the_desk_of_this_computer(shared: Desk) -> None:
    """The telephone's key and cookie are of no use there; and the desk's own door is elsewhere."""
    url = scanned(shared.lines)
    client = come_in(url)
    key = url.partition("?")[2]
    assert httpx.get(f"{shared.base}/enter?{key}").status_code == 403
    pairs = "; ".join(f"{name}={value}" for name, value in client.cookies.items())
    assert httpx.get(f"{shared.base}/rover", headers={"Cookie": pairs}).status_code == 403
    with pytest.raises(httpx.ConnectError):
        httpx.get(f"http://{ADDRESS}:{shared.base.rpartition(':')[2]}/")


@pytest.mark.slow
def test_it_is_off_when_the_desk_ends(shared: Desk, tmp_path: Path) -> None:
    """Nobody listens there any more, and the old key opens no other desk."""
    url = scanned(shared.lines)
    assert shared.interrupt() == 0
    host, port = base(url)[7:].split(":")
    with socket.socket() as tried:
        assert tried.connect_ex((host, int(port))) != 0
    words = ("--phone", "--phone-address", ADDRESS)
    with leased_domain() as domain, desk(domain, tmp_path, *words) as other:
        until(lambda: any("is not encrypted" in line for line in other.lines), "the code")
        there = base(scanned(other.lines))
        assert httpx.get(f"{there}/enter?{url.partition('?')[2]}").status_code == 403


@pytest.mark.slow
def test_a_telephone_drives_and_stops(browser: Any, shared: Desk) -> None:
    """A small screen: no way to another tab; a press drives, Stop and its end stop."""
    from geometry_msgs.msg import Twist

    with Nodes(shared.domain) as nodes:
        heard = nodes.hear(Twist, "/cmd_vel")
        page = browser.new_page(viewport={"width": 390, "height": 800})
        page.goto(scanned(shared.lines))
        assert Axe().run(page).response["violations"] == []
        page.get_by_role("button", name="Drive with this telephone").click()
        page.wait_for_url("**/phone")
        expect(page.get_by_role("heading", name="Rover", level=2)).to_be_visible()
        assert page.get_by_role("navigation").count() == 0
        assert page.get_by_role("button", name="Save the last").count() == 0
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        assert Axe().run(page).response["violations"] == []
        expect(page.locator("#state")).not_to_contain_text("nothing drives")
        page.get_by_role("button", name="Ahead").click()
        until(lambda: any(each.linear.x > 0 for each in heard), "a drive")
        page.get_by_role("button", name="Stop", exact=True).click()
        until(lambda: heard[-1].linear.x == 0, "the stop")
        heard.clear()
        page.get_by_role("button", name="Ahead").click()
        until(lambda: any(each.linear.x > 0 for each in heard), "another drive")
        page.close()
        until(lambda: heard[-1].linear.x == 0, "the stop when it is gone")


@pytest.mark.slow
def test_an_address_of_another_computer_is_told(tmp_path: Path) -> None:
    """With the next step."""
    words = ("--phone", "--phone-address", "203.0.113.9")
    with leased_domain() as domain, desk(domain, tmp_path, *words) as found:
        assert found.process.wait(60) == 2
    assert "cannot listen on the address '203.0.113.9'" in "\n".join(found.lines)
