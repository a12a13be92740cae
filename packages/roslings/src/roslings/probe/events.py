"""Without the events of the middleware: rclpy looks at each of them at every turn.

What does not fit together is seen in the graph, and nobody reads the warnings that rclpy logs.
"""

from __future__ import annotations

from typing import Any


def no_subscription_events() -> Any:
    """For a subscription: rclpy's SubscriptionEventCallbacks."""
    from rclpy.event_handler import SubscriptionEventCallbacks

    return SubscriptionEventCallbacks(use_default_callbacks=False)


def no_publisher_events() -> Any:
    """For a publisher: rclpy's PublisherEventCallbacks."""
    from rclpy.event_handler import PublisherEventCallbacks

    return PublisherEventCallbacks(use_default_callbacks=False)
