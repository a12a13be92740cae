"""`ros2 service echo`: what is asked and answered, where client or server tell of it."""

from __future__ import annotations

import argparse
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.echoing import shape_in
from ros2_on_pip.interfaces import class_of
from ros2_on_pip.names import checked_topic
from ros2_on_pip.problem import ServiceNotThere
from ros2_on_pip.words import OK
from ros2_on_pip.yaml_out import YamlOptions, as_csv, dumped, plain_of

SUFFIX = "/_service_event"
"""The hidden topic on which a client or server tells, once `configure_introspection` is called."""


def echo(options: argparse.Namespace) -> int:
    """Print the events of the service in `options`, until Ctrl-C."""
    service = checked_topic(options.service_name)
    with DirectNode.asked_by(options) as direct_node:
        cls = class_of(options.service_type or _type_of(direct_node, service), "srv")
        direct_node.settle()
        topic, shape = f"{service}{SUFFIX}", shape_in(options)
        direct_node.node.create_subscription(
            cls.Event,
            topic,
            lambda event: print(_text(event, shape, options.csv)),
            qos.chosen(options, "services_default"),
        )
        if not direct_node.publishers(topic):
            print(
                f"No publishers on topic '{topic}';"
                " is service introspection on the client or server enabled?"
            )
        direct_node.until(lambda: False)
    return OK


def _type_of(direct_node: DirectNode, service: str) -> str:
    """Raises ServiceNotThere."""
    services = direct_node.settle().services()
    if service not in services:
        raise ServiceNotThere(service, services)
    return services[service][0]


def _text(event: Any, shape: YamlOptions, csv: bool) -> str:
    if csv:
        return as_csv(event, shape)
    plain = plain_of(event, shape)
    plain["info"]["event_type"] = _word_for(event.info)
    return f"{dumped(plain, shape.flow)}---"


def _word_for(info: Any) -> str:
    """The name of the event's constant in service_msgs/msg/ServiceEventInfo."""
    words = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")
    return next((word for word in words if getattr(info, word) == info.event_type), "UNKNOWN")
