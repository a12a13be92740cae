"""What any capability must hold, ours or another course's.

    import pytest
    from roslings.capabilities.conformance import CHECKS
    from my_course.lifecycle import CAPABILITY

    @pytest.mark.parametrize("holds", CHECKS, ids=lambda check: check.__name__)
    def test_lifecycle_is_a_capability(holds):
        holds(CAPABILITY)

Each check takes a capability, and raises AssertionError with the words of what is wrong.
"""

from __future__ import annotations

import importlib
import json
import pkgutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import is_dataclass
from inspect import getmembers, isabstract, isclass
from types import ModuleType
from typing import Any, get_args

from roslings.capability import Capability, Place, Words, at, capability
from roslings.course.contract import Contract
from roslings.course.kinds import kind_of
from roslings.evidence import (
    Evidence,
    ExperimentSeen,
    MachineSeen,
    PackageSeen,
    evidence_json,
    read_json,
    thin_json,
)
from roslings.judge.faults import Fault
from roslings.record import PartSeen

Check = Callable[[Capability[Any]], None]
PURE = ("contract", "record", "demands", "faults", "reasons", "report")
"""Modules that evidence is read, judged and shown with."""
RUNS = ("rclpy", "roslings.arena", "roslings.experiment", "roslings.probe")


def is_found_by_its_name(known: Capability[Any]) -> None:
    """The registry leads to it, by the name that it has itself."""
    assert capability(known.name) is known, (
        f"no folder beside a grader, and no entry point {known.name!r} of roslings.capability,"
        " leads to this capability"
    )


def its_record_has_its_name(known: Capability[Any]) -> None:
    """Evidence keeps the record under the capability's name."""
    if known.seen is not None:
        assert known.name == known.seen.NAME, f"{known.seen.__name__}.NAME is not {known.name!r}"


def its_record_is_empty_at_first(known: Capability[Any]) -> None:
    """Where nothing was seen, there is a record all the same."""
    if known.seen is not None:
        assert known.seen() == known.seen(), "two empty records differ"


def its_record_survives_a_round_trip(known: Capability[Any]) -> None:
    """Written as JSON and read, the record is what it was."""
    if known.seen is not None:
        evidence = _evidence_of(known.seen())
        for written in (evidence_json(evidence), thin_json(evidence)):
            assert read_json(written) == evidence, "the record was read back as another"


def it_upgrades_each_version(known: Capability[Any]) -> None:
    """From each version of the record there is a step to the next one."""
    assert sorted(known.upgrade) == list(range(1, known.version)), (
        f"version {known.version} needs an upgrade from each version before it,"
        f" and there are those from {sorted(known.upgrade) or 'none'}"
    )


def it_keeps_what_is_newer(known: Capability[Any]) -> None:
    """A record of a version that is not known yet is kept, not guessed at."""
    if known.seen is not None:
        evidence = json.loads(evidence_json(_evidence_of(known.seen())))
        evidence["experiments"]["it"]["parts"][known.name] = {"v": known.version + 1, "new": 1}
        again = json.loads(evidence_json(read_json(json.dumps(evidence).encode())))
        assert again == evidence, "a newer record was changed"


def its_words_tell_how_they_are_proven(known: Capability[Any]) -> None:
    """Each word of a card has a kind, or holds a contract whose words have one."""
    for contract in _contracts_of(known):
        for name, field in contract.model_fields.items():
            assert kind_of(field) or any(_held_by(field.annotation)), (
                f"{contract.__name__}.{name} has no kind of roslings.course.kinds"
            )


def its_words_have_defaults(known: Capability[Any]) -> None:
    """Cards that say nothing of it stay right."""
    words = _words_of(known)
    for model in filter(None, (words.node, words.card)):
        for name, field in model.model_fields.items():
            assert not field.is_required(), f"{model.__name__}.{name} has no default"


def its_words_have_rows(known: Capability[Any]) -> None:
    """What the words say is written in task.md, and nothing where they say nothing."""
    words = _words_of(known)
    node, card = _empty(words.node), _empty(words.card)
    rows = [*words.interface(node), *words.settings(node), *words.package(card)]
    assert rows == [], f"without a word there are rows: {rows}"


