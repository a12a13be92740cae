"""Whether something holds the package that a check runs, and what is said where nothing does."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.language import said
from roslings.workspace.student import workspace_root

OPTION = "--as-stranger"


def is_strangers(options: argparse.Namespace, others: bool) -> bool:
    """Whether it runs behind the wall for strangers' code, or not at all."""
    if options.solution:
        return False
    return options.as_stranger or (others and not options.trust)


def told_of_no_wall(package: Path, options: argparse.Namespace) -> str:
    """A line on a package from elsewhere that would run with all rights; empty where it is held."""
    if options.solution or options.trust or _is_own(package):
        return ""
    from roslings.arena import choose_isolation

    wall = choose_isolation()
    if wall.sandbox:
        return ""
    reason = wall.lack.reason if wall.lack else wall.because
    text = "Nothing holds this package, it can do all that you can: {reason}. ({option} refuses.)"
    return said("check.no_wall", text, reason=reason, option=OPTION)


def _is_own(package: Path) -> bool:
    return package.resolve().is_relative_to(workspace_root().resolve())
