"""A package index that can be made to break in the middle of a file."""

from __future__ import annotations

import hashlib
import re
import threading
import zipfile
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path


@dataclass
class Traffic:
    """What was asked for, and what is to go wrong."""

    asked: list[tuple[str, int]] = field(default_factory=list)  # file, first byte
    cuts: dict[str, int] = field(default_factory=dict)  # file -> how many times still

    def cuts_now(self, name: str) -> bool:
        """Whether this answer is to be cut; counts down."""
        left = self.cuts.get(name, 0)
        self.cuts[name] = max(0, left - 1)
        return left > 0


class PackageIndex:
    """Serves the wheels of a folder on a port of its own, until the block ends."""

    def __init__(self, wheels: Path) -> None:
        self.folder = wheels
        self.traffic = Traffic()
        traffic = self.traffic

        class Answer(_Answer):
            folder = wheels
            traffic_of_index = traffic

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Answer)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def address(self) -> str:
        """What PIP_INDEX_URL takes."""
        return f"http://127.0.0.1:{self._server.server_address[1]}/simple"

    def fetched(self, start: str) -> list[tuple[str, int]]:
        """The requests for files whose name begins with `start`: name and first byte."""
        return [asked for asked in self.traffic.asked if asked[0].startswith(start)]

    def __enter__(self) -> PackageIndex:
        self._thread.start()
        return self

    def __exit__(self, *exc: object) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _Answer(BaseHTTPRequestHandler):
    folder: Path
    traffic_of_index: Traffic

    def do_GET(self) -> None:
        """A list of links, or a file."""
        if self.path.startswith("/simple/"):
            self._list(self.path.strip("/").split("/")[1])
        elif self.path.endswith(".metadata"):
            self._send_metadata(
                self.folder / self.path.rsplit("/", 1)[-1].removesuffix(".metadata")
            )
        else:
            self._send(self.folder / self.path.rsplit("/", 1)[-1])

    def _list(self, project: str) -> None:
        files = [f for f in sorted(self.folder.glob("*.whl")) if _project(f.name) == project]
        page = "".join(
            f'<a href="/files/{f.name}#sha256={hashlib.sha256(f.read_bytes()).hexdigest()}"'
            f' data-core-metadata="true">{f.name}</a>\n'
            for f in files
        )
        self._begin(200 if files else 404, len(page), {"Content-Type": "text/html"})
        self.wfile.write(page.encode())

    def _send_metadata(self, file: Path) -> None:
        with zipfile.ZipFile(file) as wheel:
            name = next(n for n in wheel.namelist() if n.endswith(".dist-info/METADATA"))
            content = wheel.read(name)
        self._begin(200, len(content), {"Content-Type": "text/plain"})
        self.wfile.write(content)

    def _send(self, file: Path) -> None:
        content = file.read_bytes()
        first = int(re.sub(r"\D", "", self.headers.get("Range", "") or "0") or 0)
        self.traffic_of_index.asked.append((file.name, first))
        part = content[first:]
        self._begin(206 if first else 200, len(part), _file_headers(first, content))
        if self.traffic_of_index.cuts_now(file.name):
            part = part[: len(part) // 2]
            self.close_connection = True
        self.wfile.write(part)

    def _begin(self, status: int, length: int, headers: dict[str, str]) -> None:
        self.send_response(status)
        for name, value in {"Content-Length": str(length), **headers}.items():
            self.send_header(name, value)
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        """Says nothing."""


def _file_headers(first: int, content: bytes) -> dict[str, str]:
    headers = {
        "Content-Type": "application/octet-stream",
        "Cache-Control": "max-age=365000000, immutable, public",
        "ETag": f'"{hashlib.sha256(content).hexdigest()}"',
        "Accept-Ranges": "bytes",
    }
    if first:
        headers["Content-Range"] = f"bytes {first}-{len(content) - 1}/{len(content)}"
    return headers


def _project(file: str) -> str:
    return file.split("-")[0].lower().replace("_", "-")
