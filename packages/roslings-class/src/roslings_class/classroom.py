"""`./roslings serve`: what a room needs, from the instructor's laptop, without the internet.

    /                     what to type, for this very address
    /roslings-course.tar.gz   the students' edition
    /simple/              an index of packages (PEP 503): the wheel of roslings, and DIR of `wheels`
    /wheels/FILE.whl      the same files
    /site/                the website, where it was built

Everything is made, or listed, before the first student asks. Only these files can be had: nothing
of the instructor's own clone, in which the solutions lie, and nothing can be written.
"""

from __future__ import annotations

import hashlib
import html
import mimetypes
import re
import shutil
import sys
import tarfile
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import cache
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from io import StringIO
from pathlib import Path
from urllib.parse import unquote, urlsplit

from ros2_on_pip.network_cards import cards
from roslings import course
from roslings.course import CourseError
from roslings_class.release import release
from roslings_class.wheel import wheel_of
from roslings_launcher.packages import normal

COURSE = "roslings-course"
SITE = "build/site/html"
ARCHIVE = f"{COURSE}.tar.gz"
ALL_CARDS = "0.0.0.0"
LOOPBACK = "127.0.0.1"
_FETCH = "from urllib.request import urlretrieve; urlretrieve('{address}/{archive}', '{archive}')"
"""Python is there; curl and wget may not be."""
_SITE = '<p><a href="/site/index.html">The website of the course</a></p>'
QUIET_S = 60
"""A student whose connection stands still for so long is left."""


class CannotServe(CourseError):
    """The room cannot be served like this; the text says what to type."""


@dataclass(frozen=True)
class Handout:
    """What is handed out: files by the path of their address."""

    files: dict[str, Path]
    wheels: dict[str, Path]
    """By the name of the file."""
    has_site: bool = False

    @property
    def projects(self) -> dict[str, list[str]]:
        """Names of packages as an index spells them, to their wheels."""
        found: dict[str, list[str]] = {}
        for name in sorted(self.wheels):
            found.setdefault(project(name), []).append(name)
        return found

    @property
    def pythons(self) -> list[str]:
        """The Pythons that the wheel of ROS's rclpy is there for, as `3.12`."""
        tags = (re.match(r"ros_rclpy-.*-cp3(\d+)-", name) for name in self.wheels)
        return [f"3.{minor}" for minor in sorted({int(tag[1]) for tag in tags if tag})]


def project(wheel: str) -> str:
    """The package of a wheel, as an index spells it."""
    return normal(wheel.partition("-")[0])


def made_in(scratch: Path, wheels: Path | None, site: Path | None) -> Handout:
    """All that this course can hand out; what has to be made for it lies in `scratch`.

    Raises CannotServe, CannotRelease, NoAddress.
    """
    found = _wheels_in(wheels), _pages_in(site or _built_site())  # refused before anything is made
    edition = scratch / "edition"
    release(edition)
    # setuptools tells each step of its own on both.
    with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        own = scratch / wheel_of(edition, scratch)
    return offer(edition, own, *found)


def _built_site() -> Path | None:
    built = course.root() / SITE
    return built if (built / "index.html").is_file() else None


def offer(
    edition: Path, own: Path, wheels: Mapping[str, Path], pages: Mapping[str, Path]
) -> Handout:
    """The edition, packed into an archive beside it; its wheel `own`, other wheels, and pages."""
    found = {own.name: own, **wheels}
    files = {ARCHIVE: packed(edition)} | {f"wheels/{name}": at for name, at in found.items()}
    return Handout({**files, **pages}, found, bool(pages))


def packed(edition: Path) -> Path:
    """The edition in one file, as one folder; tar and gzip are on every Linux."""
    archive = edition.parent / ARCHIVE
    with tarfile.open(archive, "w:gz", compresslevel=6) as tar:
        tar.add(edition, COURSE, filter=_nobodys)
    return archive


