"""What the doctor says: every text is plain, every check has its tests, its page, its place."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

from ros_doctor.pages import page_of
from ros_doctor.registry import DoctorCheck, UnknownCheck, all_checks, find_check

HERE = Path(__file__).parent
ROWS = range(1, 31)
CHECKS = all_checks()
IDS = [check.id for check in CHECKS]
DAYS = "install|nodes|topics|services|actions|serial-bridge|pi-camera"


def test_every_known_trouble_of_beginners_has_a_check() -> None:
    """The 30 rows of what trips ROS 2 beginners; each check says which rows it covers."""
    assert {row for check in CHECKS for row in check.rows} == set(ROWS)


@cache
def written_tests() -> set[str]:
    names: set[str] = set()
    for path in HERE.glob("test_*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names |= {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    return names


@pytest.mark.parametrize("kind", ["ill", "well"])
@pytest.mark.parametrize("id", IDS)
def test_every_check_has_a_test_that_produces_it_and_one_that_does_not(kind: str, id: str) -> None:
    assert f"test_{kind}_{id.replace('-', '_')}" in written_tests()


@pytest.mark.parametrize("check", CHECKS, ids=IDS)
def test_every_check_says_all_it_must(check: DoctorCheck) -> None:
    assert re.fullmatch(r"[a-z][a-z0-9-]{1,17}", check.id)
    assert 8 <= len(check.title) <= 58
    assert check.looks_at
    assert check.symptom.endswith(".")
    page = rf"(days/0[1-7]-({DAYS})(/[a-z-]+)?|site/pages/reference/[a-z-]+)"
    assert re.fullmatch(rf"{page}#[a-z0-9-]+", check.lesson)
    assert len(page_of(check)) > 100


@pytest.mark.parametrize("check", CHECKS, ids=IDS)
def test_texts_are_plain(check: DoctorCheck) -> None:
    text = " ".join((check.title, check.symptom, check.looks_at, page_of(check)))
    assert "!" not in text
    assert not re.search(r"\b(please|simply|just|obviously|easy|easily)\b", text, re.I)
    for sentence in re.split(r"(?<=[.:?])\s+", page_of(check)):
        assert len(sentence.split()) <= 25, sentence


def test_causes_stand_before_their_consequences() -> None:
    for check in CHECKS:
        assert all(IDS.index(need) < IDS.index(check.id) for need in check.needs), check.id


def test_every_page_belongs_to_a_check() -> None:
    from ros_doctor.pages import FOLDER

    headings = {
        (path.stem, heading)
        for path in FOLDER.glob("*.md")
        for heading in re.findall(r"^## (.+)$", path.read_text(encoding="utf-8"), re.M)
    }
    assert headings == {(check.theme, check.id) for check in CHECKS}


def test_a_wrong_id_is_answered_with_one_that_is_spelled_alike() -> None:
    with pytest.raises(UnknownCheck) as caught:
        find_check("domainid")
    assert "domain-id" in caught.value.near
