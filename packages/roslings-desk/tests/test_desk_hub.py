"""What all pages share, without a page: the order of its work, and what is kept of a topic."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings_desk.hub import KEPT_BYTES, KEPT_MESSAGES, Hub, SharedSubscription
from skips import needs

pytestmark = needs("module rclpy")


@pytest.fixture
def hub(monkeypatch: pytest.MonkeyPatch) -> Iterator[Hub]:
    """On a domain of its own."""
    with leased_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        # Whoever imports rclpy in this process names a middleware; where its files lie is set by
        # the command, which this test does not run.
        monkeypatch.delenv("RMW_IMPLEMENTATION", raising=False)
        with Hub() as found:
            yield found


def test_what_is_asked_first_is_done_first(hub: Hub) -> None:
    """A stop after a drive must not be done before it."""
    done: list[int] = []
    waits = [hub.do(lambda number=number: done.append(number)) for number in range(50)]
    for each in waits:
        each.result(60)
    assert done == list(range(50))


def test_what_goes_wrong_is_the_askers_and_the_thread_goes_on(hub: Hub) -> None:
    """Also where nobody waits for it any more."""
    with pytest.raises(ZeroDivisionError):
        hub.do(lambda: 1 / 0).result(60)
    hub.do(lambda: 1).cancel()
    assert hub.do(lambda: 2).result(60) == 2


def test_two_pages_share_a_subscription_and_the_last_one_ends_it(hub: Hub) -> None:
    """Counted by topic and type."""
    first = hub.hear("/news", "std_msgs/msg/String")
    assert hub.hear("/news", "std_msgs/msg/String") is first
    hub.leave(first)
    assert [heard.topic for heard in hub.heard] == ["/news"]
    hub.leave(first)
    assert hub.heard == []


@pytest.mark.parametrize(("size_b", "kept"), [(10, KEPT_MESSAGES), (KEPT_BYTES // 4, 4)])
def test_only_so_many_messages_and_bytes_are_kept(size_b: int, kept: int) -> None:
    """All are counted; the newest is always there, and its number tells what is missing."""
    heard = SharedSubscription("/big", "std_msgs/msg/String", None)
    for _ in range(KEPT_MESSAGES + 5):
        heard.add(bytes(size_b))
    assert heard.count == KEPT_MESSAGES + 5
    assert [each.number for each in heard.after(0)][-1] == heard.count
    assert len(heard.after(0)) == kept


def test_one_message_larger_than_all_that_is_kept_is_there() -> None:
    """Nobody else's are."""
    heard = SharedSubscription("/big", "std_msgs/msg/String", None)
    heard.add(b"small")
    heard.add(bytes(KEPT_BYTES + 1))
    assert [each.number for each in heard.after(0)] == [2]
