"""A student at a JupyterHub, as a browser asks it: cookies, pages, two kinds of websocket."""

from __future__ import annotations

import json
import re
import time
import urllib.request
from functools import partial
from http.client import HTTPResponse
from http.cookiejar import CookieJar
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.parse import urlencode
from uuid import uuid4

from tornado.httpclient import HTTPRequest
from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClientConnection, websocket_connect

HUB = "127.0.0.1:8000"
PATIENCE_S = 300.0
"""For everything that a computer with other work may take; nothing waits for it to be over."""
LOOK_EVERY_S = 0.5
SEEN = re.compile(r"\x1b\[[0-9;?]*[a-zA-Z]|\x1b\][^\x07]*\x07|\r")
"""What colours a terminal, and moves its cursor."""


class NotThere(Exception):
    """It did not come in `PATIENCE_S`."""


class Student:
    """One browser."""

    def __init__(self, name: str, password: str) -> None:
        self.name, self._password = name, password
        self._cookies = CookieJar()
        keep = urllib.request.HTTPCookieProcessor(self._cookies)
        self._browser = urllib.request.build_opener(urllib.request.ProxyHandler({}), keep)

    def log_in(self) -> None:
        """By the form, and wait for one's own server. Raises NotThere."""
        form = self._until("/hub/login", lambda page: 'name="_xsrf"' in page)
        found = re.search(r'name="_xsrf" value="([^"]*)"', form)
        words = {"username": self.name, "password": self._password, "_xsrf": found and found[1]}
        self._ask("/hub/login", urlencode(words).encode())
        self._until("/hub/spawn", lambda page: "jupyter-config-data" in page)

    def terminal(self) -> Terminal:
        """A new one."""
        name = json.loads(self._make("terminals"))["name"]
        return Terminal(self._socket(f"terminals/websocket/{name}"))

    def run(self, code: str) -> str:
        """What a new notebook's first cell prints. Raises NotThere."""
        number = json.loads(self._make("kernels"))["id"]
        return printed(self._socket(f"api/kernels/{number}/channels"), code)

    def _make(self, what: str) -> str:
        return self._ask(f"{self._own}/api/{what}", b"{}")

    @property
    def _own(self) -> str:
        return f"/user/{self.name}"

    def _until(self, path: str, is_there: Any) -> str:
        end_s = time.monotonic() + PATIENCE_S
        page = ""
        while time.monotonic() < end_s:
            try:
                if is_there(page := self._ask(path)):
                    return page
            except (HTTPError, URLError) as error:
                page = str(error)
            time.sleep(LOOK_EVERY_S)
        raise NotThere(f"{path}: {page[-2000:]}")

    def _ask(self, path: str, body: bytes | None = None) -> str:
        headers = {"X-XSRFToken": self._token()} if body == b"{}" else {}
        request = urllib.request.Request(f"http://{HUB}{path}", body, headers)
        answer: HTTPResponse
        with self._browser.open(request, timeout=PATIENCE_S) as answer:
            return answer.read().decode()

    def _token(self) -> str:
        """A page's own cookie, said again: a page of somebody else could not read it."""
        return next(
            str(each.value)
            for each in self._cookies
            if each.name == "_xsrf" and each.path.startswith(self._own)
        )

    def _socket(self, path: str) -> WebSocketClientConnection:
        request = urllib.request.Request(f"http://{HUB}{self._own}/{path}")
        self._cookies.add_cookie_header(request)
        headers = {"Cookie": str(request.get_header("Cookie")), "Origin": f"http://{HUB}"}
        asked = HTTPRequest(f"ws://{HUB}{self._own}/{path}", headers=headers)
        return IOLoop.current().run_sync(partial(websocket_connect, asked), PATIENCE_S)


def heard(socket: WebSocketClientConnection) -> Any:
    """The next message. Raises TimeoutError."""
    return json.loads(str(IOLoop.current().run_sync(socket.read_message, PATIENCE_S)))


class Terminal:
    """A shell in the browser."""

    def __init__(self, socket: WebSocketClientConnection) -> None:
        self._socket = socket
        self._lines = 0
        self._say("set_size", 50, 400)

    def type(self, line: str, until: str = "") -> str:
        """Type a line and Enter; what is seen until the shell waits again, or until some words."""
        self._lines += 1
        mark = "" if until else f'; echo "end" "of {self._lines}"'
        self._say("stdin", f"{line}{mark}\r")
        return self._read(until or f"end of {self._lines}")

    def _read(self, until: str) -> str:
        text = ""
        while until not in (seen := SEEN.sub("", text)):
            try:
                kind, *content = heard(self._socket)
            except TimeoutError:
                raise NotThere(f"{until!r} after: {seen[-2000:]!r}") from None
            text += content[0] if kind == "stdout" else ""
        return seen

    def _say(self, *words: Any) -> None:
        self._socket.write_message(json.dumps(words))


def printed(socket: WebSocketClientConnection, code: str) -> str:
    """What a kernel prints for this code, errors too."""
    header = {
        "msg_id": uuid4().hex,
        "session": uuid4().hex,
        "msg_type": "execute_request",
        "username": "",
        "version": "5.3",
    }
    content = {"code": code, "silent": False, "store_history": True, "stop_on_error": True}
    socket.write_message(
        json.dumps(
            {
                "header": header,
                "parent_header": {},
                "metadata": {},
                "content": content,
                "channel": "shell",
                "buffers": [],
            }
        )
    )
    text = ""
    while True:
        message = heard(socket)
        if message["parent_header"].get("msg_id") != header["msg_id"]:
            continue
        told = message["content"]
        text += told.get("text", "") + "\n".join(told.get("traceback", ()))
        if message["msg_type"] == "status" and told["execution_state"] == "idle":
            return text