def _nobodys(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry


def _wheels_in(folder: Path | None) -> dict[str, Path]:
    if not folder:
        return {}
    found = {path.name: path for path in sorted(folder.glob("*.whl")) if path.is_file()}
    if not found:
        raise CannotServe(
            f"{folder} has no wheels. Where there is a network, fill it: ./roslings wheels {folder}"
        )
    return found


def _pages_in(site: Path | None) -> dict[str, Path]:
    """Every file of the built site, but hidden ones, and none that a link leads out to."""
    if not site:
        return {}
    if not (site / "index.html").is_file():
        raise CannotServe(f"{site} is no built site. Build it: ./roslings site")
    real = site.resolve()
    return {
        f"site/{path.relative_to(site).as_posix()}": path
        for path in sorted(site.rglob("*"))
        if path.is_file() and path.resolve().is_relative_to(real) and not _hidden(path, site)
    }


def _hidden(path: Path, site: Path) -> bool:
    return any(part.startswith(".") for part in path.relative_to(site).parts)


# --- pages -------------------------------------------------------------------------------------


def commands(address: str) -> list[str]:
    """What a student types, from nothing to a first grading, with this server's address."""
    host = urlsplit(address).hostname or ""
    return [
        f"export PIP_INDEX_URL={address}/simple/ PIP_TRUSTED_HOST={host}",
        f'python3 -c "{_FETCH.format(address=address, archive=ARCHIVE)}"',
        f"tar xzf {ARCHIVE}",
        f"cd {COURSE}",
        "./roslings check example --solution",
    ]


def start_page(offered: Handout, address: str) -> str:
    """The page at the address itself."""
    typed = html.escape("\n".join(commands(address)))
    pythons = ", ".join(offered.pythons)
    brought = (
        f"<p>No internet is needed with Python {pythons}, or where ROS 2 Jazzy is sourced.</p>"
        if pythons
        else "<p>ROS itself is not on this computer: your own needs the internet for it, so leave "
        "out the line that begins with <code>export</code>.</p>"
    )
    site = (
        '<p><a href="/site/index.html">The website of the course</a></p>'
        if offered.has_site
        else ""
    )
    return _page(
        "roslings",
        f"<h1>roslings</h1><p>On Linux, type this in a terminal:</p><pre>{typed}</pre>{brought}"
        f"<p>Everything comes into the folder <code>{COURSE}</code>, and your own work lies in "
        f"<code>~/roslings_ws</code>.</p>{site}"
        f'<p><a href="/{ARCHIVE}">The course as one file</a>. '
        '<a href="/simple/">The packages</a>.</p>',
    )


def index_page(offered: Handout) -> str:
    """All packages."""
    links = "\n".join(f'<a href="/simple/{name}/">{name}</a><br>' for name in offered.projects)
    return _page("packages", links)


def project_page(offered: Handout, name: str) -> str | None:
    """The wheels of a package, with their digests; None where there is none."""
    wheels = offered.projects.get(name)
    if wheels is None:
        return None
    links = (
        f'<a href="/wheels/{wheel}#sha256={digest(offered.wheels[wheel])}">{wheel}</a><br>'
        for wheel in wheels
    )
    return _page(name, "\n".join(links))


@cache
def digest(file: Path) -> str:
    """SHA-256 of a file, in hexadecimal."""
    found = hashlib.sha256()
    with file.open("rb") as content:
        while block := content.read(1 << 20):
            found.update(block)
    return found.hexdigest()


def _page(title: str, body: str) -> str:
    return (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        '<meta name="viewport" content="width=device-width">'
        "<style>body{font-family:sans-serif;max-width:50em;margin:2em auto;padding:0 1em;"
        "line-height:1.5}pre{background:#eee;color:#111;padding:1em;white-space:pre-wrap;"
        f"overflow-wrap:anywhere}}</style></head><body>{body}</body></html>\n"
    )


def told(offered: Handout, addresses: list[str]) -> str:
    """What the instructor reads."""
    pythons = ", ".join(offered.pythons)
    wheels = (
        f"{len(offered.wheels)}, with ROS for Python {pythons}"
        if pythons
        else "only roslings itself. For all: ./roslings wheels DIR, then serve --wheels DIR"
    )
    lines = [
        f"The course can be had at {addresses[0]}",
        *(f"  or        {each}" for each in addresses[1:]),
        "  edition   without solutions, as one file",
        f"  packages  {wheels}",
        f"  site      {'yes' if offered.has_site else 'no. Build it: ./roslings site'}",
        "Students open the address in a browser: it says what to type. Ctrl-C ends this.",
    ]
    return "\n".join(lines)


# --- the server --------------------------------------------------------------------------------


class _Answer(BaseHTTPRequestHandler):
    offered: Handout
    protocol_version = "HTTP/1.1"
    timeout = QUIET_S
    server_version = "roslings"
    sys_version = ""

    def do_GET(self) -> None:
        """A page, or a file."""
        path = unquote(urlsplit(self.path).path).lstrip("/")
        page = self._page(path)
        if page is not None:
            self._send_page(200, page)
        elif file := self._file(path):
            self._send_file(file)
        else:
            self._send_page(404, _page("not here", "<p>This is not handed out here.</p>"))

    def do_HEAD(self) -> None:
        """The same without its content."""
        self.do_GET()

    def _page(self, path: str) -> str | None:
        if not path:
            return start_page(self.offered, f"http://{self._host()}")
        if path.rstrip("/") == "simple":
            return index_page(self.offered)
        asked = re.fullmatch(r"simple/([^/]+)/?", path)
        return project_page(self.offered, normal(asked[1])) if asked else None

    def _file(self, path: str) -> Path | None:
        """One of those that are handed out: a path is a name in a table, and leads nowhere else."""
        within = f"{path.rstrip('/')}/index.html"
        return self.offered.files.get(path) or self.offered.files.get(within)

    def _host(self) -> str:
        """By which name this student has found us; nothing else of the request is shown."""
        told = self.headers.get("Host", "")
        if re.fullmatch(r"[\w.-]+(:\d+)?|\[[0-9A-Fa-f:]+\](:\d+)?", told):
            return told
        host, port = self.connection.getsockname()[:2]
        return f"{host}:{port}"

    def _send_page(self, status: int, page: str) -> None:
        content = page.encode()
        self._begin(status, len(content), "text/html; charset=utf-8")
        if self.command != "HEAD":
            self.wfile.write(content)

    def _send_file(self, file: Path) -> None:
        try:
            content = file.open("rb")
        except OSError:
            self._send_page(404, _page("not here", "<p>This is not here any more.</p>"))
            return
        with content:
            self._begin(200, file.stat().st_size, _kind(file))
            if self.command != "HEAD":
                shutil.copyfileobj(content, self.wfile, 1 << 18)

    def _begin(self, status: int, size: int, kind: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(size))
        self.send_header("X-Content-Type-Options", "nosniff")
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        """Nothing: nobody's computer is noted down."""


def _kind(file: Path) -> str:
    if file.suffix in (".whl", ".gz"):
        return "application/octet-stream"
    kind = mimetypes.guess_type(file.name)[0] or "application/octet-stream"
    return f"{kind}; charset=utf-8" if kind.startswith("text/") else kind


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 128  # a class begins at once

    def handle_error(self, request: object, client_address: object) -> None:
        """A student who goes away in the middle is no trouble; all else is shown."""
        if not isinstance(sys.exc_info()[1], ConnectionError | TimeoutError):
            super().handle_error(request, client_address)  # type: ignore[arg-type]


@contextmanager
def serving(offered: Handout, host: str, port: int) -> Iterator[list[str]]:
    """The addresses under which all of it can be had while the block runs.

    Raises CannotServe.
    """
    answer = type("Answer", (_Answer,), {"offered": offered})
    try:
        server = _Server((host, port), answer)
    except OSError as error:
        raise CannotServe(
            f"{host}:{port} cannot be used: {error.strerror or error}. Take another: --port 8001"
        ) from None
    thread = threading.Thread(target=server.serve_forever, name="serve", daemon=True)
    thread.start()
    try:
        yield addresses(host, server.server_address[1])
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def addresses(host: str, port: int) -> list[str]:
    """How others reach a server that listens on `host`; the room's network first."""
    if host != ALL_CARDS:
        return [f"http://{host}:{port}"]
    found = [address for card in cards() for address in card.inet4 if "loopback" not in card.flags]
    return [f"http://{address}:{port}" for address in (*found, LOOPBACK)]
