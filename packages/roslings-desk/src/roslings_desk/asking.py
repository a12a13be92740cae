"""Ask another node for something, while the page goes on: it is asked in the node's thread."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import Future
from typing import Any, TypeVar

from ros2_on_pip.calling import PATIENCE_S, CallFailed, ServiceSilent
from roslings_desk.hub import Hub

LOOK_EVERY_S = 0.02
T = TypeVar("T")


async def ask(hub: Hub, service: str, cls: Any, request: Any) -> Any:
    """The answer of a service. Raises ServiceSilent, CallFailed."""
    node = hub.desk_node.node
    client = await asyncio.wrap_future(hub.do(lambda: node.create_client(cls, service)))
    try:
        return await in_time(service, _answer(hub, client, request))
    finally:
        hub.do(lambda: node.destroy_client(client))


async def _answer(hub: Hub, client: Any, request: Any) -> Any:
    await is_true(client.service_is_ready)
    return await answer_of(hub, client.srv_name, lambda: client.call_async(request))


async def in_time(asked: str, waiting: Awaitable[T]) -> T:
    """What comes of it, from the service or action `asked`. Raises ServiceSilent."""
    try:
        return await asyncio.wait_for(waiting, PATIENCE_S)
    except asyncio.TimeoutError:
        raise ServiceSilent(asked, PATIENCE_S) from None


async def is_true(condition: Callable[[], bool]) -> None:
    """Ask now and again, until it is."""
    while not condition():
        await asyncio.sleep(LOOK_EVERY_S)


async def answer_of(hub: Hub, service: str, request: Callable[[], Any]) -> Any:
    """What comes of a request, which is made in the node's thread. Raises CallFailed."""
    answered: Future[Any] = Future()
    await asyncio.wrap_future(hub.do(lambda: request().add_done_callback(answered.set_result)))
    done = await asyncio.shield(asyncio.wrap_future(answered))
    if fault := done.exception():
        raise CallFailed(service, fault)
    return done.result()
