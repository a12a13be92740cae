"""A table that its reader sorts and searches, and the page around it.

A script of ours does that. The page allows this one by its digest, and no other: what stands in a
hand-in is never run.
"""

from __future__ import annotations

import hashlib
from base64 import b64encode
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from ros2_on_pip.markup import Markup, tag
from roslings.report.html.document import POLICY, brand, style
from roslings.report.whole_file import write_whole

STYLE, SCRIPT = (Path(__file__).with_name(name) for name in ("class_page.css", "class_page.js"))
Line = TypeVar("Line")


@dataclass(frozen=True)
class Column(Generic[Line]):
    """One column: its head, its class in the style, and what stands in it."""

    head: str
    name: str
    cell: Callable[[Line], str]
    key: Callable[[Line], str] | None = None
    """By which it is sorted, where that is not the text."""


def sorted_table(
    columns: Sequence[Column[Line]],
    lines: Sequence[Line],
    about: str,
    also: Callable[[Line], str] = lambda line: "",
) -> Markup:
    """The table and its search, about which a reader is told; `also` is what it finds besides."""
    head = tag("tr", *(tag("th", each.head, class_=each.name, scope="col") for each in columns))
    rows = [_row(line, columns, also(line)) for line in lines]
    table = tag("table", tag("thead", head), tag("tbody", *rows), class_="class")
    search = _search(f"in {len(rows)} lines: {about}")
    return tag("section", tag("h2", "Everybody"), search, table, id="everybody")


def _search(about: str) -> Markup:
    """Shown by the script, which alone can search."""
    field = tag("input", type="search", autocomplete="off")
    label = tag("label", tag("span", "Search"), field)
    told = (tag("span", about, class_="about"), tag("output", ""))
    return tag("div", label, *told, class_="search", hidden="")


def _row(line: Line, columns: Sequence[Column[Line]], also: str) -> Markup:
    first, *others = columns
    who = tag("th", first.cell(line), class_=first.name, scope="row")
    return tag("tr", who, *(_cell(each, line) for each in others), data_also=also or None)


def _cell(column: Column[Line], line: Line) -> Markup:
    key = column.key(line) if column.key else None
    text = column.cell(line)
    return tag("td", text, class_=column.name, data_head=column.head, data_key=key)


def write_page(path: Path, over: str, title: str, parts: Iterable[Markup]) -> None:
    """Write a page with such a table: a line over its title, and its parts.

    Raises CannotWriteFile.
    """
    script = SCRIPT.read_text("utf-8")
    header = tag("header", tag("p", over, class_="over"), tag("h1", title))
    body = tag("body", brand(), header, tag("main", *parts), tag("script", Markup(script)))
    page = tag("html", _head(title, script), body, lang="en")
    write_whole(path, f"<!DOCTYPE html>\n{page}\n".encode())


def _head(title: str, script: str) -> Markup:
    digest = b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = f"{POLICY}; script-src 'sha256-{digest}'"
    return tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=policy),
        tag("meta", name_="viewport", content="width=device-width, initial-scale=1"),
        tag("title", f"The class: {title}"),
        style(STYLE.read_text("utf-8")),
    )
