"""Script: an operator, a button, a pair of motors: what stands around the nodes that are judged.

    python player.py '{"name": ..., "commands": {...}, "button": {...}, "motors": {...}, ...}'

It is a process of its own, so that it can freeze, be killed, or run on another host. It is told
what to do by lines of JSON, and tells what it sees and does in the same way:

    <- {"drive": {"linear.x": 0.3}}   {"drive": null}   {"say": true}   {"call": {"data": false}}
    -> {"ready": true}  {"joined": true}  {"sent": NS}  {"matched": COUNT}
       {"heard": true, "at": NS}
       {"moved": {"linear.x": 0.3, ...}, "at": NS}  {"answer": {...}, "at": NS}

Times are nanoseconds of the monotonic clock, which all hosts of an arena share. It imports nothing
of ours: it must be there soon.
"""

from __future__ import annotations

import importlib
import json
import sys
import threading
import time
from typing import Any

LOOKS_UP_EVERY_S = 0.2


def class_of(type_name: str) -> Any:
    """The class of `std_msgs/msg/Bool`. Raises ImportError."""
    package, kind, name = type_name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


def filled(message: Any, fields: dict[str, Any]) -> Any:
    """A message with these fields; a dot leads into a field."""
    for name, value in fields.items():
        *way, last = name.split(".")
        place = message
        for step in way:
            place = getattr(place, step)
        setattr(place, last, value)
    return message


def flat(message: Any, before: str = "") -> dict[str, Any]:
    """All fields of a message, by names with dots."""
    found: dict[str, Any] = {}
    for name in message.get_fields_and_field_types():
        value = getattr(message, name)
        deeper = hasattr(value, "get_fields_and_field_types")
        found |= flat(value, f"{before}{name}.") if deeper else {f"{before}{name}": value}
    return found


class Player:
    """One node with what it was asked to be."""

    def __init__(self, plan: dict[str, Any]) -> None:
        """Each part of `plan` has a topic or service, its type, and its times in seconds."""
        from rclpy.node import Node
        from rclpy.parameter import Parameter

        plain = [Parameter("start_type_description_service", value=False)]
        self.node = Node(
            plan["name"],
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=plain,
        )
        self._telling = threading.Lock()
        self._command: Any = None
        for part in ("commands", "button", "motors", "joiner", "client"):
            if part in plan:
                getattr(self, f"_be_{part}")(plan[part])
        self.tell({"ready": True})

    def tell(self, words: dict[str, Any]) -> None:
        """One line to whoever began this."""
        with self._telling:
            print(json.dumps(words), flush=True)

    def obey(self, words: dict[str, Any]) -> None:
        """Do what a line says."""
        if "drive" in words:
            fields = words["drive"]
            self._command = None if fields is None else filled(self._kind(), fields)
        if "say" in words:
            self._button.publish(filled(self._button_kind(), words["say"]))
        if "call" in words:
            request = filled(self._client_kind.Request(), words["call"])
            self._client.call_async(request).add_done_callback(self._answered)

    # --- what it can be ------------------------------------------------------------------------

    def _be_commands(self, plan: dict[str, Any]) -> None:
        """Commands, at a rate, as long as there is one."""
        self._kind = class_of(plan["type"])
        self._commands = self.node.create_publisher(
            self._kind, plan["topic"], _profile(plan, depth=10), event_callbacks=_no_events("pub")
        )
        self._matched = 0
        self.node.create_timer(1 / plan["hz"], self._send)

    def _send(self) -> None:
        command = self._command  # who tells us to be silent does it from another thread
        if command is not None:
            self.tell({"sent": time.monotonic_ns()})
            self._commands.publish(command)
        matched = self._commands.get_subscription_count()
        if matched != self._matched:
            self._matched = matched
            self.tell({"matched": matched})

    def _be_button(self, plan: dict[str, Any]) -> None:
        """A latched topic, with a sign of life."""
        self._button_kind = class_of(plan["type"])
        profile = _profile(plan, depth=1, latched=True)
        self._button = self.node.create_publisher(
            self._button_kind, plan["topic"], profile, event_callbacks=_no_events("pub")
        )
        self._alone = self.node.create_timer(0.05, self._look_for_subscription)

    def _look_for_subscription(self) -> None:
        if self._button.get_subscription_count():
            self._alone.cancel()
            self.tell({"joined": True})

    def _be_motors(self, plan: dict[str, Any]) -> None:
        """Who does what the last command says."""
        profile = _profile(plan, depth=100)
        self.node.create_subscription(
            class_of(plan["type"]),
            plan["topic"],
            self._move,
            profile,
            event_callbacks=_no_events("sub"),
        )

    def _move(self, message: Any) -> None:
        self.tell({"moved": flat(message), "at": time.monotonic_ns()})

    def _be_joiner(self, plan: dict[str, Any]) -> None:
        """Who comes late to a latched topic."""
        profile = _profile(plan, depth=100, latched=True)
        self.node.create_subscription(
            class_of(plan["type"]),
            plan["topic"],
            self._hear,
            profile,
            event_callbacks=_no_events("sub"),
        )

    def _hear(self, message: Any) -> None:
        self.tell({"heard": flat(message), "at": time.monotonic_ns()})

    def _be_client(self, plan: dict[str, Any]) -> None:
        """Who presses: a client of a service."""
        self._client_kind = class_of(plan["type"])
        self._client = self.node.create_client(self._client_kind, plan["service"])
        self._served = self.node.create_timer(0.05, self._look_for_server)

    def _look_for_server(self) -> None:
        if self._client.service_is_ready():
            self._served.cancel()
            self.tell({"served": True})

    def _answered(self, future: Any) -> None:
        self.tell({"answer": flat(future.result()), "at": time.monotonic_ns()})


def _no_events(side: str) -> Any:
    """What does not fit together is seen elsewhere; rclpy's own words would be taken for ours."""
    from rclpy import event_handler

    name = "PublisherEventCallbacks" if side == "pub" else "SubscriptionEventCallbacks"
    return getattr(event_handler, name)(use_default_callbacks=False)


def _profile(plan: dict[str, Any], depth: int, latched: bool = False) -> Any:
    """Reliable, with the times that the plan names."""
    from rclpy.duration import Duration
    from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSProfile

    times = {
        word: Duration(seconds=plan[key])
        for word, key in (("deadline", "deadline_s"), ("liveliness_lease_duration", "lease_s"))
        if plan.get(key)
    }
    kept = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
    alive = LivelinessPolicy[plan.get("liveliness", "automatic").upper()]
    return QoSProfile(depth=depth, durability=kept, liveliness=alive, **times)


def main(plan: dict[str, Any]) -> None:
    """Play until nobody tells us anything any more, or Ctrl-C.

    It looks up now and then: once, one that waited was not seen to end by Ctrl-C alone.
    """
    import rclpy
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

    rclpy.init(args=["--ros-args", "--disable-external-lib-logs"])
    player = Player(plan)

    def listen() -> None:
        for line in sys.stdin:
            player.obey(json.loads(line))
        rclpy.try_shutdown()

    threading.Thread(target=listen, daemon=True).start()
    executor = SingleThreadedExecutor()
    executor.add_node(player.node)
    try:
        while rclpy.ok():
            executor.spin_once(timeout_sec=LOOKS_UP_EVERY_S)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))
