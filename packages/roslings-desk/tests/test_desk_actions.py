"""The tab of actions, in a real browser, with a real node that serves one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from desk_program import Desk, Nodes, until

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

ACTION, REFUSED = "/count", -1


class Server:
    """Serves test_msgs/action/Fibonacci at /count; each goal ends when the test wants it."""

    def __init__(self, nodes: Nodes) -> None:
        from rclpy.action import ActionServer, CancelResponse, GoalResponse
        from test_msgs.action import Fibonacci

        self._type = Fibonacci
        self.orders: list[int] = []
        self.handles: list[Any] = []
        self.cancelled: list[Any] = []
        self.ends = self.cancels = True

        def take(goal: Any) -> Any:
            self.orders.append(goal.order)
            return GoalResponse.REJECT if goal.order == REFUSED else GoalResponse.ACCEPT

        def cancel(handle: Any) -> Any:
            return CancelResponse.ACCEPT if self.cancels else CancelResponse.REJECT

        self._node = nodes.node
        self._server: Any = ActionServer(
            nodes.node, Fibonacci, ACTION, self._run, goal_callback=take, cancel_callback=cancel
        )

    async def _run(self, handle: Any) -> Any:
        from rclpy.task import Future

        self.handles.append(handle)
        over = Future(executor=self._node.executor)

        def look() -> None:
            if not over.done() and (self.ends or handle.is_cancel_requested):
                over.set_result(None)

        timer = self._node.create_timer(0.02, look)
        await over
        self._node.destroy_timer(timer)
        if handle.is_cancel_requested:
            self.cancelled.append(handle)
            handle.canceled()
        else:
            handle.succeed()
        return self._type.Result(sequence=[0, 1, 1, 2])

    def tell(self, *sequence: int) -> None:
        """Feedback for the newest goal."""
        until(lambda: self.handles, "a goal that runs")
        self.handles[-1].publish_feedback(self._type.Feedback(sequence=list(sequence)))

    def leave(self) -> None:
        """It serves no more."""
        if self._server:
            self._server.destroy()
            self._server = None


@pytest.fixture
def server(nodes: Nodes) -> Iterator[Server]:
    """It is there before the page is opened. A node's end does not end it: it is no part of it."""
    found = Server(nodes)
    yield found
    found.ends = True
    found.leave()


@pytest.fixture
def page(context: Any, opened: Desk, server: Server) -> Any:
    """The tab, open, with the action chosen."""
    found = context.new_page()
    found.goto(f"{opened.base}/actions")
    found.get_by_role("button", name=ACTION).press("Enter")
    expect(found.get_by_role("heading", name=ACTION, level=3)).to_be_visible()
    return found


def send(page: Any, order: int) -> None:
    """A goal, by names and keys alone."""
    page.get_by_label("order (int32)").fill(str(order))
    page.get_by_role("button", name="Send goal").press("Enter")


def state(page: Any) -> Any:
    """The line that screen readers say."""
    return page.get_by_role("status")


def test_a_goal_is_sent_and_followed_by_what_a_screen_reader_has(page: Any, server: Server) -> None:
    """The node gets what was typed; its feedback and its result are shown."""
    server.ends = False
    send(page, 4)
    expect(state(page)).to_have_text("The server has accepted the goal. It runs.")
    assert server.orders == [4]
    server.tell(0, 1, 1)
    feedback = page.get_by_role("region", name="The feedback")
    expect(feedback).to_contain_text("- 1")
    expect(page.get_by_text("Feedback: 1 so far")).to_be_visible()
    server.ends = True
    expect(state(page)).to_contain_text("it succeeded (SUCCEEDED)")
    expect(page.get_by_role("region", name="The result")).to_contain_text("- 2")


def test_a_goal_is_cancelled(page: Any, server: Server) -> None:
    """The node sees it, and how it ended stands on the page."""
    server.ends = False
    send(page, 1)
    expect(state(page)).to_have_text("The server has accepted the goal. It runs.")
    page.get_by_role("button", name="Cancel goal").press("Enter")
    expect(state(page)).to_contain_text("it was cancelled (CANCELED)")
    assert server.cancelled == server.handles


def test_what_a_server_refuses_is_told(page: Any, server: Server) -> None:
    """A goal, or its cancelling; the goal goes on then."""
    send(page, REFUSED)
    expect(page.get_by_role("alert").filter(has_text="rejected this goal")).to_be_visible()
    server.ends = server.cancels = False
    send(page, 1)
    expect(state(page)).to_have_text("The server has accepted the goal. It runs.")
    page.get_by_role("button", name="Cancel goal").click()
    expect(page.get_by_role("alert").filter(has_text="does not cancel")).to_be_visible()
    server.ends = True
    expect(state(page)).to_contain_text("it succeeded")


def test_one_goal_at_a_time_and_none_to_cancel_are_told(page: Any, server: Server) -> None:
    """Nothing is sent meanwhile."""
    page.get_by_role("button", name="Cancel goal").click()
    expect(page.get_by_role("alert").filter(has_text="nothing to cancel")).to_be_visible()
    server.ends = False
    send(page, 1)
    expect(state(page)).to_have_text("The server has accepted the goal. It runs.")
    send(page, 2)
    expect(page.get_by_role("alert").filter(has_text="still runs")).to_be_visible()
    assert server.orders == [1]


def test_a_page_that_is_closed_cancels_its_goal(page: Any, server: Server) -> None:
    """Nobody is left who could."""
    server.ends = False
    send(page, 1)
    expect(state(page)).to_have_text("The server has accepted the goal. It runs.")
    page.close()
    until(lambda: server.cancelled == server.handles, "the request to cancel")


def test_a_wrong_field_and_a_server_that_left_are_told(page: Any, server: Server) -> None:
    """By the field's name; and with what is there instead."""
    page.get_by_label("order (int32)").fill("many")
    page.get_by_role("button", name="Send goal").click()
    expect(page.get_by_role("alert").filter(has_text="order:")).to_be_visible()
    server.leave()
    expect(page.get_by_text("0 of 0 actions")).to_be_visible()
    send(page, 1)
    expect(page.get_by_role("alert").filter(has_text="No node serves")).to_be_visible()
    assert server.orders == []
