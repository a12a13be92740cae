"""All templates that a verdict's sentences are made of: for translators, and for tests."""

from __future__ import annotations

import pkgutil
from importlib import import_module
from types import ModuleType

import roslings.capabilities
import roslings.judge
from roslings.folders.lab_folders import GRADERS, lab_folders
from roslings.judge.faults.sentences import SentenceTemplate, Told, every_told

ROOMS = {"faults", "reasons", "values"}
"""Modules, and packages of modules, that have sentences."""


def every_template(*more: ModuleType) -> list[SentenceTemplate]:
    """Those of the engine, of each lab of the course, and of `more` packages, by their ids."""
    return sorted(each for kind in told_classes(*more) for each in kind.templates())


def told_classes(*more: ModuleType) -> list[type[Told]]:
    """The classes that have them."""
    packages = (roslings.judge, roslings.capabilities, *more)
    for package in packages:
        _load(package)
    for folder in lab_folders():
        for name in sorted(ROOMS):
            if (folder / f"{name}.py").is_file():
                import_module(f"{GRADERS}.{folder.name}.{name}")
    ours = tuple(f"{name}." for name in (*(each.__name__ for each in packages), GRADERS))
    return [kind for kind in every_told() if kind.__module__.startswith(ours)]


def _load(package: ModuleType) -> None:
    for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if ROOMS & {*found.name.split(".")}:
            import_module(found.name)
