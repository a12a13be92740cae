"""Ask a service, while the page goes on: the request is made in the node's thread."""

from __future__ import annotations

import asyncio
from concurrent.futures import Future
from typing import Any

from ros2_on_pip.calling import PATIENCE_S, CallFailed, NoAnswer
from roslings_desk.hub import Hub

LOOK_EVERY_S = 0.02


async def ask(hub: Hub, service: str, cls: Any, request: Any) -> Any:
    """The answer. Raises NoAnswer, CallFailed."""
    node = hub.eye.node
    client = await asyncio.wrap_future(hub.do(lambda: node.create_client(cls, service)))
    try:
        return await asyncio.wait_for(_answer(hub, client, request), PATIENCE_S)
    except asyncio.TimeoutError:
        raise NoAnswer(service, PATIENCE_S) from None
    finally:
        hub.do(lambda: node.destroy_client(client))


async def _answer(hub: Hub, client: Any, request: Any) -> Any:
    while not client.service_is_ready():
        await asyncio.sleep(LOOK_EVERY_S)
    answered: Future[Any] = Future()

    def call() -> None:
        client.call_async(request).add_done_callback(answered.set_result)

    hub.do(call)
    done = await asyncio.shield(asyncio.wrap_future(answered))
    if fault := done.exception():
        raise CallFailed(client.srv_name, fault)
    return done.result()
