"""What Jupyter's server loads for the window of a day."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.utils import url_path_join
from tornado.web import authenticated

from roslings import course
from roslings.commands.check import WINDOW_PAGE
from roslings.workspace.student import workspace_root
from roslings_learn.jupyter.copies import Copies
from roslings_learn.jupyter.window import desk_proxy
from roslings_learn.jupyter.window.desks import Desks
from roslings_learn.jupyter.window.layout import file_to_edit
from roslings_learn.lessons import Glossary
from roslings_learn.of_window import OF_SERVER

MODULE = __name__
DAY = r"(\d\d-[\w-]+)"


@dataclass(frozen=True)
class WatchedFiles:
    """What the page asks about, again and again."""

    copies: Copies
    check_page: Path

    def news(self, day_id: str) -> dict[str, str]:
        """The file to edit, empty before it is there; and the time of the last check's page."""
        file = file_to_edit(day_id, self.copies)
        return {
            "file": self.copies.path_of(file) if file else "",
            "checked": _changed(self.check_page),
        }


def _changed(file: Path) -> str:
    try:
        return str(file.stat().st_mtime_ns)
    except OSError:
        return ""


class News(JupyterHandler):
    """What has changed, for the page."""

    def initialize(self, watched: WatchedFiles) -> None:
        """Called by Tornado."""
        self._watched = watched

    @authenticated
    def get(self, day_id: str) -> None:
        """As JSON."""
        self.set_header("Content-Type", "application/json")
        self.set_header("Cache-Control", "no-store")
        self.finish(json.dumps(self._watched.news(day_id)))


class CheckPage(JupyterHandler):
    """The page of the newest check: it names in itself that it runs no script."""

    def initialize(self, watched: WatchedFiles) -> None:
        """Called by Tornado."""
        self._watched = watched

    @authenticated
    def get(self) -> None:
        """Or 404 before the first check."""
        try:
            page = self._watched.check_page.read_bytes()
        except OSError:
            self.set_status(404)
            page = b"Nothing was checked yet. In a terminal, type: ./roslings check LAB"
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.set_header("Cache-Control", "no-store")
        self.finish(page)


def _load_jupyter_server_extension(app: Any) -> None:
    """Called by Jupyter's server."""
    workspace = workspace_root()
    copies = Copies(course.root(), workspace, Glossary(()))  # nothing is copied here
    watched = WatchedFiles(copies, workspace / ".roslings" / "check.html")
    watched.check_page.parent.mkdir(parents=True, exist_ok=True)
    os.environ[OF_SERVER] = app.base_url
    os.environ[WINDOW_PAGE] = str(watched.check_page)
    room, given = url_path_join(app.base_url, "roslings"), {"watched": watched}
    app.web_app.add_handlers(
        ".*$",
        [
            (rf"{room}/news/{DAY}", News, given),
            (rf"{room}/check", CheckPage, given),
            *desk_proxy.handlers(app.base_url, Desks(workspace)),
        ],
    )


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": MODULE}]
