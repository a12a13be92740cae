"""What serves one lab alone lies beside its grader, or it is said why it does not."""

from __future__ import annotations

from functools import cache

from one_lab_only import EXPLAINED, is_explained, reached_by_users, serves_one_lab
from roslings.course import all_labs


@cache
def found() -> frozenset[str]:
    """All modules of the engine that one lab alone uses."""
    return frozenset(name for names in serves_one_lab().values() for name in names)


def test_what_serves_one_lab_is_explained() -> None:
    """Else it goes to `graders/LAB/`, or a course outside uses it too (tests/outside/courses)."""
    assert {name for name in found() if not is_explained(name)} == set()


def test_what_is_explained_serves_one_lab() -> None:
    """Where others use it by now, or it is gone, there is nothing to explain."""
    of_one = {
        known for known in EXPLAINED for name in found() if f"{name}.".startswith(f"{known}.")
    }
    assert of_one == set(EXPLAINED)


def test_each_user_is_seen() -> None:
    """Labs by their graders and what lies beside these, others by theirs, a page by its code."""
    reached = reached_by_users()
    assert {lab.name for lab in all_labs()} < reached.keys()
    assert "graders.e_stop.act" in reached["e-stop"]
    harbour = reached["tests/outside/courses/harbour/graders/grade_almanac.py"]
    assert "roslings.capabilities.qos.demands" in harbour
    assert "roslings.capabilities.serial.act" in reached["site/pages/teachers/a-larger-lab.md"]
    alone = {user for user, names in reached.items() if "graders.e_stop.act" in names}
    assert alone == {"e-stop"}
