"""pip's own wheel, from the index that this machine's pip would use.

Only where an address is configured (PIP_INDEX_URL, pip's configuration files): this project names
no registry.
"""

import configparser
import hashlib
import http.client
import os
import re
import urllib.parse
import urllib.request
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

_TIMEOUT_S = 30
_KEYS = ("index-url", "extra-index-url", "find-links")
_WHEEL = re.compile(r"pip-(\d+(?:\.\d+)*)-py3-none-any\.whl$")


class _Links(HTMLParser):
    """The addresses that a page links to."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keeps the address of a link."""
        self.found += [value for name, value in attrs if tag == "a" and name == "href" and value]


def wheel_from_index(scratch: Path) -> Iterator[Path]:
    """pip, fetched into `scratch` from each place that has one."""
    for address in _configured():
        for link in _newest_first(address):
            if wheel := _fetch(link, scratch):
                yield wheel / "pip"
                break


def _configured() -> list[str]:
    """Addresses of pages that list pip's wheels, in pip's order."""
    pages: list[str] = []
    for key, value in _settings():
        for place in value.split():
            pages.append(place if key == "find-links" else f"{place.rstrip('/')}/pip/")
    return pages


def _settings() -> Iterator[tuple[str, str]]:
    for key in _KEYS:
        variable = "PIP_" + key.upper().replace("-", "_")
        if value := os.environ.get(variable):
            yield key, value
    for file in _files():
        yield from _settings_of(file)


def _settings_of(file: Path) -> Iterator[tuple[str, str]]:
    parser = configparser.RawConfigParser()
    try:
        parser.read(file, encoding="utf-8")
    except (OSError, configparser.Error, UnicodeDecodeError):
        return
    for key in _KEYS:
        if value := parser.get("global", key, fallback=""):
            yield key, value


def _files() -> list[Path]:
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - Path raises without a home
    config = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
    named = os.environ.get("PIP_CONFIG_FILE")
    if named == os.devnull:  # pip's own way to say: no configuration
        return []
    return [
        *([Path(named)] if named else []),
        config / "pip/pip.conf",
        home / ".pip/pip.conf",
        Path("/etc/xdg/pip/pip.conf"),
        Path("/etc/pip.conf"),
    ]


def _newest_first(page: str) -> list[str]:
    links = [link for link in _links(page) if _version(link)]
    return sorted(links, key=_version, reverse=True)[:1]


def _version(link: str) -> tuple[int, ...]:
    name = urllib.parse.urlsplit(link).path.rsplit("/", 1)[-1]
    found = _WHEEL.match(name)
    return tuple(map(int, found[1].split("."))) if found else ()


def _links(page: str) -> list[str]:
    """Absolute addresses on `page`, which may be a folder too."""
    folder = Path(urllib.request.url2pathname(urllib.parse.urlsplit(page).path))
    if page.startswith(("file:", "/")) and not (folder / "index.html").is_file():
        return [file.as_uri() for file in folder.glob("*.whl")]
    address = f"{folder.as_uri()}/index.html" if page.startswith(("file:", "/")) else page
    content = _read(address)
    parser = _Links()
    parser.feed(content.decode("utf-8", "replace") if content else "")
    return [urllib.parse.urljoin(address, link) for link in parser.found]


def _read(address: str) -> bytes | None:
    try:
        with urllib.request.urlopen(address, timeout=_TIMEOUT_S) as answer:
            return bytes(answer.read())
    except (OSError, ValueError, http.client.HTTPException):  # URLError is an OSError
        return None


def _fetch(link: str, scratch: Path) -> Path | None:
    """The file behind `link`, or None where it does not come or is not what the link promises."""
    address, fragment = urllib.parse.urldefrag(link)
    content = _read(address)
    if content is None or not _as_promised(content, fragment):
        return None
    scratch.mkdir(parents=True, exist_ok=True)
    file = scratch / urllib.parse.urlsplit(address).path.rsplit("/", 1)[-1]
    file.write_bytes(content)
    return file


def _as_promised(content: bytes, fragment: str) -> bool:
    kind, _, digest = fragment.partition("=")
    return kind != "sha256" or hashlib.sha256(content).hexdigest() == digest
