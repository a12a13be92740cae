"""`ros2 service`: which services there are, and calling one."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ros2_on_pip.habits import full_topic, full_type
from ros2_on_pip.problem import CommandProblem, ServiceNotThere, did_you_mean
from ros2_on_pip.qos import add_qos_options
from ros2_on_pip.shared_options import (
    DIRECT,
    also_hidden,
    complete_interfaces,
    complete_services,
    complete_type_of,
    complete_values,
    count_only,
    hidden_services,
    node_options,
    shape_options,
    show_types,
    stdin_option,
    values_in,
)
from ros2_on_pip.words import FAILED, OK, Verbs, add, rate

if TYPE_CHECKING:
    from ros2_on_pip.discovery import DirectNode

MATCHED_WITHIN_S = 1.0


class OtherServiceType(CommandProblem):
    """The service is there, with another type than the one typed."""

    def __init__(self, service: str, typed: str, right: str) -> None:
        super().__init__(
            f"The service '{service}' has the type {right}, not {typed}."
            f" Type: ros2 service call {service} {right}"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    hidden_services(command)
    verbs = Verbs(command)
    listing = verbs("list", "Output a list of available services", list_services)
    show_types(listing, "service")
    count_only(listing, "services")
    kind = verbs("type", "Output a service's type", show_type)
    _service_name(kind)
    find = verbs("find", "Output a list of services of a given type", find_services)
    add(
        find,
        "service_type",
        complete=complete_interfaces("srv"),
        help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/SetBool')",
    )
    count_only(find, "services")
    info = verbs("info", "Print information about a service", show_info)
    _service_name(info)
    for verb in (listing, find):
        also_hidden(verb, "services", "-a")
    for verb in (listing, kind, info):
        node_options(verb)
    node_options(find, only_here=(*DIRECT, "no_daemon"))
    _declare_call(verbs)
    _declare_echo(verbs)


def _declare_call(verbs: Verbs) -> None:
    word = verbs("call", "Call a service", call)
    _service_name(word)
    add(
        word,
        "service_type",
        complete=complete_type_of("service", "srv"),
        help="Type of the ROS service (e.g. 'std_srvs/srv/SetBool')",
    )
    values = word.add_mutually_exclusive_group()
    add(
        values,
        "values",
        nargs="?",
        default="{}",
        complete=complete_values("service_type"),
        help="Values to fill the service request with in YAML format (e.g. '{data: true}')",
    )
    stdin_option(values, "the values")
    word.add_argument(
        "-r", "--rate", metavar="N", type=rate, help="Repeat the call at a specific rate in Hz"
    )
    node_options(word, daemon=False, only_here=DIRECT)


def _declare_echo(verbs: Verbs) -> None:
    word = verbs("echo", "Echo a service", echo)
    _service_name(word)
    add(
        word,
        "service_type",
        nargs="?",
        complete=complete_type_of("service", "srv"),
        help="Type of the ROS service (e.g. 'std_srvs/srv/SetBool')",
    )
    shape_options(word)
    add_qos_options(word, "listen")
    node_options(word, only_here=(*DIRECT, "no_daemon"))


def _service_name(parser: argparse.ArgumentParser) -> None:
    add(
        parser,
        "service_name",
        complete=complete_services,
        help="Name of the ROS service (e.g. '/set_light')",
    )


def list_services(options: argparse.Namespace) -> int:
    """`ros2 service list`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        services = direct_node.settle().services(hidden=options.include_hidden_services)
    if options.count:
        print(len(services))
        return OK
    for name, types in services.items():
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return OK


def show_type(options: argparse.Namespace) -> int:
    """`ros2 service type SERVICE`."""
    from ros2_on_pip.discovery import DirectNode

    with DirectNode.asked_by(options) as direct_node:
        services = direct_node.settle().services()
    types = services.get(full_topic(options.service_name))
    if not types:
        near = did_you_mean(options.service_name, services)
        print(f"No node offers the service '{options.service_name}'.{near}", file=sys.stderr)
        return FAILED
    print("\n".join(types))
    return OK


def find_services(options: argparse.Namespace) -> int:
    """`ros2 service find TYPE`."""
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.interfaces import full_name

    wanted = full_type(options.service_type, full_name(options.service_type, "srv"))
    with DirectNode.asked_by(options) as direct_node:
        services = direct_node.settle().services(hidden=options.include_hidden_services)
    names = [name for name, types in services.items() if wanted in types]
    if options.count or names:
        print(len(names) if options.count else "\n".join(names))
    return OK


def show_info(options: argparse.Namespace) -> int:
    """`ros2 service info SERVICE`."""
    from ros2_on_pip.discovery import DirectNode

    name = full_topic(options.service_name)
    with DirectNode.asked_by(options) as direct_node:
        services = direct_node.settle().services()
        if name not in services:
            raise ServiceNotThere(name, services)
        clients, servers = (
            direct_node.graph.count_clients(name),
            direct_node.graph.count_services(name),
        )
    types = services[name]
    print(f"Type: {types[0] if len(types) == 1 else types}")
    print(f"Clients count: {clients}\nServices count: {servers}")
    return OK


def echo(options: argparse.Namespace) -> int:
    """`ros2 service echo SERVICE [TYPE]`."""
    from ros2_on_pip.service_events import echo as echo_events

    return echo_events(options)


def call(options: argparse.Namespace) -> int:
    """`ros2 service call SERVICE TYPE [VALUES]`."""
    from ros2_on_pip.discovery import DirectNode
    from ros2_on_pip.interfaces import class_of, full_name
    from ros2_on_pip.names import checked_topic
    from ros2_on_pip.yaml_in import filled

    service = checked_topic(options.service_name)
    type_name = full_name(options.service_type, "srv")
    cls = class_of(type_name, "srv")
    request = cls.Request()
    filled(request, values_in(options, options.values))
    with DirectNode.asked_by(options, speaks=True) as direct_node:
        services = direct_node.settle().services()  # before our own client puts its type there
        if type_name not in services.get(service, [type_name]):
            raise OtherServiceType(service, type_name, services[service][0])
        client = direct_node.node.create_client(cls, service)
        _await(direct_node, client, service, services)
        _repeat(direct_node, client, request, options.rate)
    return OK


def _await(direct_node: DirectNode, client: Any, service: str, there: Iterable[str]) -> None:
    """Wait for the service; a near miss among those that are `there` is said at once."""
    if direct_node.until(client.service_is_ready, MATCHED_WITHIN_S if service in there else 0):
        return
    print("waiting for service to become available...")
    if service not in there and (near := did_you_mean(service, there)):
        print(f"No node offers '{service}' yet.{near}", file=sys.stderr)
    direct_node.until(client.service_is_ready)


def _repeat(direct_node: DirectNode, client: Any, request: Any, per_s: float | None) -> None:
    from ros2_on_pip.calling import answer_of

    while True:
        print(f"requester: making request: {request!r}\n")
        answer = answer_of(direct_node, client.srv_name, client.call_async(request), None)
        print(f"response:\n{answer!r}\n")
        if per_s is None:
            return
        direct_node.until(lambda: False, 1 / per_s)
