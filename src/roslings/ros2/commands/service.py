"""`ros2 service`: which services there are, and calling one."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from roslings.ros2.names import absolute
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.shared_options import (
    complete_interfaces,
    complete_services,
    count_only,
    node_options,
    show_types,
)
from roslings.ros2.words import FAILED, OK, Verbs, add, rate

if TYPE_CHECKING:
    from roslings.ros2.eye import Eye

MATCHED_WITHIN_S = 1.0
ABSENT = {"echo": "service events", "info": "clients and servers of a service"}


class OtherType(Problem):
    """The service is there, with another type than the one typed."""

    def __init__(self, service: str, typed: str, right: str) -> None:
        super().__init__(
            f"The service '{service}' has the type {right}, not {typed}."
            f" Type: ros2 service call {service} {right}"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command, ABSENT)
    listing = verbs("list", "Output a list of available services", list_services)
    show_types(listing, "service")
    count_only(listing, "services")
    kind = verbs("type", "Output a service's type", show_type)
    _service_name(kind)
    find = verbs("find", "Output a list of services of a given type", find_services)
    add(
        find, "service_type", complete=complete_interfaces("srv"),
        help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/SetBool')",
    )  # fmt: skip
    count_only(find, "services")
    for verb in (listing, find):
        verb.add_argument(
            "--include-hidden-services", "-a", action="store_true",
            help="Consider hidden services as well",
        )  # fmt: skip
    for verb in (listing, kind, find):
        node_options(verb)
    _declare_call(verbs)


def _declare_call(verbs: Verbs) -> None:
    word = verbs("call", "Call a service", call)
    _service_name(word)
    add(
        word, "service_type", complete=complete_interfaces("srv"),
        help="Type of the ROS service (e.g. 'std_srvs/srv/SetBool')",
    )  # fmt: skip
    word.add_argument(
        "values", nargs="?", default="{}",
        help="Values to fill the service request with in YAML format (e.g. '{data: true}')",
    )  # fmt: skip
    word.add_argument(
        "-r", "--rate", metavar="N", type=rate, help="Repeat the call at a specific rate in Hz"
    )


def _service_name(parser: argparse.ArgumentParser) -> None:
    add(
        parser, "service_name", complete=complete_services,
        help="Name of the ROS service (e.g. '/set_light')",
    )  # fmt: skip


def list_services(options: argparse.Namespace) -> int:
    """`ros2 service list`."""
    from roslings.ros2.eye import Eye

    with Eye() as eye:
        services = eye.settle().services(hidden=options.include_hidden_services)
    if options.count:
        print(len(services))
        return OK
    for name, types in services.items():
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return OK


def show_type(options: argparse.Namespace) -> int:
    """`ros2 service type SERVICE`."""
    from roslings.ros2.eye import Eye

    with Eye() as eye:
        services = eye.settle().services()
    types = services.get(absolute(options.service_name))
    if not types:
        near = did_you_mean(options.service_name, services)
        print(f"No node offers the service '{options.service_name}'.{near}", file=sys.stderr)
        return FAILED
    print("\n".join(types))
    return OK


def find_services(options: argparse.Namespace) -> int:
    """`ros2 service find TYPE`."""
    from roslings.ros2.eye import Eye
    from roslings.ros2.interfaces import full_name

    wanted = full_name(options.service_type, "srv")
    with Eye() as eye:
        services = eye.settle().services(hidden=options.include_hidden_services)
    names = [name for name, types in services.items() if wanted in types]
    if options.count or names:
        print(len(names) if options.count else "\n".join(names))
    return OK


def call(options: argparse.Namespace) -> int:
    """`ros2 service call SERVICE TYPE [VALUES]`."""
    from roslings.ros2.eye import Eye
    from roslings.ros2.interfaces import class_of, full_name
    from roslings.ros2.names import checked_topic
    from roslings.ros2.yaml_in import filled

    service = checked_topic(options.service_name)
    type_name = full_name(options.service_type, "srv")
    cls = class_of(type_name, "srv")
    request = cls.Request()
    filled(request, options.values)
    with Eye() as eye:
        services = eye.settle().services()  # before our own client puts its type there
        if type_name not in services.get(service, [type_name]):
            raise OtherType(service, type_name, services[service][0])
        client = eye.node.create_client(cls, service)
        _await(eye, client, service, services)
        _repeat(eye, client, request, options.rate)
    return OK


def _await(eye: Eye, client: Any, service: str, there: Iterable[str]) -> None:
    """Wait for the service; a near miss among those that are `there` is said at once."""
    if eye.until(client.service_is_ready, MATCHED_WITHIN_S if service in there else 0):
        return
    print("waiting for service to become available...")
    if service not in there and (near := did_you_mean(service, there)):
        print(f"No node offers '{service}' yet.{near}", file=sys.stderr)
    eye.until(client.service_is_ready)


def _repeat(eye: Eye, client: Any, request: Any, per_s: float | None) -> None:
    from roslings.ros2.calling import answer_of

    while True:
        print(f"requester: making request: {request!r}\n")
        answer = answer_of(eye, client.srv_name, client.call_async(request), None)
        print(f"response:\n{answer!r}\n")
        if per_s is None:
            return
        eye.until(lambda: False, 1 / per_s)
