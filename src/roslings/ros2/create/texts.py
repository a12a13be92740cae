"""The files of a new ament_python package, laid out as Jazzy's `ros2 pkg create` lays them out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

TEST_DEPENDENCIES = ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest")


@dataclass(frozen=True)
class Wish:
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


def files_of(wish: Wish) -> Iterator[tuple[str, str]]:
    """Path inside the package and text of every file, in the order in which they are written.

    A path that ends in a slash is a folder.
    """
    name = wish.package
    yield "package.xml", package_xml(wish)
    yield f"{name}/", ""
    yield "setup.py", setup_py(wish)
    yield "setup.cfg", setup_cfg(wish)
    yield f"resource/{name}", ""
    yield f"{name}/__init__.py", ""
    yield "test/test_copyright.py", copyright_test()
    yield "test/test_flake8.py", flake8_test()
    yield "test/test_pep257.py", pep257_test()
    if wish.node:
        yield f"{name}/{wish.node}.py", node_py(wish)
    if wish.library:
        yield f"{name}/{wish.library}/__init__.py", ""


def package_xml(wish: Wish) -> str:
    """The manifest."""
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="http://download.ros.org/schema/package_format{wish.format}.xsd"'
        ' schematypens="http://www.w3.org/2001/XMLSchema"?>',
        f'<package format="{wish.format}">',
        f"  <name>{wish.package}</name>",
        "  <version>0.0.0</version>",
        f"  <description>{escape(wish.description)}</description>",
        f"  <maintainer email={quoteattr(wish.email)}>{escape(wish.maintainer)}</maintainer>",
        f"  <license>{escape(wish.license)}</license>",
        "",
        *(f"  <depend>{escape(name)}</depend>" for name in wish.dependencies),
        *([""] if wish.dependencies else []),
        *(f"  <test_depend>{name}</test_depend>" for name in TEST_DEPENDENCIES),
        "",
        "  <export>",
        "    <build_type>ament_python</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def setup_py(wish: Wish) -> str:
    """The build; one entry point for the node."""
    entry = f"            '{wish.node} = {wish.package}.{wish.node}:main',\n" if wish.node else ""
    return f"""from setuptools import find_packages, setup

package_name = '{wish.package}'

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
    maintainer={wish.maintainer!r},
    maintainer_email={wish.email!r},
    description={wish.description!r},
    license={wish.license!r},
    entry_points={{
        'console_scripts': [
{entry}        ],
    }},
)
"""


def setup_cfg(wish: Wish) -> str:
    """Where `ros2 run` looks for the executables."""
    place = f"$base/lib/{wish.package}"
    return f"[develop]\nscript_dir={place}\n[install]\ninstall_scripts={place}\n"


def node_py(wish: Wish) -> str:
    """The empty executable."""
    return f"""def main():
    print('Hi from {wish.package}.')


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
