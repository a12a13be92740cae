"""`$(var x)`, `$(env HOME)`, `$(find-pkg-share p)`, `$(dirname)` in the texts of a launch file."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from ros2_on_pip.launching import elsewhere, substitutions
from ros2_on_pip.launching.substitution import Parts, Substitution, TextSubstitution
from ros2_on_pip.problem import CommandProblem, did_you_mean

QUOTES = "'\"`"
ESCAPED = re.compile(r"\\.")
NAME = re.compile(r"\s*([^\s()$'\"]*)")


class BadSubstitution(CommandProblem):
    """A `$(...)` that cannot be read; the caller adds the place."""


class UnknownSubstitution(CommandProblem):
    """Jazzy fills it in, and we do not; the caller adds the place."""

    def __init__(self, name: str) -> None:
        super().__init__(f"$({name} ...)")
        self.instead = elsewhere.SUBSTITUTIONS[name]


Make = Callable[..., Substitution]


@dataclass(frozen=True)
class SubstitutionKind:
    """How a `$(name ...)` is made, and how many words it takes."""

    make: Make
    least: int
    most: int
    form: str


def _env(name: Parts, default: Parts | None = None) -> Substitution:
    return substitutions.EnvironmentVariable(name, default_value=default)


def _var(name: Parts, default: Parts | None = None) -> Substitution:
    return substitutions.LaunchConfiguration(name, default=default)


def _command(command: Parts, on_stderr: Parts | None = None) -> Substitution:
    return substitutions.Command(command, on_stderr=on_stderr or "fail")


KINDS = {
    "and": SubstitutionKind(substitutions.AndSubstitution, 2, 2, "A B"),
    "anon": SubstitutionKind(substitutions.AnonName, 1, 1, "NAME"),
    "command": SubstitutionKind(_command, 1, 2, "'WORDS'"),
    "dirname": SubstitutionKind(substitutions.ThisLaunchFileDir, 0, 0, ""),
    "env": SubstitutionKind(_env, 1, 2, "NAME"),
    "equals": SubstitutionKind(substitutions.EqualsSubstitution, 2, 2, "A B"),
    "eval": SubstitutionKind(substitutions.PythonExpression, 1, 1, "'EXPRESSION'"),
    "exec-in-pkg": SubstitutionKind(substitutions.ExecutableInPackage, 2, 2, "EXECUTABLE PACKAGE"),
    "file-content": SubstitutionKind(substitutions.FileContent, 1, 1, "FILE"),
    "filename": SubstitutionKind(substitutions.ThisLaunchFile, 0, 0, ""),
    "find-exec": SubstitutionKind(
        lambda name: substitutions.FindExecutable(name=name), 1, 1, "NAME"
    ),
    "find-pkg-prefix": SubstitutionKind(substitutions.FindPackagePrefix, 1, 1, "PACKAGE"),
    "find-pkg-share": SubstitutionKind(substitutions.FindPackageShare, 1, 1, "PACKAGE"),
    "if": SubstitutionKind(substitutions.IfElseSubstitution, 2, 3, "CONDITION A B"),
    "launch_log_dir": SubstitutionKind(substitutions.LaunchLogDir, 0, 0, ""),
    "log_dir": SubstitutionKind(substitutions.LaunchLogDir, 0, 0, ""),
    "not": SubstitutionKind(substitutions.NotSubstitution, 1, 1, "A"),
    "not-equals": SubstitutionKind(substitutions.NotEqualsSubstitution, 2, 2, "A B"),
    "optenv": SubstitutionKind(lambda name, default="": _env(name, default), 1, 2, "NAME"),
    "or": SubstitutionKind(substitutions.OrSubstitution, 2, 2, "A B"),
    "var": SubstitutionKind(_var, 1, 2, "NAME"),
}


def parts_in(text: str) -> Parts:
    """The texts and substitutions that `text` is made of. Raises BadSubstitution."""
    reader = _Reader(text)
    return reader.parts(lambda letter: False)


class _Reader:
    """Walks through a text, letter by letter."""

    def __init__(self, text: str) -> None:
        self._text, self._at = text, 0

    def parts(self, ends: Callable[[str], bool]) -> Parts:
        """All up to a letter that `ends` it, or up to the end."""
        found: Parts = []
        plain = ""
        while self._at < len(self._text) and not ends(self._text[self._at]):
            if self._text.startswith("$(", self._at):
                found += [TextSubstitution(text=plain)] if plain else []
                plain = ""
                found.append(self._substitution())
            else:
                plain += self._letter()
        return [*found, TextSubstitution(text=plain)] if plain or not found else found

    def _letter(self) -> str:
        r"""The next one; behind a backslash it means nothing but itself: `\$`, `\"`."""
        found = ESCAPED.match(self._text, self._at)
        self._at += 2 if found else 1
        return self._text[self._at - 1]

    def _substitution(self) -> Substitution:
        name = NAME.match(self._text, self._at + 2)
        assert name
        self._at = name.end()
        words = list(self._words())
        return _made(name[1], words)

    def _words(self) -> list[Parts]:
        """What stands between the name and the bracket that closes."""
        words: list[Parts] = []
        while self._skip_blanks() != ")":
            letter = self._text[self._at]
            if letter in QUOTES:
                words.append(self._quoted(letter))
            else:
                words.append(self.parts(lambda one: one.isspace() or one == ")"))
        self._at += 1
        return words

    def _quoted(self, quote: str) -> Parts:
        self._at += 1
        found = self.parts(lambda letter: letter == quote)
        if self._at >= len(self._text):
            raise BadSubstitution(f"'{self._text}' has an open quote: {quote}")
        self._at += 1
        return found

    def _skip_blanks(self) -> str:
        while self._at < len(self._text) and self._text[self._at].isspace():
            self._at += 1
        if self._at >= len(self._text):
            raise BadSubstitution(f"'{self._text}' has a $( without its )")
        return self._text[self._at]


def _made(name: str, words: list[Parts]) -> Substitution:
    if name in elsewhere.SUBSTITUTIONS:
        raise UnknownSubstitution(name)
    if name not in KINDS:
        near = did_you_mean(name, KINDS)
        known = ", ".join(sorted(KINDS))
        raise BadSubstitution(f"there is no $({name} ...).{near} Known: {known}.")
    kind = KINDS[name]
    if not kind.least <= len(words) <= kind.most:
        form = f"{name} {kind.form}".strip()
        raise BadSubstitution(f"$({name}) has {len(words)} words; write it so: $({form})")
    return kind.make(*words)
