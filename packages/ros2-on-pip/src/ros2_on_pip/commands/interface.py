"""`ros2 interface`: the types of messages, services and actions."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2_on_pip.interfaces import KINDS
from ros2_on_pip.shared_options import complete_packages
from ros2_on_pip.words import OK, Verbs, add

TITLES = {"msg": "Messages:", "srv": "Services:", "action": "Actions:"}


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    listing = verbs("list", "List all interface types available", list_all)
    _only_options(listing, "Print out only the {} types")
    show = verbs("show", "Output the interface definition", show_text)
    _type_name(show, "'-' reads it from standard input: ros2 topic type /x | ros2 interface show -")
    comments = show.add_mutually_exclusive_group()
    comments.add_argument("--all-comments", action="store_true", help="Show comments of all types")
    comments.add_argument("--no-comments", action="store_true", help="Show no comments")
    proto = verbs("proto", "Output an interface prototype", show_prototype)
    _type_name(proto)
    proto.add_argument(
        "--no-quotes", action="store_true", help="If true output has no outer quotes"
    )
    package = verbs(
        "package", "Output a list of available interface types within one package", list_package
    )
    add(package, "package_name", complete=complete_packages, help="Name of the ROS package")
    _only_options(package, "Print out only the {} types")
    packages = verbs("packages", "Output a list of packages that provide interfaces", list_packages)
    _only_options(packages, "Print out only packages with {} types")


def _only_options(parser: argparse.ArgumentParser, about: str) -> None:
    """`--only-msgs` and its kin."""
    for kind, what in KINDS.items():
        parser.add_argument(
            f"-{kind[0]}",
            f"--only-{kind}s",
            dest="only",
            action="append_const",
            const=kind,
            help=about.format(what),
        )


def _type_name(parser: argparse.ArgumentParser, more: str = "") -> None:
    add(
        parser,
        "type",
        complete=complete_all,
        action=Piped if more else "store",
        help=f"Name of the ROS type (e.g. 'std_msgs/msg/String'). {more}".strip(),
    )


class Piped(argparse.Action):
    """A word that may come from another command: `-` is the next line of standard input."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Keep it; a terminal has nothing to read, and nothing may have come."""
        if values == "-":
            if sys.stdin.isatty():
                parser.error("expected stdin pipe: ros2 topic type /x | ros2 interface show -")
            values = sys.stdin.readline().strip()
        if not values:
            parser.error("the passed value is empty: the command before found no type")
        setattr(namespace, self.dest, values)


def complete_all(**_: Any) -> list[str]:
    """Every installed type, for the Tab key."""
    from ros2_on_pip.interfaces import installed

    return installed()


def _chosen(options: argparse.Namespace) -> list[str]:
    """Every installed type of the kinds in `options`."""
    from ros2_on_pip.interfaces import installed

    kinds = options.only or KINDS
    return [name for name in installed() if name.split("/")[1] in kinds]


def list_all(options: argparse.Namespace) -> int:
    """`ros2 interface list`."""
    names = _chosen(options)
    for kind in options.only or TITLES:
        print(TITLES[kind])
        print("".join(f"    {name}\n" for name in names if f"/{kind}/" in name), end="")
    return OK


def list_package(options: argparse.Namespace) -> int:
    """`ros2 interface package PACKAGE`."""
    from ros2_on_pip.packages import prefix_of

    prefix_of(options.package_name)
    for name in _chosen(options):
        if name.startswith(f"{options.package_name}/"):
            print(name)
    return OK


def list_packages(options: argparse.Namespace) -> int:
    """`ros2 interface packages`."""
    print("\n".join(sorted({name.partition("/")[0] for name in _chosen(options)})))
    return OK


def show_text(options: argparse.Namespace) -> int:
    """`ros2 interface show TYPE`."""
    from ros2_on_pip.interface_text import Comments, shown_lines

    comments = Comments.TOP
    if options.all_comments:
        comments = Comments.ALL
    elif options.no_comments:
        comments = Comments.NONE
    print("\n".join(shown_lines(_whole(options.type), comments)))
    return OK


def show_prototype(options: argparse.Namespace) -> int:
    """`ros2 interface proto TYPE`."""
    from ros2_on_pip.interfaces import empty_message
    from ros2_on_pip.yaml_out import YamlOptions, as_yaml

    text = as_yaml(empty_message(_whole(options.type)), YamlOptions(longest=None))
    print(text if options.no_quotes else f'"{text}"')
    return OK


def _whole(typed: str) -> str:
    """The type's whole name; a word is said where a part was left out. Raises UnknownInterface."""
    from ros2_on_pip.habits import full_type
    from ros2_on_pip.interfaces import file_of, full_name

    return full_type(typed, full_name(typed, file_of(typed).parent.name))
