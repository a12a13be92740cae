"""The files of a new ament_python package, laid out as Jazzy's `ros2 pkg create` lays them out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

TEST_DEPENDENCIES = ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest")
MARKS = ("copyright", "flake8", "linter", "pep257")
"""What the tests below are marked with."""


@dataclass(frozen=True)
class PackageRequest:
    """What the package shall be."""

    package: str
    format: int
    description: str
    license: str
    maintainer: str
    email: str
    dependencies: tuple[str, ...]
    node: str | None
    library: str | None


def files_of(request: PackageRequest) -> Iterator[tuple[str, str]]:
    """Path inside the package and text of every file, in the order in which they are written.

    A path that ends in a slash is a folder.
    """
    name = request.package
    yield "package.xml", package_xml(request)
    yield f"{name}/", ""
    yield "setup.py", setup_py(request)
    yield "setup.cfg", setup_cfg(request)
    yield f"resource/{name}", ""
    yield f"{name}/__init__.py", ""
    yield "test/test_copyright.py", copyright_test()
    yield "test/test_flake8.py", flake8_test()
    yield "test/test_pep257.py", pep257_test()
    if request.node:
        yield f"{name}/{request.node}.py", node_py(request)
    if request.library:
        yield f"{name}/{request.library}/__init__.py", ""


def package_xml(request: PackageRequest) -> str:
    """The manifest."""
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="http://download.ros.org/schema/package_format{request.format}.xsd"'
        ' schematypens="http://www.w3.org/2001/XMLSchema"?>',
        f'<package format="{request.format}">',
        f"  <name>{request.package}</name>",
        "  <version>0.0.0</version>",
        f"  <description>{escape(request.description)}</description>",
        f"  <maintainer email={quoteattr(request.email)}>{escape(request.maintainer)}</maintainer>",
        f"  <license>{escape(request.license)}</license>",
        "",
        *(f"  <depend>{escape(name)}</depend>" for name in request.dependencies),
        *([""] if request.dependencies else []),
        *(f"  <test_depend>{name}</test_depend>" for name in TEST_DEPENDENCIES),
        "",
        "  <export>",
        "    <build_type>ament_python</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def setup_py(request: PackageRequest) -> str:
    """The build; one entry point for the node."""
    entry = (
        f"            '{request.node} = {request.package}.{request.node}:main',\n"
        if request.node
        else ""
    )
    return f"""from setuptools import find_packages, setup

package_name = '{request.package}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    extras_require={{'test': ['pytest']}},
    zip_safe=True,
    maintainer={request.maintainer!r},
    maintainer_email={request.email!r},
    description={request.description!r},
    license={request.license!r},
    entry_points={{
        'console_scripts': [
{entry}        ],
    }},
)
"""


def setup_cfg(request: PackageRequest) -> str:
    """Where `ros2 run` looks for the executables; and the marks of the tests.

    The linters of a full ROS tell pytest their marks. Without them, pytest warns of each mark in
    five lines, and colcon shows that as an error's output.
    """
    place = f"$base/lib/{request.package}"
    folders = f"[develop]\nscript_dir={place}\n[install]\ninstall_scripts={place}\n"
    return folders + "\n    ".join(["[tool:pytest]\nmarkers =", *MARKS]) + "\n"


def node_py(request: PackageRequest) -> str:
    """The empty executable."""
    return f"""def main():
    print('Hi from {request.package}.')


if __name__ == '__main__':
    main()
"""


def copyright_test() -> str:
    """Every file names its copyright; skipped until the author wants that, and without the tool."""
    return '''"""Checks that every file names who holds its copyright."""

import pytest


@pytest.mark.skip(reason='Take this line away when your files have copyright headers.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    check = pytest.importorskip('ament_copyright.main')
    assert check.main(argv=['.', 'test']) == 0, 'Found errors'
'''


def flake8_test() -> str:
    """The style of the code."""
    return '''"""Checks the style of the code, where ament_flake8 is installed."""

import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    check = pytest.importorskip('ament_flake8.main')
    code, errors = check.main_with_errors(argv=[])
    assert code == 0, 'Found %d style errors:\\n' % len(errors) + '\\n'.join(errors)
'''


def pep257_test() -> str:
    """The style of the docstrings."""
    return '''"""Checks the style of the docstrings, where ament_pep257 is installed."""

import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    check = pytest.importorskip('ament_pep257.main')
    assert check.main(argv=['.', 'test']) == 0, 'Found style errors'
'''
