"""One telephone of the same network may drive: the tab Rover, and nothing else of the desk.

It comes in by a key that stands in a QR code in the terminal. The key is good for one telephone:
whoever comes first, by a button on the first page. So a program which only looks at the address
does not use the key up. All of it ends with the desk.
"""

from __future__ import annotations

import html
import secrets
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from urllib.parse import parse_qs

from ros2_on_pip.network_cards import cards
from ros2_on_pip.problem import CommandProblem
from roslings_desk.guard import (
    ENTRANCE,
    App,
    Receive,
    Scope,
    Send,
    answer_page,
    comes_from,
    has_pass,
    let_in,
    refuse,
    same,
    with_headers,
)

PAGE = "/phone"
OPEN_TO_IT = ("/_nicegui/", "/_nicegui_ws/")
"""What the page itself fetches; nothing of another tab is there."""
SOMEWHERE = ("192.0.2.1", 9)
"""An address for documentation (RFC 5737). Nothing is sent there: the kernel only says from which
of our own addresses it would go."""
LONGEST_BODY_B = 2_000

REFUSED = (
    "403: this desk does not open here.\n"
    "Next: scan the code in the terminal of ./roslings desk --phone. It is good for one\n"
    "telephone. For another one, or where it is used up: end the desk, and start it anew.\n"
)
QUESTION = (
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>roslings desk</title>'
    '<meta name="viewport" content="width=device-width, initial-scale=1">'
    "<style>body{{font:1.2rem/1.5 system-ui;margin:1.5rem}}button{{font:inherit;padding:1rem}}"
    "</style><main><h1>roslings desk</h1><p>This telephone will drive a robot. Look at it while it"
    ' drives.</p><form method="post" action=".{path}">'
    '<input type="hidden" name="key" value="{key}">'
    "<button>Drive with this telephone</button></form></main>"
)


class NoNetwork(CommandProblem):
    """No telephone can reach this computer."""

    def __init__(self) -> None:
        super().__init__(
            "This computer is in no network, so no telephone can reach it."
            " Join the network of your telephone, then type it again."
        )


class NotOurAddress(CommandProblem):
    """It cannot be listened on."""

    def __init__(self, address: str, why: str) -> None:
        super().__init__(
            f"The desk cannot listen on the address '{address}': {why}."
            " Leave --phone-address away, or give an address of this computer: hostname -I"
        )


def own_address() -> str:
    """The address by which others of the network reach this computer. Raises NoNetwork."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect(SOMEWHERE)
            return str(asked.getsockname()[0])
        except OSError:
            pass
    found = (address for card in cards() if "loopback" not in card.flags for address in card.inet4)
    if address := next(found, ""):
        return address
    raise NoNetwork


@contextmanager
def listening_for_phone(address: str) -> Iterator[socket.socket]:
    """A socket on this address, at any free port. Raises NotOurAddress."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listener:
        try:
            listener.bind((address, 0))
            listener.listen()
        except OSError as error:
            raise NotOurAddress(address, error.strerror or str(error)) from error
        yield listener


@dataclass
class PhoneGuard:
    """An ASGI application that lets pass to `app` what one telephone may ask for."""

    app: App
    address: str
    port: int
    tell: Callable[[str], None]
    """Is told the address of the telephone that came in."""
    key: str = field(default_factory=lambda: secrets.token_urlsafe(24), repr=False)
    is_used: bool = False
    _pass: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)

    @property
    def url(self) -> str:
        """What stands in the QR code."""
        return f"http://{self.host}{ENTRANCE}?key={self.key}"

    @property
    def host(self) -> str:
        """As the telephone's browser names it."""
        return f"{self.address}:{self.port}"

    @property
    def cookie(self) -> str:
        """Another one than that of the desk's own pages."""
        return f"roslings-phone-{self.port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let pass, let in by the key, or refuse."""
        if not comes_from(scope, [self.host], [f"http://{self.host}"]):
            await refuse(scope, send, REFUSED)
        elif scope["type"] == "http" and scope["path"] == ENTRANCE:
            await self._at_the_entrance(scope, receive, send)
        elif has_pass(scope, self.cookie, self._pass) and self._is_open(scope["path"]):
            await self.app(scope, receive, with_headers(send, [self.host]))
        else:
            await refuse(scope, send, REFUSED)

    def _is_open(self, path: str) -> bool:
        return path == PAGE or path.startswith(OPEN_TO_IT)

    async def _at_the_entrance(self, scope: Scope, receive: Receive, send: Send) -> None:
        """The key in an address shows a button; the key that the button sends is used up."""
        asks = {"GET": scope["query_string"], "POST": b""}
        if scope["method"] == "POST":
            asks["POST"] = await _body(receive)
        key = _key_in(asks.get(scope["method"], b""))
        is_known = has_pass(scope, self.cookie, self._pass)
        if not same(key, self.key) or (self.is_used and not is_known):
            await refuse(scope, send, REFUSED)
        elif scope["method"] == "GET" and not is_known:
            await answer_page(send, QUESTION.format(path=ENTRANCE, key=html.escape(key)))
        else:
            await self._come_in(scope, send)

    async def _come_in(self, scope: Scope, send: Send) -> None:
        if not self.is_used:
            self.is_used = True
            self.tell(str((scope.get("client") or ("somewhere",))[0]))
        await let_in(send, PAGE, self.cookie, self._pass)


@dataclass(frozen=True)
class Doors:
    """An ASGI application: who comes by the telephone's socket meets the telephone's guard."""

    own: App
    phone: PhoneGuard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """By the socket that the request came in by."""
        here = tuple(scope.get("server") or ())
        door = self.phone if here == (self.phone.address, self.phone.port) else self.own
        await door(scope, receive, send)


async def _body(receive: Receive) -> bytes:
    """What was sent along; nothing where it is more than a key."""
    found = b""
    while True:
        message = await receive()
        found += bytes(message.get("body", b""))
        if len(found) > LONGEST_BODY_B:
            return b""
        if not message.get("more_body", False):
            return found


def _key_in(words: bytes) -> str:
    return parse_qs(words.decode("latin-1")).get("key", [""])[0]
