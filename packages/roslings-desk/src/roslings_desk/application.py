"""The pages as one ASGI application: NiceGUI, told what is not to be as it usually is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from fastapi import FastAPI
from nicegui import Client, ui
from nicegui.client import ClientConnectionTimeout

from roslings_desk.bag_player import BagPlayer
from roslings_desk.hub import Hub
from roslings_desk.page import build
from roslings_desk.tab import tabs

TITLE = "roslings desk"
CONNECTS_WITHIN_S = 30
RECONNECTS_WITHIN_S = 3.0
KEPT_MESSAGES = 100
"""For a page that was away for a moment; one that missed more loads anew. Each may be a picture."""


Words = Mapping[str, Sequence[str]]


def application(hub: Hub, bag: BagPlayer | None = None, shown: Words | None = None) -> FastAPI:
    """A page for each tab; the first one has the bare address, too.

    `shown` has what a tab shows at once, by the tab's name.
    """
    shown = shown or {}
    app = FastAPI(title=TITLE, docs_url=None, redoc_url=None, openapi_url=None)
    for name in (there := tabs()):
        _add_page(hub, bag, name, f"/{name}", shown.get(name, ()))
    _add_page(hub, bag, next(iter(there)), "/")
    ui.run_with(
        app, title=TITLE, dark=None, language="en-US", tailwind=False, gzip_middleware_factory=None,
        reconnect_timeout=RECONNECTS_WITHIN_S, message_history_length=KEPT_MESSAGES,
        show_welcome_message=False,
    )  # fmt: skip
    return app


def _add_page(
    hub: Hub, bag: BagPlayer | None, name: str, path: str, shown: Sequence[str] = ()
) -> None:
    @ui.page(path)
    async def page(client: Client) -> None:
        try:
            await client.connected(timeout=CONNECTS_WITHIN_S)
        except ClientConnectionTimeout:
            return  # it was fetched, and no browser shows it
        build(hub, name, tabs(), bag, shown)
