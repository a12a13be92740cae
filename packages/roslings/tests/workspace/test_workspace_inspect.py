"""What stands in a package's files, read without running any of them."""

from __future__ import annotations

import zlib
from pathlib import Path

import pytest
from PIL import Image

from roslings.course import Card, Lab
from roslings.evidence import PackageSeen
from roslings.workspace.errors import PictureTooLarge
from roslings.workspace.inspect import inspect_package, ros_packages
from written_png import head_of, png_of

KNOWN = frozenset({"rclpy", "std_msgs", "sensor_msgs"})
FIGURE = "figures/day3_rqt_graph.png"


def look(package: Path, card: Card) -> PackageSeen:
    """Inspect, with a fixed set of ROS packages."""
    return inspect_package(package, card, KNOWN)


def change(path: Path, old: str, new: str) -> None:
    """Replace a text that stands in a file."""
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), "utf-8")


def test_the_solution_has_nothing_wrong(topics: Lab) -> None:
    """And all that a check asks for."""
    seen = look(topics.solution, topics.card)
    assert (seen.name, seen.folder, seen.build_type) == ("chatter", "chatter", "ament_python")
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    assert set(seen.imported) == set(seen.declared) == {"rclpy", "std_msgs"}
    assert seen.entry_points == {
        "talker": "chatter.talker:main",
        "listener": "chatter.listener:main",
    }
    assert seen.pictures[FIGURE].format == "PNG"
    assert seen.pictures[FIGURE].colours > 1


def test_crlf_and_a_byte_order_mark_are_no_fault(package: Path, card: Card) -> None:
    """Files made on Windows."""
    for path in (*package.rglob("*.py"), package / "package.xml", package / "setup.cfg"):
        path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    seen = look(package, card)
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    assert set(seen.imported) == {"rclpy", "std_msgs"}
    assert set(seen.entry_points) == {"talker", "listener"}


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("learner@example.com", "learner at example.com", "invalid email"),
        ("0.1.0</version>", "0.1.0", "package.xml:4: the tag <version> is not closed"),
        ("</package>", "", "package.xml:2: the tag <package> is not closed"),
        ("<description>", "<description> & ", "package.xml:5: not well-formed (invalid token)"),
        ("<version>0.1.0</version>", "<version>one</version>", "version conventions"),
        ("<license>Apache-2.0</license>", "", "license"),
        ('format="3"', 'format="three"', "package.xml: "),
        ("<package format", "<!DOCTYPE x [<!ENTITY a 'b'>]>\n<package format", "DOCTYPE"),
        ("Apache-2.0", "Apache-2.0</license><!-- <name>x</name>", "package.xml:7: unclosed token"),
        ("<name>chatter<", "<name>chater<", "package.xml says the name is chater"),
    ],
)
def test_each_problem_of_package_xml_is_named(
    package: Path, card: Card, old: str, new: str, problem: str
) -> None:
    """With its line, where it has one; the other facts are still found."""
    change(package / "package.xml", old, new)
    seen = look(package, card)
    assert any(problem in said for said in seen.xml_problems), seen.xml_problems
    assert seen.build_type == "ament_python"
    assert {"rclpy", "std_msgs"} <= set(seen.declared)


def test_package_xml_that_is_no_text(package: Path, card: Card) -> None:
    """Latin-1."""
    change(package / "package.xml", "A learner", "Zoë")
    text = (package / "package.xml").read_text("utf-8")
    (package / "package.xml").write_bytes(text.encode("latin-1"))
    assert look(package, card).xml_problems == [
        "package.xml:6: this is no UTF-8 text; save the file as UTF-8"
    ]


@pytest.mark.parametrize(
    ("file", "old", "new", "problem"),
    [
        ("setup.py", "package_name = 'chatter'", "package_name = 'chater'", "setup.py says"),
        ("setup.cfg", "[install]\n", "[instal]\n", "no folder for executables under [install]"),
        (
            "setup.cfg",
            "install_scripts=$base/lib/chatter",
            "install_scripts=$base/bin",
            "$base/bin",
        ),
        ("setup.cfg", "[develop]", "develop", "setup.cfg cannot be read"),
    ],
)
def test_files_that_disagree_are_named(
    package: Path, card: Card, file: str, old: str, new: str, problem: str
) -> None:
    """package.xml, setup.py and setup.cfg say the same name."""
    change(package / file, old, new)
    assert any(problem in said for said in look(package, card).xml_problems)


@pytest.mark.parametrize(
    "name", ["setup.py", "setup.cfg", "resource/chatter", "chatter/__init__.py"]
)
def test_a_missing_file_is_named(package: Path, card: Card, name: str) -> None:
    """Each file that every ament_python package has."""
    (package / name).unlink()
    assert look(package, card).missing_files == [name]


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (b"def f(self)\n    pass\n", ":1: expected ':'"),
        (b"x = 1\nreturn x\n", ":2: 'return' outside function"),
        (b"x = 'Zo\xeb'\n", ":1: "),
        (b"x = 1\0\n", ":1: "),
        (b"(" * 5000, ":1: "),
        (b"x = -" + b"-" * 200_000 + b"1", ":1: "),
        (b"#" * 2_000_000, ":1: the file has 2,000,000 bytes"),
    ],
)
def test_what_python_cannot_read_is_named(
    package: Path, card: Card, content: bytes, problem: str
) -> None:
    """File, line and Python's own words; the other files are read."""
    (package / "chatter" / "talker.py").write_bytes(content)
    seen = look(package, card)
    [said] = seen.syntax_errors
    assert said.startswith(f"chatter/talker.py{problem}")
    assert seen.imported["rclpy"].startswith("chatter/listener.py")


