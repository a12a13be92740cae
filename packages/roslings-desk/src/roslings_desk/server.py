"""Serves the desk on 127.0.0.1 until Ctrl-C; where that is asked for, also for one telephone."""

from __future__ import annotations

import os
import socket
import sys
import tempfile
import webbrowser
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ros2_on_pip.problem import CommandProblem
from roslings_desk.bag_player import BagPlayer, playing
from roslings_desk.door import door
from roslings_desk.ending import SignalHandler, ending
from roslings_desk.guard import ENTRANCE, App, Guard
from roslings_desk.hub import Hub
from roslings_desk.phone import Doors, PhoneGuard, listening_for_phone, own_address
from roslings_desk.qr_code import qr_lines
from roslings_desk.shown import TAKE_WORDS

HOST = "127.0.0.1"
FIRST_TAB = "rover"
LEAVES_WITHIN_S = 1


class DeskPortTaken(CommandProblem):
    """Something else listens there."""

    def __init__(self, port: int, why: str) -> None:
        super().__init__(
            f"Port {port} of {HOST} cannot be had: {why}. Leave --port away: any free one is taken."
        )


class NoSuchDeskTab(CommandProblem):
    """The desk has no tab of this name."""

    def __init__(self, name: str, there: Sequence[str]) -> None:
        super().__init__(f"The desk has no tab '{name}'. It has: {', '.join(there)}")


class NoWords(CommandProblem):
    """The tab takes no words."""

    def __init__(self, tab: str, words: Sequence[str]) -> None:
        super().__init__(
            f"The tab '{tab}' takes no words, so '{' '.join(words)}' is left over."
            f" These take some: {', '.join(TAKE_WORDS)}"
        )


@dataclass(frozen=True)
class DeskOptions:
    """How the desk is to be opened."""

    tab: str = FIRST_TAB
    port: int = 0
    """0: any that is free."""
    browser: bool = True
    allowed: Sequence[str] = ()
    """Hosts by which a proxy or a container reaches it, as a browser names them: `host:port`."""
    shown: Sequence[str] = ()
    """What the tab shows at once: a topic, a node, a topic with a field."""
    phone: bool = False
    """One telephone of the network may drive."""
    phone_address: str = ""
    """Of this computer, for the telephone; empty: the one of its network."""
    hidden: bool = False
    """Its node has a hidden name, so the lists and graphs of a lesson are as without a desk."""
    bag: Path | None = None
    """It is played for the pages, in place of what runs on this computer."""


@dataclass(frozen=True)
class Sockets:
    """Where it listens: on this computer, and for a telephone where that is wanted."""

    own: socket.socket
    phone: socket.socket | None


def run(wish: DeskOptions) -> None:
    """Serve until Ctrl-C.

    Raises DeskPortTaken, NoSuchDeskTab, NoWords, NoNetwork, NotOurAddress, and what DirectNode and
    BagPlayer raise.
    """
    from roslings_desk.tab import tabs

    if wish.tab not in (there := tabs()):
        raise NoSuchDeskTab(wish.tab, list(there))
    if wish.shown and wish.tab not in TAKE_WORDS:
        raise NoWords(wish.tab, wish.shown)
    bag: AbstractContextManager[BagPlayer | None]
    bag = playing(wish.bag) if wish.bag else nullcontext()
    with (
        ending() as ends,
        _own_storage(),
        _sockets(wish) as sockets,
        bag as player,
        Hub(wish.hidden) as hub,
    ):
        _serve(wish, sockets, hub, player, ends)


@contextmanager
def _own_storage() -> Iterator[None]:
    """NiceGUI would keep its notes in the folder in which the command was typed."""
    with tempfile.TemporaryDirectory(prefix="roslings-desk-") as folder:
        os.environ["NICEGUI_STORAGE_PATH"] = folder
        yield


@contextmanager
def _sockets(wish: DeskOptions) -> Iterator[Sockets]:
    with _listening(wish.port) as own:
        if not wish.phone:
            yield Sockets(own, None)
            return
        with listening_for_phone(wish.phone_address or own_address()) as phone:
            yield Sockets(own, phone)


@contextmanager
def _listening(port: int) -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((HOST, port))
            listener.listen()  # who comes before the pages are ready waits
        except (OSError, OverflowError) as error:
            raise DeskPortTaken(port, getattr(error, "strerror", None) or str(error)) from error
        yield listener


def _serve(
    wish: DeskOptions, sockets: Sockets, hub: Hub, bag: BagPlayer | None, ends: SignalHandler
) -> None:
    import uvicorn

    from roslings_desk.application import application

    port = sockets.own.getsockname()[1]
    app = application(hub, bag, {wish.tab: wish.shown}, phone=sockets.phone is not None)
    guard = Guard(app, port, wish.allowed)
    phone = _phone_guard(app, sockets.phone)
    config = uvicorn.Config(
        Doors(guard, phone) if phone else guard,
        log_level="warning",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=LEAVES_WITHIN_S,
    )
    with door(f"http://{HOST}:{port}{ENTRANCE}?key={guard.key}&tab={wish.tab}") as file:
        server = uvicorn.Server(config)
        # Its own handlers come late, raise when they go, and at the second signal stop nothing.
        server.capture_signals = nullcontext  # type: ignore[assignment, method-assign]
        ends.asks(partial(setattr, server, "should_exit", True))
        _tell(wish, file)
        if phone:
            _tell_of_phone(phone)
        server.run(sockets=list(filter(None, (sockets.own, sockets.phone))))
    with suppress(OSError):  # its terminal may be gone
        print("\nThe desk is closed.", flush=True)


def _phone_guard(app: App, listener: socket.socket | None) -> PhoneGuard | None:
    if listener is None:
        return None
    address, port = listener.getsockname()
    return PhoneGuard(app, address, port, _say_phone)


def _tell(wish: DeskOptions, file: Path) -> None:
    print(f"The desk is open. Its page, for a browser of yours: {file.as_uri()}")
    print("Nobody else can read that file: a key is in it. Ctrl-C here closes the desk.")
    if wish.allowed:
        print(f"From {', '.join(wish.allowed)} take the address in that file, with that host.")
    sys.stdout.flush()
    if wish.browser:
        webbrowser.open(file.as_uri())


def _tell_of_phone(phone: PhoneGuard) -> None:
    """The code, and that the network can now reach it."""
    print("Scan this with one telephone of your network. It then drives the rover, until you close")
    print("the desk. The code is good for the first one that comes:")
    for line in qr_lines(phone.url, sys.stdout.encoding, sys.stdout.isatty()):
        print(line)
    print(f"For it the desk listens at {phone.host}, where all of your network reach it. What it")
    print("says is not encrypted: use it only in a network that you trust.", flush=True)


def _say_phone(address: str) -> None:
    with suppress(OSError):
        print(f"A telephone has come in, from {address}. No other one can.", flush=True)
