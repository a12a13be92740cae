"""What every fault says, and the two other answers that a check can give."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

SENTENCES = ("expected", "measured", "why", "hint", "mend")


class Sentence:
    """One that is written in a class as a template: what stands in braces comes from the fault."""

    def __init__(self, template: str) -> None:
        self.template = template

    def __get__(self, fault: Any, kind: type[Any]) -> str:
        """Filled in; of the class itself, the template. Raises AttributeError for other names."""
        return self.template if fault is None else self.template.format_map(_Attributes(fault))


class _Attributes(Mapping[str, Any]):
    """Those of a fault, by their names: its fields, and what its properties make of them."""

    def __init__(self, fault: Any) -> None:
        self._fault = fault

    def __getitem__(self, name: str) -> Any:
        return getattr(self._fault, name)

    def __iter__(self) -> Any:
        return iter(vars(self._fault))

    def __len__(self) -> int:
        return len(vars(self._fault))


@dataclass(eq=False)
class Fault(Exception):
    """A failed check. Subclasses carry the numbers, and have the sentences as templates.

        expected = "a node that serves {service}"

    A sentence in which there is something to decide is a property (where it takes the place of a
    template, mypy wants `type: ignore[override]`). A brace itself is written twice.
    """

    why: ClassVar[str] = ""
    was_seen: ClassVar[bool] = False
    """What is wrong was seen, not missed: it stands even where other evidence was dropped."""
    blocks: ClassVar[bool] = True
    """Nothing can be said by the checks that need this one."""
    log: tuple[str, ...] = field(default=(), kw_only=True)

    def __init_subclass__(cls) -> None:
        """Texts under the names of sentences become templates; a field of such a name stays one."""
        super().__init_subclass__()
        fields = vars(cls).get("__annotations__", {})
        for name in SENTENCES:
            if name not in fields and isinstance(text := vars(cls).get(name), str):
                setattr(cls, name, Sentence(text))
        if "hint" in vars(cls) and "mend" not in vars(cls):
            setattr(cls, "mend", Sentence(""))  # noqa: B010 - the class above has its own hint

    @property
    def expected(self) -> str:
        """What the contract asks for."""
        raise NotImplementedError

    @property
    def measured(self) -> str:
        """What was seen instead."""
        raise NotImplementedError

    @property
    def headline(self) -> str:
        """What was measured, in a line that stands alone: it names what it speaks of."""
        return self.measured

    @property
    def hint(self) -> str:
        """Where to look. It names what is wrong, and not the mend: who finds that has learnt it."""
        raise NotImplementedError

    @property
    def mend(self) -> str:
        """What mends it, told with the last hint; empty where the hint is all that can be said."""
        return ""

    def __str__(self) -> str:
        return f"expected {self.expected}; measured {self.measured}"


class Inconclusive(Exception):
    """It cannot be told, mostly since the machine was too busy: no verdict, and the reason."""


class NothingToJudge(Exception):
    """What this check looks at is not there, and another check has already said so."""


@dataclass(eq=False)
class Unmet(Fault):
    """A bare `assert` of a grader did not hold."""

    NO_MESSAGE: ClassVar[str] = "it is not so"

    sentence: str
    message: str = NO_MESSAGE
    """What the grader wrote behind the `assert`."""
    why = ""
    hint = "Read the lab's card again and compare."
    expected = "{sentence}"
    measured = "{message}"
