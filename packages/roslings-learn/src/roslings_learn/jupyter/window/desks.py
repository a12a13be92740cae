"""The desks of a window: one for each ROS domain that is looked at, started when it first is."""

from __future__ import annotations

import asyncio
import os
import re
import sys
from asyncio.subprocess import DEVNULL, PIPE, STDOUT, Process
from collections import defaultdict
from dataclasses import dataclass, field
from html import unescape
from http.cookies import SimpleCookie
from importlib.util import find_spec
from pathlib import Path

from tornado.httpclient import AsyncHTTPClient

from ros2_on_pip import mortal
from ros2_on_pip.errors import RoslingsError
from roslings_learn.start import START

LAUNCH = Path(mortal.__file__)
DOOR = re.compile(r"file://(\S+\.html)")
ADDRESS = re.compile(r'href="([^"]+)"')


class NoDesk(RoslingsError):
    """It did not open."""

    def __init__(self, why: str) -> None:
        super().__init__(f"The desk did not open. {why}")


@dataclass(frozen=True)
class OpenDesk:
    """One that runs: where it listens, and the cookie by which it lets us in."""

    process: Process
    base: str
    cookie: str

    @property
    def runs(self) -> bool:
        """It has not ended."""
        return self.process.returncode is None


@dataclass
class Desks:
    """Those of this server. They end with it, however it ends."""

    folder: Path
    """Where they write what somebody saves."""
    _opened: dict[int, OpenDesk] = field(default_factory=dict)
    _locks: defaultdict[int, asyncio.Lock] = field(
        default_factory=lambda: defaultdict(asyncio.Lock)
    )

    async def of(self, domain: int) -> OpenDesk:
        """The desk of this domain. Raises NoDesk."""
        async with self._locks[domain]:
            found = self._opened.get(domain)
            if found is None or not found.runs:
                found = self._opened[domain] = await _opened(domain, self.folder)
            return found


async def _opened(domain: int, folder: Path) -> OpenDesk:
    if find_spec("nicegui") is None:
        raise NoDesk("It is not installed yet. In a terminal, type: ./roslings ready desk")
    process = await asyncio.create_subprocess_exec(
        sys.executable,
        "-I",
        "-S",
        str(LAUNCH),
        str(os.getpid()),
        sys.executable,
        str(START),
        "desk",
        "--no-browser",
        "--hidden-node",
        env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
        cwd=folder,
        start_new_session=True,
        stdin=DEVNULL,
        stdout=PIPE,
        stderr=STDOUT,
    )
    address = await _address_in(await _door(process))
    base = address.partition("/enter")[0]
    return OpenDesk(process, base, await _cookie(address))


async def _door(process: Process) -> Path:
    """The file that the desk names: it holds the address with the key."""
    assert process.stdout  # it was asked for
    said = ""
    while line := (await process.stdout.readline()).decode("utf-8", "replace"):
        said += line
        if found := DOOR.search(line):
            return Path(found[1])
    await process.wait()
    raise NoDesk(f"It said:\n{said.strip()}")


async def _address_in(file: Path) -> str:
    found = ADDRESS.search(file.read_text("utf-8"))
    if found is None:
        raise NoDesk(f"No address stands in {file}.")
    return unescape(found[1])


async def _cookie(address: str) -> str:
    """What a browser would keep after it came in by the key."""
    answer = await AsyncHTTPClient().fetch(address)
    read = SimpleCookie("; ".join(answer.headers.get_list("Set-Cookie")))
    return "; ".join(f"{name}={morsel.value}" for name, morsel in read.items())
