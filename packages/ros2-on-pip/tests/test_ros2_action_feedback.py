"""The feedback of an action is a message on a hidden topic."""

from __future__ import annotations

import sys

import pytest
from test_msgs.action import Fibonacci

from ros2_on_pip.interfaces import UnknownInterface, class_of


def test_the_feedback_of_an_action_is_a_message_too() -> None:
    """So `ros2 topic hz /fibonacci/_action/feedback` works."""
    found = class_of("test_msgs/action/Fibonacci_FeedbackMessage", "msg")
    assert found is Fibonacci.Impl.FeedbackMessage


@pytest.mark.parametrize(
    "type_name", ["test_msgs/action/Fibbonacci_FeedbackMessage", "test_msgs/action/Fibonacci"]
)
def test_what_is_no_message_of_an_installed_type_is_refused(
    type_name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The error says so, as for each type."""
    monkeypatch.setenv("AMENT_PREFIX_PATH", sys.prefix)  # the command sets it for itself
    with pytest.raises(UnknownInterface):
        class_of(type_name, "msg")
