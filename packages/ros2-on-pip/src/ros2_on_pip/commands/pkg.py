"""`ros2 pkg`: which packages there are, and making a new one."""

from __future__ import annotations

import argparse
from typing import Any

from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import complete_packages
from ros2_on_pip.words import OK, Verbs, add

BUILD_TYPES = ("ament_python", "ament_cmake", "cmake")


class NoTag(CommandProblem):
    """The package.xml does not say that."""

    def __init__(self, package: str, tag: str, there: list[str]) -> None:
        names = sorted(set(there))
        super().__init__(
            f"The package.xml of '{package}' has no <{tag}>.{did_you_mean(tag, names)}"
            f" It has: {', '.join(names)}"
        )


class NoManifest(CommandProblem):
    """The package was installed without its package.xml, or it comes with roslings."""

    def __init__(self, package: str) -> None:
        super().__init__(
            f"'{package}' has no package.xml here. If it is yours, add it to data_files in"
            " setup.py and build again: colcon build"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    _declare_create(verbs("create", "Create a new ROS 2 package", create))
    verbs("list", "Output a list of available packages", list_packages)
    programs = verbs("executables", "Output a list of package specific executables", executables)
    add(programs, "package_name", nargs="?", complete=complete_packages, help="The package name")
    programs.add_argument(
        "--full-path", action="store_true", help="Show full path of each executable"
    )
    prefix = verbs("prefix", "Output the prefix path of a package", show_prefix)
    add(prefix, "package_name", complete=complete_packages, help="The package name")
    prefix.add_argument("--share", action="store_true", help="Show share directory for the package")
    xml = verbs("xml", "Output the XML of the package manifest or a specific tag", show_xml)
    add(xml, "package_name", complete=complete_packages, help="The package name")
    xml.add_argument("-t", "--tag", help="The XML tag to output, e.g. version")


def _declare_create(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("package_name", help="The package name")
    parser.add_argument(
        "--package-format",
        "--package_format",
        type=int,
        default=3,
        choices=(2, 3),
        help="The package.xml format",
    )
    parser.add_argument(
        "--description",
        default="TODO: Package description",
        help="The description given in the package.xml",
    )
    parser.add_argument(
        "--license",
        default="TODO: License declaration",
        help="The license attached to this package, e.g. Apache-2.0",
    )
    parser.add_argument(
        "--destination-directory",
        default=".",
        help="Directory where to create the package directory",
    )
    parser.add_argument(
        "--build-type",
        default="ament_cmake",
        choices=BUILD_TYPES,
        help="The build type to process the package with (default: ament_cmake)",
    )
    add(
        parser,
        "--dependencies",
        nargs="+",
        default=[],
        complete=complete_packages,
        help="list of dependencies",
    )
    parser.add_argument("--maintainer-email", help="email address of the maintainer")
    parser.add_argument("--maintainer-name", help="name of the maintainer of this package")
    parser.add_argument("--node-name", help="name of the empty executable")
    parser.add_argument("--library-name", help="name of the empty library")


def create(options: argparse.Namespace) -> int:
    """`ros2 pkg create NAME`."""
    from ros2_on_pip.create.package import create_package

    return create_package(options)


def list_packages(_: argparse.Namespace) -> int:
    """`ros2 pkg list`."""
    from ros2_on_pip.packages import packages

    print("\n".join(sorted(packages())))
    return OK


def executables(options: argparse.Namespace) -> int:
    """`ros2 pkg executables [PACKAGE]`."""
    from ros2_on_pip import packages

    chosen = [options.package_name] if options.package_name else sorted(packages.packages())
    for package in chosen:
        for place in packages.executables(package):
            print(place if options.full_path else f"{package} {packages.name_of(place)}")
    return OK


def show_prefix(options: argparse.Namespace) -> int:
    """`ros2 pkg prefix PACKAGE`."""
    from ros2_on_pip.packages import prefix_of, share_of

    where: Any = share_of if options.share else prefix_of
    print(where(options.package_name))
    return OK


def show_xml(options: argparse.Namespace) -> int:
    """`ros2 pkg xml PACKAGE`."""
    from xml.etree import ElementTree

    from ros2_on_pip.packages import share_of

    manifest = share_of(options.package_name) / "package.xml"
    if not manifest.is_file():
        raise NoManifest(options.package_name)
    root = ElementTree.parse(manifest).getroot()
    if options.tag is None:
        print(ElementTree.tostring(root, encoding="unicode"))
        return OK
    found = root.findall(options.tag)
    if not found:
        raise NoTag(options.package_name, options.tag, [element.tag for element in root])
    for element in found:
        print(element.text)
    return OK
