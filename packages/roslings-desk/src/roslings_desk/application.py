"""The pages as one ASGI application: NiceGUI, told what is not to be as it usually is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from fastapi import FastAPI
from nicegui import Client, ui
from nicegui.client import ClientConnectionTimeout

from roslings_desk.bag_player import BagPlayer
from roslings_desk.hub import Hub
from roslings_desk.page import build, build_for_phone
from roslings_desk.phone import PAGE
from roslings_desk.tab import tabs

TITLE = "roslings desk"
TAB_OF_PHONE = "rover"
CONNECTS_WITHIN_S = 30
RECONNECTS_WITHIN_S = 3.0
KEPT_MESSAGES = 100
"""For a page that was away for a moment; one that missed more loads anew. Each may be a picture."""


Words = Mapping[str, Sequence[str]]


def application(
    hub: Hub, bag: BagPlayer | None = None, shown: Words | None = None, phone: bool = False
) -> FastAPI:
    """A page for each tab; the first one has the bare address, too.

    `shown` has what a tab shows at once, by the tab's name; with `phone` there is a page for one.
    """
    shown = shown or {}
    app = FastAPI(title=TITLE, docs_url=None, redoc_url=None, openapi_url=None)
    for name in (there := tabs()):
        _add_page(hub, bag, name, f"/{name}", shown.get(name, ()))
    _add_page(hub, bag, next(iter(there)), "/")
    if phone:
        _add_page_for_phone(hub)
    ui.run_with(
        app,
        title=TITLE,
        dark=None,
        language="en-US",
        tailwind=False,
        gzip_middleware_factory=None,
        reconnect_timeout=RECONNECTS_WITHIN_S,
        message_history_length=KEPT_MESSAGES,
        show_welcome_message=False,
    )
    return app


def _add_page(
    hub: Hub, bag: BagPlayer | None, name: str, path: str, shown: Sequence[str] = ()
) -> None:
    @ui.page(path)
    async def page(client: Client) -> None:
        if await _is_shown(client):
            build(hub, name, tabs(), bag, shown)


def _add_page_for_phone(hub: Hub) -> None:
    @ui.page(PAGE)
    async def page(client: Client) -> None:
        if await _is_shown(client):
            build_for_phone(hub, tabs()[TAB_OF_PHONE]())


async def _is_shown(client: Client) -> bool:
    """False where it was only fetched, and no browser shows it."""
    try:
        await client.connected(timeout=CONNECTS_WITHIN_S)
    except ClientConnectionTimeout:
        return False
    return True
