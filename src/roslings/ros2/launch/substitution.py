"""`$(var x)`, `$(env HOME)`, `$(find-pkg-share p)`, `$(dirname)` in the texts of a launch file."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from roslings.ros2.launch import jazzy
from roslings.ros2.problem import Problem, did_you_mean


class BadSubstitution(Problem):
    """A `$(...)` that cannot be filled in; the caller adds the place."""


class UnknownSubstitution(Problem):
    """Jazzy fills it in, and we do not; the caller adds the place."""


@dataclass(frozen=True)
class Scope:
    """What the substitutions may use, and where nodes go, at one place of a launch file."""

    file: Path
    variables: dict[str, str] = field(default_factory=dict)
    namespace: str = "/"
    environment: dict[str, str] = field(default_factory=dict)

    def inner(self) -> Scope:
        """A scope inside this one: what is set there does not leave it."""
        return replace(self, variables=dict(self.variables), environment=dict(self.environment))


def filled_in(text: str, scope: Scope) -> str:
    """`text` with each `$(...)` replaced, inner ones first. Raises BadSubstitution."""
    result, rest = "", text
    while "$(" in rest:
        before, _, rest = rest.partition("$(")
        if before.endswith("\\"):
            result += before[:-1] + "$("
            continue
        inside, rest = _split_at_end(rest, text)
        result += before + _value(filled_in(inside, scope), scope)
    return result + rest


def _split_at_end(rest: str, text: str) -> tuple[str, str]:
    """What stands before the bracket that closes, and what stands after it."""
    depth = 1
    for index, letter in enumerate(rest):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0:
            return rest[:index], rest[index + 1 :]
    raise BadSubstitution(f"'{text}' has a $( without its )")


def _value(inside: str, scope: Scope) -> str:
    try:
        name, *words = shlex.split(inside)
    except ValueError:
        raise BadSubstitution(f"$({inside}) is empty or has an open quote") from None
    if name in jazzy.SUBSTITUTIONS:
        raise UnknownSubstitution(f"$({name} ...)")
    if name not in KINDS:
        near = did_you_mean(name, KINDS)
        raise BadSubstitution(
            f"there is no $({name} ...).{near} Known: {', '.join(sorted(KINDS))}."
        )
    return KINDS[name](words, scope)


def _var(words: list[str], scope: Scope) -> str:
    name, *default = _at_least_one("var", words)
    if name in scope.variables:
        return scope.variables[name]
    if default:
        return default[0]
    near = did_you_mean(name, scope.variables)
    raise BadSubstitution(f"there is no arg or let with the name '{name}'.{near}")


def _env(words: list[str], scope: Scope) -> str:
    name, *default = _at_least_one("env", words)
    value = scope.environment.get(name, os.environ.get(name))
    if value is None and not default:
        raise BadSubstitution(f"the environment variable {name} is not set: export {name}=...")
    return default[0] if value is None else value


def _share(words: list[str], _: Scope) -> str:
    from roslings.ros2.packages import share_of

    return str(share_of(_at_least_one("find-pkg-share", words)[0]))


def _prefix(words: list[str], _: Scope) -> str:
    from roslings.ros2.packages import prefix_of

    return str(prefix_of(_at_least_one("find-pkg-prefix", words)[0]))


def _at_least_one(kind: str, words: list[str]) -> list[str]:
    if not words:
        raise BadSubstitution(f"$({kind}) needs a name: $({kind} NAME)")
    return words


KINDS: dict[str, Callable[[list[str], Scope], str]] = {
    "var": _var,
    "env": _env,
    "find-pkg-share": _share,
    "find-pkg-prefix": _prefix,
    "dirname": lambda _, scope: str(scope.file.resolve().parent),
    "filename": lambda _, scope: scope.file.name,
}
