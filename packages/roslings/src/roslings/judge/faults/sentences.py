"""How the sentences of a verdict are written: whole templates, filled in when somebody reads them.

No sentence is put together from parts: in another language its words stand in another order. Where
there is something to decide, a class has several whole templates, and a small property, named for
the sentence, says which one holds.

    measured = one_of(
        client="the node has a client of {service}, and no server",
        nobody="no node serves {service}, or a name like it",
    )

    @property
    def which_measured(self) -> str:
        return "client" if self.is_client else "nobody"

What is counted chooses by its number, as a whole sentence or as one of `one_of`:

    measured = plural("count", one="{count} message came", other="{count} messages came")

Several whole sentences that stand behind each other, or none of them, are `some_of`.

Each template has an id, such as `faults.NoService.measured.client`. By it `ros2_on_pip.language`
knows what stands in its place in the language that is asked for.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, ClassVar, NamedTuple, TypeVar, cast

from ros2_on_pip import language

ONE, OTHER = "one", "other"
WHICH = "which_"
S = TypeVar("S", bound="FaultSentence")


# --- what a class has --------------------------------------------------------------------------


class SentenceTemplate(NamedTuple):
    """One whole template, as translators have it."""

    id: str
    english: str
    sentence: str
    """The id of the sentence that this is, or is one variant or form of."""


class FaultSentence(ABC):
    """A sentence of a class: whichever of its templates holds, filled in for who is asked."""

    def __init__(self) -> None:
        self.id = ""

    def bound(self: S, name: str) -> S:
        """The same with this id. Two classes may be written with one sentence."""
        own = copy(self)
        own.id = name
        return own

    @property
    def templates(self) -> Iterator[SentenceTemplate]:
        """All that it may be."""
        return (SentenceTemplate(*each, self.id) for each in self.written())

    @abstractmethod
    def written(self) -> Iterator[tuple[str, str]]:
        """Id and text of each template."""

    @abstractmethod
    def of(self, told: Any) -> str:
        """Filled in. Raises AttributeError for names that are not there."""

    def __get__(self, told: Any, kind: type[Any]) -> str:
        """Filled in; of the class itself, its templates, one a line."""
        if told is None:
            return "\n".join(text for _, text in self.written())
        return self.of(told)


class Plain(FaultSentence):
    """One template, with nothing to decide."""

    def __init__(self, template: str) -> None:
        super().__init__()
        self.template = template

    def written(self) -> Iterator[tuple[str, str]]:
        """The one."""
        yield self.id, self.template

    def of(self, told: Any) -> str:
        """Filled in."""
        return filled(language.template(self.id, self.template), told)


class Plural(FaultSentence):
    """Two templates, of which a number chooses one."""

    def __init__(self, number: str, forms: Mapping[str, str]) -> None:
        super().__init__()
        self.number, self.forms = number, forms

    def written(self) -> Iterator[tuple[str, str]]:
        """Each form; other languages have more, or fewer."""
        yield from ((f"{self.id}.{form}", text) for form, text in self.forms.items())

    def of(self, told: Any) -> str:
        """By the number, as the language has it."""
        number = attrgetter(self.number)(told)
        return filled(language.form(self.id, number, **self.forms), told)


class Choice(FaultSentence):
    """Whole sentences with names; `which_…` of who is asked says which of them are told."""

    def __init__(self, variants: Mapping[str, FaultSentence], between: str = " ") -> None:
        super().__init__()
        self.variants, self.between = variants, between

    def bound(self, name: str) -> Choice:
        """With ids for all variants."""
        own = super().bound(name)
        own.variants = {key: each.bound(f"{name}.{key}") for key, each in self.variants.items()}
        return own

    def written(self) -> Iterator[tuple[str, str]]:
        """Those of all variants."""
        for each in self.variants.values():
            yield from each.written()

    def of(self, told: Any) -> str:
        """The sentence that holds; several behind each other. Raises LookupError for others."""
        which = getattr(told, WHICH + self.id.rpartition(".")[2])
        names = (which,) if isinstance(which, str) else which
        if unknown := {*names} - {*self.variants, ""}:
            raise LookupError(f"{self.id} has no sentence called {sorted(unknown)}")
        return self.between.join(self.variants[each].of(told) for each in names if each)


def one_of(**variants: str) -> str:
    """A sentence of a class with several templates.

    `which_NAME` of the class names the one that holds; the empty text says that none does.
    """
    return cast(str, Choice({name: _sentence(each) for name, each in variants.items()}))


def some_of(between: str = " ", **variants: str) -> str:
    """Whole sentences, of which `which_NAME` names those that are told, in their order."""
    return cast(str, Choice({name: _sentence(each) for name, each in variants.items()}, between))


def plural(number: str, *, one: str, other: str) -> str:
    """A sentence that goes by a number of its class, a field or a property with this name."""
    return cast(str, Plural(number, {ONE: one, OTHER: other}))


def _sentence(written: Any) -> FaultSentence:
    return written if isinstance(written, FaultSentence) else Plain(written)


# --- filled in ---------------------------------------------------------------------------------


def filled(template: str, told: Any) -> str:
    """With what stands in braces: fields of what is told, and properties; lists with commas."""
    return template.format_map(_Attributes(told))


class _Attributes(Mapping[str, Any]):
    """Those of what is told, by their names: its fields, and what its properties make of them."""

    def __init__(self, told: Any) -> None:
        self._told = told

    def __getitem__(self, name: str) -> Any:
        found = getattr(self._told, name)
        return _Listed(found) if type(found) is tuple else found

    def __iter__(self) -> Any:
        return iter(vars(self._told))

    def __len__(self) -> int:
        return len(vars(self._told))


class _Listed(tuple[Any, ...]):
    """Several things, as a sentence names them."""

    def __format__(self, spec: str) -> str:
        return ", ".join(format(each, spec) for each in self)


# --- who has sentences -------------------------------------------------------------------------


class Told:
    """What has sentences. Texts under their names in a class become templates with ids."""

    ROOM: ClassVar[str] = "words"
    """The first word of the ids."""
    SENTENCES: ClassVar[tuple[str, ...]] = ("text",)
    """The names of the sentences, in the order in which somebody reads them."""
    KNOWN_AS: ClassVar[str] = ""
    """In the ids, where another class has the same name."""

    def __init_subclass__(cls) -> None:
        """A field of such a name stays a field."""
        super().__init_subclass__()
        fields = vars(cls).get("__annotations__", {})
        known_as = vars(cls).get("KNOWN_AS") or cls.__name__
        for name in cls.SENTENCES:
            written = vars(cls).get(name)
            if name not in fields and isinstance(written, str | FaultSentence):
                told = _sentence(written).bound(f"{cls.ROOM}.{known_as}.{name}")
                setattr(cls, name, told)

    @classmethod
    def sentences(cls) -> dict[str, FaultSentence]:
        """Those that this very class has, by their names."""
        own = vars(cls)
        return {
            name: own[name] for name in cls.SENTENCES if isinstance(own.get(name), FaultSentence)
        }

    @classmethod
    def templates(cls) -> Iterator[SentenceTemplate]:
        """Those of this very class; where it says that there is no mend, that is none."""
        for sentence in cls.sentences().values():
            yield from (each for each in sentence.templates if each.english)


@dataclass(frozen=True)
class SentencePart(Told):
    """A part that several sentences share, such as how a process ended, with its own fields."""

    @property
    def text(self) -> str:
        """As it stands in a sentence."""
        raise NotImplementedError

    def __str__(self) -> str:
        return self.text


Text = str | SentencePart
"""What a lab's author has written, or what the engine has words for."""


def every_told() -> Iterator[type[Told]]:
    """All classes with sentences that are loaded; `capabilities.templates` loads the rest."""
    found, waiting = set[type[Told]](), [Told]
    while waiting:
        kinds = {*waiting.pop().__subclasses__()} - found
        found |= kinds
        waiting += kinds
    yield from sorted(found, key=lambda kind: (kind.ROOM, kind.__name__, kind.__module__))