def test_a_broken_setup_py_is_named(package: Path, card: Card) -> None:
    """Its entry points are then not known."""
    change(package / "setup.py", "setup(", "setup((")
    seen = look(package, card)
    assert seen.syntax_errors[0].startswith("setup.py:")
    assert seen.entry_points == {}


def test_imports_are_found_where_they_stand(package: Path, card: Card) -> None:
    """In functions and submodules; not in tests, not relative ones, not what is no ROS package."""
    code = "import os, numpy\nfrom . import talker\ndef f():\n    import sensor_msgs.msg as s\n"
    (package / "chatter" / "deep").mkdir()
    (package / "chatter" / "deep" / "more.py").write_text(code)
    (package / "test").mkdir()
    (package / "test" / "test_it.py").write_text("import nav_msgs\n")
    seen = inspect_package(package, card, KNOWN | {"nav_msgs", "chatter"})
    assert set(seen.imported) == {"rclpy", "std_msgs", "sensor_msgs"}
    assert seen.imported["sensor_msgs"] == "chatter/deep/more.py:4"


def test_libraries_that_no_ros_package_brings_have_names_of_their_own(
    package: Path, card: Card
) -> None:
    """OpenCV and pyserial, as rosdep calls them."""
    (package / "chatter" / "more.py").write_text("import cv2\nfrom serial import Serial\n")
    seen = look(package, card)
    assert seen.imported["python3-opencv"] == "chatter/more.py:1"
    assert seen.imported["python3-serial"] == "chatter/more.py:2"


def test_nothing_of_the_package_is_run(package: Path, card: Card, tmp_path: Path) -> None:
    """Not setup.py, not a module, not at import."""
    trap = f"open({str(tmp_path / 'trap')!r}, 'w')\n"
    for path in (package / "setup.py", package / "chatter" / "__init__.py"):
        path.write_text(trap + path.read_text())
    look(package, card)
    assert not (tmp_path / "trap").exists()


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        ("'talker = chatter.talker:main'", "f'talker={package_name}.talker:main'", 2),
        ("'talker = chatter.talker:main'", "'talker = ' + package_name + '.talker:main'", 2),
        ("'talker = chatter.talker:main'", "make('talker')", 1),
        ("'console_scripts': [", "**{}, 'console_scripts': [", 2),
        ("entry_points={", "entry_points=dict() or {", 0),
    ],
)
def test_entry_points_are_read_as_far_as_they_are_plain(
    package: Path, card: Card, old: str, new: str, found: int
) -> None:
    """What setup.py computes is not guessed."""
    change(package / "setup.py", old, new)
    assert len(look(package, card).entry_points) == found


def test_the_ros_packages_of_this_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Those that have a package.xml under a prefix, wherever the prefix is."""
    share = tmp_path / "with space" / "share"
    (share / "my_msgs").mkdir(parents=True)
    (share / "my_msgs" / "package.xml").touch()
    (share / "man").mkdir()
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/gone::{share.parent}")
    found = ros_packages()
    assert "my_msgs" in found
    assert "man" not in found


# --- pictures ---------------------------------------------------------------------------------


def test_no_picture_is_no_entry(package: Path, card: Card) -> None:
    """A folder of that name is no picture either."""
    (package / FIGURE).unlink()
    assert look(package, card).pictures == {}
    (package / FIGURE).mkdir()
    assert look(package, card).pictures == {}


@pytest.mark.parametrize("mode", ["1", "L", "P", "RGB", "RGBA", "I;16"])
def test_one_colour_is_counted_as_one(package: Path, card: Card, mode: str) -> None:
    """In every kind of PNG."""
    Image.new(mode, (300, 250)).save(package / FIGURE)
    seen = look(package, card).pictures[FIGURE]
    assert (seen.format, seen.width, seen.height, seen.colours) == ("PNG", 300, 250, 1)


def test_another_format_under_the_name_of_png(package: Path, card: Card) -> None:
    """Renaming makes no PNG."""
    Image.new("RGB", (300, 250)).save(package / FIGURE, "JPEG")
    assert look(package, card).pictures[FIGURE].format == "JPEG"


@pytest.mark.parametrize("content", [b"", b"not an image", b"\x89PNG\r\n\x1a\n", b"%!PS-Adobe"])
def test_what_is_no_image_has_no_format(package: Path, card: Card, content: bytes) -> None:
    """Empty, a text, the beginning of a PNG, a PostScript program."""
    (package / FIGURE).write_bytes(content)
    assert look(package, card).pictures[FIGURE].format is None


def test_half_a_picture_is_none(package: Path, card: Card) -> None:
    """A download that broke off."""
    content = (package / FIGURE).read_bytes()
    (package / FIGURE).write_bytes(content[: len(content) // 2])
    assert look(package, card).pictures[FIGURE].format is None


def test_a_bomb_is_refused(package: Path, card: Card) -> None:
    """A few bytes that claim a picture of ten thousand million pixels."""
    chunks = head_of(100_000, 100_000), (b"IDAT", zlib.compress(b"")), (b"IEND", b"")
    (package / FIGURE).write_bytes(png_of(*chunks))
    with pytest.raises(PictureTooLarge, match=r"100000 x 100000 pixels.* limit is 20 million"):
        look(package, card)
