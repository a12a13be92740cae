"""The tab of services, in a real browser, with a real node that answers."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from desk_program import Desk, Nodes, until

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/services")
    expect(found.get_by_role("heading", name="Services", level=2)).to_be_visible()
    return found


def offers(nodes: Nodes, name: str, answer: Any) -> list[Any]:
    """A service std_srvs/srv/SetBool; what it was asked."""
    from std_srvs.srv import SetBool

    asked: list[Any] = []

    def serve(request: Any, response: Any) -> Any:
        asked.append(request.data)
        response.success, response.message = answer(request.data)
        return response

    nodes.node.create_service(SetBool, name, serve)
    return asked


def test_a_service_is_called_by_what_a_screen_reader_has(page: Any, nodes: Nodes) -> None:
    """A form made from its type, by keys alone; the node sees it, and its answer is shown."""
    asked = offers(nodes, "/light", lambda on: (on, "it is on" if on else "it is off"))
    page.get_by_role("button", name="/light").press("Enter")
    page.get_by_role("checkbox", name="data (boolean)").press("Space")
    page.get_by_role("button", name="Call", exact=True).press("Enter")
    answer = page.get_by_role("region", name="The answer")
    expect(answer).to_contain_text("message: it is on")
    expect(page.get_by_role("status")).to_contain_text("The answer came after")
    assert asked == [True]
    page.get_by_role("checkbox", name="data (boolean)").press("Space")
    page.get_by_role("button", name="Call", exact=True).press("Enter")
    expect(answer).to_contain_text("message: it is off")
    assert asked == [True, False]


def test_those_of_every_node_are_shown_when_they_are_asked_for(page: Any, nodes: Nodes) -> None:
    """They would hide the others."""
    offers(nodes, "/light", lambda on: (on, ""))
    expect(page.get_by_role("button", name="/light")).to_be_visible()
    expect(page.get_by_role("button", name="/tester/get_parameters")).to_have_count(0)
    page.get_by_label("Also those that each node has").check()
    page.get_by_role("button", name="/tester/get_parameters").click()
    page.get_by_label("names (sequence<string>)").fill("[use_sim_time]")
    page.get_by_role("button", name="Call", exact=True).click()
    expect(page.get_by_role("region", name="The answer")).to_contain_text("bool_value: false")


def test_a_wrong_field_is_told_and_nothing_is_asked(page: Any, nodes: Nodes) -> None:
    """By the name of the field."""
    page.get_by_label("Also those that each node has").check()
    page.get_by_role("button", name="/tester/get_parameters").click()
    page.get_by_label("names (sequence<string>)").fill("use_sim_time")
    page.get_by_role("button", name="Call", exact=True).click()
    expect(page.get_by_role("alert").filter(has_text="names: it needs a list")).to_be_visible()


def test_a_service_that_stays_silent_is_told(page: Any, nodes: Nodes) -> None:
    """After ten seconds, with the likely reason; the page works on meanwhile."""
    go_on = threading.Event()
    asked = offers(nodes, "/slow", lambda on: (go_on.wait(60), ""))
    page.get_by_role("button", name="/slow").click()
    page.get_by_role("button", name="Call", exact=True).click()
    until(lambda: asked, "the call")
    expect(page.get_by_role("status")).to_have_text("Waiting for the answer ...")
    page.get_by_label("Find a service").fill("nothing like it")
    expect(page.get_by_text("0 of ")).to_be_visible()
    expect(page.get_by_role("alert").filter(has_text="does not answer within 10 s")).to_be_visible()
    go_on.set()
