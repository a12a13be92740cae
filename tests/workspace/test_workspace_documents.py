"""Texts that a card asks for: read as far as anybody writes by hand, whatever is in them."""

from __future__ import annotations

import shutil
from pathlib import Path

from roslings.course import lab
from roslings.workspace.documents import LARGEST_BYTES, text_of
from roslings.workspace.inspect import inspect_package
from roslings_class.result import GradingOrder

LAB = lab("black-box")
(NAME,) = LAB.card.documents


def test_the_package_shows_its_text(tmp_path: Path) -> None:
    """And nothing where there is none."""
    package = shutil.copytree(LAB.solution, tmp_path / LAB.card.package)
    text = (package / NAME).read_text("utf-8")
    assert inspect_package(package, LAB.card).documents == {NAME: text}
    (package / NAME).unlink()
    assert inspect_package(package, LAB.card).documents == {}


def test_any_bytes_become_a_text_of_a_bounded_length(tmp_path: Path) -> None:
    """What is no UTF-8 is marked."""
    file = tmp_path / "any"
    file.write_bytes(b"name: \xff" + b"x" * 10 * LARGEST_BYTES)
    assert text_of(file).startswith("name: \N{REPLACEMENT CHARACTER}x")
    assert len(text_of(file)) <= LARGEST_BYTES


def test_a_reader_of_bags_names_its_package(tmp_path: Path) -> None:
    """With the real rosbag2 and with ours: the verdict on package.xml is the same."""
    package = shutil.copytree(LAB.solution, tmp_path / LAB.card.package)
    assert "rosbag2_py" in inspect_package(package, LAB.card, frozenset()).imported


def test_only_what_was_handed_in_has_a_name() -> None:
    """A lab's own packages are called after what is wrong with them."""
    order = GradingOrder(
        lab="topics", submission="ada", digest="", attempt=1, path=Path(), room=Path(), seed=0
    )
    assert order.handed_in_as == "ada"
    assert order.model_copy(update={"builds_from_cache": True}).handed_in_as == ""