def its_faults_have_all_words(known: Capability[Any]) -> None:
    """Each says what was expected, what was measured, why it matters and what to try."""
    for fault in _faults_of(known):
        for words in ("expected", "measured", "hint"):
            assert getattr(fault, words) is not getattr(Fault, words), f"{fault.__name__}: {words}"
        assert fault.why, f"{fault.__name__}: why"
        assert is_dataclass(fault) and fault.__doc__, f"{fault.__name__}: a documented dataclass"


def its_sections_draw_nothing_from_nothing(known: Capability[Any]) -> None:
    """A page of evidence without it has no section of it."""
    parts = [known.seen()] if known.seen else []
    for evidence in (_evidence_of(), _evidence_of(*parts)):
        assert list(known.sections_of(evidence)) == [], "a section of nothing"


def reading_and_judging_run_nothing(known: Capability[Any]) -> None:
    """What evidence is read, judged and shown with imports neither ROS nor what measures."""
    modules = [name for name in _modules_of(known) if name.rpartition(".")[2] in PURE]
    source = "import importlib, sys, roslings.folders.lab_folders\n"
    source += "for name in sys.argv[1:]: importlib.import_module(name)\n"
    source += f"print(*[name for name in {RUNS} if name in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", source, *modules], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "", f"{', '.join(modules)} import {done.stdout.strip()}"


def its_places_are_there(known: Capability[Any]) -> None:
    """All that it names exists."""
    for place in filter(None, (known.words, known.sections, known.companions)):
        assert _is_there(place), f"there is no {place}"


CHECKS: tuple[Check, ...] = (
    is_found_by_its_name,
    its_places_are_there,
    its_record_has_its_name,
    its_record_is_empty_at_first,
    its_record_survives_a_round_trip,
    it_upgrades_each_version,
    it_keeps_what_is_newer,
    its_words_tell_how_they_are_proven,
    its_words_have_defaults,
    its_words_have_rows,
    its_faults_have_all_words,
    its_sections_draw_nothing_from_nothing,
    reading_and_judging_run_nothing,
)
"""All of them, the plain ones first."""


def _is_there(place: Place) -> bool:
    try:
        return at(place) is not None
    except (ImportError, AttributeError):
        return False


def _words_of(known: Capability[Any]) -> Words:
    return known.words_here or Words()


def _empty(model: type[Any] | None) -> Any:
    return model() if model else None


def _contracts_of(known: Capability[Any]) -> Iterator[type[Contract]]:
    words = _words_of(known)
    for model in filter(None, (words.node, words.card)):
        yield from _held_by(model)


def _held_by(annotation: Any) -> Iterator[type[Contract]]:
    """The contracts that an annotation holds, one below the other."""
    if isclass(annotation) and issubclass(annotation, Contract):
        yield annotation
        for field in annotation.model_fields.values():
            yield from _held_by(field.annotation)
    for inner in get_args(annotation):
        yield from _held_by(inner)


def _faults_of(known: Capability[Any]) -> Iterator[type[Fault]]:
    """The faults of its room that can be raised: an abstract one is what others have in common."""
    for name in _modules_of(known):
        if ".faults" in name:
            for _, fault in getmembers(importlib.import_module(name), isclass):
                if fault.__module__ == name and issubclass(fault, Fault):
                    yield from () if isabstract(fault) else (fault,)


def _modules_of(known: Capability[Any]) -> Iterator[str]:
    """The modules of its room, packages inside included."""
    room = importlib.import_module(_room_of(known))
    return (each.name for each in pkgutil.walk_packages(room.__path__, f"{room.__name__}."))


def _room_of(known: Capability[Any]) -> str:
    """The package that it is defined in."""
    packages = (each for each in [*sys.modules.values()] if hasattr(each, "__path__"))
    for package in packages:
        if isinstance(package, ModuleType) and vars(package).get("CAPABILITY") is known:
            return package.__name__
    raise AssertionError(f"no module that is imported has {known.name!r} as its CAPABILITY")


def _evidence_of(*parts: PartSeen) -> Evidence:
    """Evidence of one experiment that saw nothing but these parts."""
    seen = ExperimentSeen(name="it", clock="wall", parts={part.NAME: part for part in parts})
    machine = MachineSeen(
        roslings="", ros_distro="", rmw="", python="", platform="", isolation="namespace"
    )
    package = PackageSeen(name="it", folder="it", build_type="ament_python")
    return Evidence(lab="it", seed=0, machine=machine, package=package, experiments={"it": seen})
