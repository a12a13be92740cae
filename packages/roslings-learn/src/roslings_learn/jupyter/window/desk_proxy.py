"""The desk behind the server's own address: whoever may open this JupyterLab sees it.

Jupyter's login, and its look at Host and Origin, stand before it, as before terminals and kernels.
The desk's own key stays between this server and the desk, and nothing of Jupyter's cookies goes
there. So the page needs no other port, also in a container and behind JupyterHub.
"""

from __future__ import annotations

import asyncio
import html
from typing import Any

from jupyter_server.auth.decorator import ws_authenticated
from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.base.websocket import WebSocketMixin
from jupyter_server.utils import url_path_join
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.web import authenticated
from tornado.websocket import WebSocketClientConnection, WebSocketHandler, websocket_connect

from ros2_on_pip.surroundings import domain_id
from roslings_learn.jupyter.window.desks import Desks, NoDesk, OpenDesk

ROOM = "roslings/desk"
HERE = "here"
"""In an address: the ROS domain of the window."""
WHERE = rf"({HERE}|\d{{1,3}})"
HANDED_ON = ("Content-Type", "Content-Security-Policy", "Cache-Control", "Etag", "Last-Modified")
ASKED_ON = ("Accept", "If-None-Match", "If-Modified-Since")
LARGEST_MESSAGE_B = 32_000_000
"""A picture, for example."""
BAD_GATEWAY = 502
PAGE = '<!doctype html><html lang="en"><title>roslings desk</title><main><pre>{}</pre></main>'


class DeskPages(JupyterHandler):
    """Its pages, and what belongs to them."""

    def initialize(self, desks: Desks) -> None:
        """Called by Tornado."""
        self._desks = desks

    @authenticated
    async def get(self, where: str, path: str) -> None:
        """Ask the desk, and answer as it does."""
        try:
            desk = await self._desks.of(_domain(where))
        except NoDesk as error:
            self.set_status(BAD_GATEWAY)
            self.finish(PAGE.format(html.escape(str(error))))
            return
        said = self.request.headers
        asked = {name: said[name] for name in ASKED_ON if name in said}
        prefix = url_path_join(self.base_url, ROOM, where)
        request = HTTPRequest(
            _address(desk, path, self.request.query),
            headers={**asked, "Cookie": desk.cookie, "X-Forwarded-Prefix": prefix},
            follow_redirects=False,
            decompress_response=False,
        )
        answer = await AsyncHTTPClient().fetch(request, raise_error=False)
        self.set_status(answer.code)
        for name in HANDED_ON:
            if name in answer.headers:
                self.set_header(name, answer.headers[name])
        self.finish(answer.body)


class DeskSocket(WebSocketMixin, WebSocketHandler, JupyterHandler):
    """The websocket of a page: each message goes on to the other side, one after the other."""

    _upstream: WebSocketClientConnection | None = None

    def initialize(self, desks: Desks) -> None:
        """Called by Tornado."""
        self._desks = desks

    @ws_authenticated
    async def get(self, *words: str) -> None:
        """Shake hands."""
        await super().get(*words)

    async def open(self, where: str, path: str) -> None:
        """Join the two."""
        super().open(where, path)
        try:
            desk = await self._desks.of(_domain(where))
        except NoDesk:
            self.close()
            return
        address = _address(desk, path, self.request.query).replace("http", "ws", 1)
        headers = {"Cookie": desk.cookie, "Origin": desk.base}
        self._upstream = await websocket_connect(
            HTTPRequest(address, headers=headers), max_message_size=LARGEST_MESSAGE_B
        )
        self._reading = asyncio.ensure_future(self._hand_down(self._upstream))

    async def on_message(self, message: Any) -> None:
        """From the browser to the desk."""
        if self._upstream is not None:
            await self._upstream.write_message(message, binary=isinstance(message, bytes))

    async def _hand_down(self, upstream: WebSocketClientConnection) -> None:
        while (message := await upstream.read_message()) is not None:
            await self.write_message(message, binary=isinstance(message, bytes))
        self.close()

    def on_close(self) -> None:
        """The page is gone: the desk then stops what the page drove."""
        if self._upstream is not None:
            self._reading.cancel()
            self._upstream.close()


def _domain(where: str) -> int:
    return domain_id() if where == HERE else int(where)


def _address(desk: OpenDesk, path: str, query: str) -> str:
    return f"{desk.base}/{path}" + (f"?{query}" if query else "")


def handlers(base_url: str, desks: Desks) -> list[tuple[str, type, dict[str, Desks]]]:
    """What the server answers by them."""
    room = url_path_join(base_url, ROOM, WHERE)
    given = {"desks": desks}
    return [
        (rf"{room}/(_nicegui_ws/.*)", DeskSocket, given),
        (rf"{room}/(.*)", DeskPages, given),
    ]
