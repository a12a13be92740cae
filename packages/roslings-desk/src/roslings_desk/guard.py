"""Who may speak with the desk: a browser of this computer's user, on the desk's own page.

A robot hangs on it, and any web page can send requests to 127.0.0.1. So each request and each
websocket is looked at before NiceGUI sees it. The guard looks at its Host (a foreign name can be
made to lead here), its Origin (the page that sends it), and its key. The key comes once, in an
address that only this user can read. From then on a cookie stands for it, which browsers send from
our own page only.
"""

from __future__ import annotations

import hmac
import secrets
from collections.abc import Awaitable, Callable, MutableMapping, Sequence
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Scope]]
Send = Callable[[Scope], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]
Header = tuple[bytes, bytes]

ENTRANCE = "/enter"
POLICY_VIOLATED = 1008
"""RFC 6455, section 7.4.1; before the handshake a server turns it into 403."""

REFUSED = (
    "403: the desk does not open here.\n"
    "Next: open the file that ./roslings desk has named in its terminal. It leads to this page\n"
    "with a key. The key of a desk that has ended opens nothing any more.\n"
)
ENTERED = (
    '<!doctype html><html lang="en"><title>roslings desk</title>'
    '<meta http-equiv="refresh" content="0; url=.{path}">'
    '<p><a href=".{path}">Open the desk</a></p>'
)
"""A page of ours leads on: a cookie that is strict is not sent where a file led to."""

ALWAYS: tuple[Header, ...] = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)


@dataclass(frozen=True)
class Guard:
    """An ASGI application that lets pass to `app` what may come in.

    `port` is the desk's; `allowed` are names of hosts by which a proxy or a container reaches it.
    """

    app: App
    port: int
    allowed: Sequence[str] = ()
    key: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)
    _pass: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)

    @property
    def cookie(self) -> str:
        """Cookies do not part by port: each desk has a name of its own."""
        return f"roslings-desk-{self.port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let pass, let in by the key, or refuse."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
        elif not comes_from(scope, self._hosts(), self._origins()):
            await refuse(scope, send)
        elif scope["type"] == "http" and scope["path"] == ENTRANCE:
            await self._let_in(scope, send)
        elif not has_pass(scope, self.cookie, self._pass):
            await refuse(scope, send)
        else:
            await self.app(scope, receive, with_headers(send, self._hosts()))

    def _hosts(self) -> list[str]:
        return [f"127.0.0.1:{self.port}", f"localhost:{self.port}", *self.allowed]

    def _origins(self) -> list[str]:
        own = [f"http://{host}" for host in self._hosts()]
        return [*own, *(f"https://{host}" for host in self.allowed)]

    async def _let_in(self, scope: Scope, send: Send) -> None:
        asked = parse_qs(scope["query_string"].decode("latin-1"))
        if scope["method"] != "GET" or not same(asked.get("key", [""])[0], self.key):
            await refuse(scope, send)
            return
        tab = asked.get("tab", [""])[0]
        path = f"/{tab}" if tab.isascii() and tab.isidentifier() else "/"
        await let_in(send, path, self.cookie, self._pass)


# --- what each guard does ----------------------------------------------------------------------


def comes_from(scope: Scope, own_hosts: Sequence[str], own_origins: Sequence[str]) -> bool:
    """One Host, and it is ours; an Origin, where there is one, is ours too."""
    hosts, origins = _values(scope, b"host"), _values(scope, b"origin")
    if len(hosts) != 1 or hosts[0] not in own_hosts:
        return False
    if not origins:  # a browser always names it to a websocket
        return bool(scope["type"] == "http")
    return len(origins) == 1 and origins[0] in own_origins


def has_pass(scope: Scope, cookie: str, right: str) -> bool:
    """Whether it carries the cookie with the right value."""
    return same(_cookies(scope).get(cookie, ""), right)


async def let_in(send: Send, path: str, cookie: str, its_value: str) -> None:
    """Set the cookie, and lead on to a page."""
    said = f"{cookie}={its_value}; Path=/; HttpOnly; SameSite=Strict"
    await answer_page(send, ENTERED.format(path=path), [(b"set-cookie", said.encode())])


async def answer_page(send: Send, page: str, headers: Sequence[Header] = ()) -> None:
    """A page that is kept nowhere."""
    lines = [*headers, (b"cache-control", b"no-store")]
    await _answer(send, 200, b"text/html; charset=utf-8", page, lines)


def with_headers(send: Send, hosts: Sequence[str]) -> Send:
    """What sends the same, with what a browser is told of each page."""

    async def sending(message: Scope) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message["headers"], *ALWAYS, _policy(hosts)]
        await send(message)

    return sending


def _policy(hosts: Sequence[str]) -> Header:
    """No request to another host, whatever the page holds. Vue makes its templates by eval."""
    sockets = " ".join(f"{kind}://{host}" for host in hosts for kind in ("ws", "wss"))
    rules = (
        "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:",
        f"connect-src 'self' {sockets}",
        "form-action 'none'",
        "frame-ancestors 'self' http://127.0.0.1:* http://localhost:*",
    )
    return (b"content-security-policy", "; ".join(rules).encode())


def _values(scope: Scope, name: bytes) -> list[str]:
    return [value.decode("latin-1") for key, value in scope["headers"] if key.lower() == name]


def _cookies(scope: Scope) -> dict[str, str]:
    try:
        read = SimpleCookie("; ".join(_values(scope, b"cookie")))
    except CookieError:
        return {}
    return {name: morsel.value for name, morsel in read.items()}


def same(one: str, other: str) -> bool:
    """In a time that does not tell how much of it is right."""
    return hmac.compare_digest(one.encode("utf-8", "replace"), other.encode())


async def refuse(scope: Scope, send: Send, why: str = REFUSED) -> None:
    """403: uvicorn makes that of a websocket that is closed before it was accepted, too."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": POLICY_VIOLATED})
    else:
        await _answer(send, 403, b"text/plain; charset=utf-8", why, [])


async def _answer(
    send: Send, status: int, kind: bytes, text: str, headers: Sequence[Header]
) -> None:
    body = text.encode()
    lines = [(b"content-type", kind), (b"content-length", b"%d" % len(body)), *headers, *ALWAYS]
    await send({"type": "http.response.start", "status": status, "headers": lines})
    await send({"type": "http.response.body", "body": body})
