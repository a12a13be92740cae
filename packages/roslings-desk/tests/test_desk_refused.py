"""Who may not come in: six bad tries and more, against the desk as it runs."""

from __future__ import annotations

import re
import stat
import subprocess
from pathlib import Path
from typing import Any

import httpx
import pytest
from desk_program import Desk, desk
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from ros2_on_pip.domain_lease import leased_domain
from skips import needs

SOCKET = "/_nicegui_ws/socket.io/?EIO=4&transport=websocket"
SPARE_USER = 65534


def entered(opened: Desk) -> httpx.Client:
    """Somebody who has the key, and with it the cookie."""
    client = httpx.Client(base_url=opened.base)
    assert client.get(opened.url).status_code == 200
    assert client.get("/rover").status_code == 200
    return client


def cookie(opened: Desk) -> str:
    """As a browser sends it."""
    return "; ".join(f"{name}={value}" for name, value in entered(opened).cookies.items())


def knocked(opened: Desk, **headers: str) -> int:
    """What a websocket is answered; 101 lets it in."""
    try:
        with connect(
            opened.base.replace("http", "ws") + SOCKET,
            additional_headers=headers,
            origin=None,
            proxy=None,
        ):
            return 101
    except InvalidStatus as refused:
        return int(refused.response.status_code)


def test_the_key_lets_in_by_a_strict_cookie_that_no_script_reads(opened: Desk) -> None:
    """And the page that sets it is kept nowhere."""
    answer = httpx.get(opened.url)
    assert answer.status_code == 200
    said = answer.headers["set-cookie"]
    assert "HttpOnly" in said and "SameSite=Strict" in said
    assert answer.headers["cache-control"] == "no-store"
    assert "key" not in said and re.search(r"key=([\w-]+)", opened.url)[1] not in said  # type: ignore[index]


def test_a_foreign_origin_is_refused(opened: Desk) -> None:
    """Any page of the web may send something here, and the browser says which one did."""
    for origin in ("https://evil.example", "http://127.0.0.1:1", "null", f"{opened.base}.evil"):
        answer = entered(opened).get("/rover", headers={"Origin": origin})
        assert answer.status_code == 403, origin
        assert knocked(opened, Cookie=cookie(opened), Origin=origin) == 403, origin


def test_a_foreign_host_is_refused(opened: Desk) -> None:
    """A name of somebody else's can be made to lead to 127.0.0.1."""
    for host in ("evil.example", "127.0.0.1", "127.0.0.1:1", ""):
        answer = entered(opened).get("/rover", headers={"Host": host})
        assert answer.status_code in (400, 403), host
    assert httpx.get(opened.url, headers={"Host": "evil.example"}).status_code == 403
    assert knocked(opened, Cookie=cookie(opened), Origin=opened.base, Host="evil.example") == 403


def test_who_has_no_key_is_refused_on_each_page(opened: Desk) -> None:
    """And told what to do."""
    polling = SOCKET.replace("websocket", "polling")
    for path in ("/", "/rover", "/enter", "/enter?key=", polling, "/docs", "/nothing"):
        answer = httpx.get(opened.base + path)
        assert answer.status_code == 403, path
        assert "open the file that ./roslings desk has named" in answer.text
    assert httpx.post(opened.url).status_code == 403


@pytest.mark.slow
def test_the_key_of_another_desk_is_refused(opened: Desk, tmp_path: Path) -> None:
    """One that has ended, for example; and its cookie too."""
    with leased_domain() as domain, desk(domain, tmp_path) as other:
        old, pass_of_old = other.url, cookie(other)
    key = old.partition("?")[2]
    assert httpx.get(f"{opened.base}/enter?{key}").status_code == 403
    stolen = pass_of_old.partition("=")[2]
    name = cookie(opened).partition("=")[0]
    for said in (pass_of_old, f"{name}={stolen}", f"{name}=", f"{name}=ü"):
        answer = httpx.get(f"{opened.base}/rover", headers={"Cookie": said.encode()})
        assert answer.status_code == 403, said


def test_nobody_else_reads_the_file_with_the_key(opened: Desk) -> None:
    """Nor its folder; and the key is in no list of processes and in no printed line."""
    assert stat.S_IMODE(opened.file.stat().st_mode) == 0o600
    assert stat.S_IMODE(opened.file.parent.stat().st_mode) == 0o700
    key = re.search(r"key=([\w-]+)", opened.url)[1]  # type: ignore[index]
    assert len(key) >= 43
    assert key not in "\n".join(opened.lines)
    assert key.encode() not in Path(f"/proc/{opened.process.pid}/cmdline").read_bytes()


@needs("root")
def test_another_user_is_refused(opened: Desk) -> None:
    """The user who tries it gets neither the file nor, without it, the page."""
    done = subprocess.run(
        ["/bin/cat", str(opened.file)],
        user=SPARE_USER,
        cwd="/",
        capture_output=True,
        text=True,
        check=False,
        env={"LC_ALL": "C"},
    )
    assert done.stdout == ""
    assert "Permission denied" in done.stderr


def test_a_websocket_alone_is_refused(opened: Desk) -> None:
    """Without the cookie, with a wrong one, without an origin; it is let in with both."""
    own = {"Origin": opened.base}
    assert knocked(opened, **own) == 403
    assert knocked(opened, Cookie="roslings-desk=x", **own) == 403
    assert knocked(opened, Cookie=cookie(opened)) == 403
    assert knocked(opened, Cookie=cookie(opened), **own) == 101


def test_a_page_may_ask_no_other_host(opened: Desk) -> None:
    """The browser itself is told so, whatever a topic's text may hold."""
    rules = entered(opened).get("/rover").headers["content-security-policy"]
    assert "default-src 'self'" in rules
    assert "*" not in rules.partition("frame-ancestors")[0]


def test_it_listens_on_this_computer_only(opened: Desk) -> None:
    """No other address of this machine reaches it."""
    port = int(opened.base.rpartition(":")[2])
    with pytest.raises(httpx.ConnectError):
        httpx.get(f"http://127.0.0.2:{port}/")


@pytest.mark.slow
def test_a_host_that_is_allowed_needs_the_key_all_the_same(tmp_path: Path) -> None:
    """As a proxy of a notebook server or of a container asks for it."""
    with leased_domain() as domain, desk(domain, tmp_path, "--allow-host", "box:8888") as found:
        host: dict[str, Any] = {"headers": {"Host": "box:8888", "Origin": "https://box:8888"}}
        assert httpx.get(f"{found.base}/rover", **host).status_code == 403
        answer = httpx.get(found.url, **host)
        assert answer.status_code == 200
        kept = answer.headers["set-cookie"].partition(";")[0]
        host["headers"]["Cookie"] = kept
        assert httpx.get(f"{found.base}/rover", **host).status_code == 200
        host["headers"]["Host"] = "other:8888"
        assert httpx.get(f"{found.base}/rover", **host).status_code == 403
