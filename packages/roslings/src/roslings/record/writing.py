"""Values into columns; `columns.py` says what the forms are."""

from __future__ import annotations

import dataclasses
import marshal
import re
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from itertools import chain
from math import isfinite
from operator import attrgetter, itemgetter, sub
from types import NoneType
from typing import Any, TypeAlias

from pydantic import BaseModel

FEWEST_ROWS = 6
"""Fewer are read more easily as they are."""
MOST_ROWS = 1_000_000
"""More are in no evidence (`probe/budget.py`): a damaged table must not fill our memory."""
MOST_KINDS = 8
"""Objects of more kinds have names that are values themselves."""
MOST_PIECES = 40
MOST_DECIMALS = 6
"""As many has a number that somebody rounded: the boards' clocks count microseconds."""
LARGEST_ROUNDED = 2.0**52 / 10**MOST_DECIMALS
SAMPLE = 48
"""So many rows show how the others are."""
PLAINLY = 2
"""The last format of marshal in which equal values have equal bytes: later ones tell of sharing."""
FORM_BITS = 128
"""About what the words of a form take: it must save more."""
NS_PER_S = 1_000_000_000

Column: TypeAlias = list[Any] | dict[str, Any]
Bases: TypeAlias = Mapping[str, tuple[int, Sequence[int]]]
"""Columns of times that stand before one: how many nanoseconds one of it is, and its numbers."""


def column_of(values: Sequence[Any]) -> Column:
    """The shortest form of at least one value."""
    kinds = set(map(type, values))
    kind = kinds.pop()
    return _by_kind(values, _kind_of) if kinds else _WRITTEN.get(kind, _others)(values)


def _by_kind(values: Sequence[Any], kind_of: Callable[[Any], Any]) -> Column:
    """A column for each kind of value, where that makes one of them shorter."""
    kinds = _kinds_of(values, kind_of)
    if sum(kind in _SINGLE for kind in kinds) > 1:
        return [*values]
    columns = [_some(of_kind) for of_kind in kinds.values()]
    if all(isinstance(each, list) or each.get("same", 0) is None for each in columns):
        return [*values]
    number = {kind: number for number, kind in enumerate(kinds)}
    return {"kind": [number[kind_of(value)] for value in values], "kinds": columns}


def _kinds_of(values: Sequence[Any], kind_of: Callable[[Any], Any]) -> dict[Any, list[Any]]:
    """Kind to its values; none of them where there are too many kinds."""
    found: dict[Any, list[Any]] = {}
    for value in values:
        found.setdefault(kind_of(value), []).append(value)
        if len(found) > MOST_KINDS:
            return {}
    return found


def _kind_of(value: Any) -> Any:
    """The type; of an object its names."""
    return tuple(value) if type(value) is dict else type(value)


def _some(values: Sequence[Any]) -> Column:
    return column_of(values) if len(values) >= FEWEST_ROWS else [*values]


def _plain(values: Sequence[Any]) -> Column:
    """Of texts, truths and nothings, equal ones are the same."""
    first = values[0]
    return {"same": first} if values.count(first) == len(values) else [*values]


# --- numbers -----------------------------------------------------------------------------------


def _whole(values: Sequence[int], bases: Bases | None = None) -> Column:
    """As steps, as distances from the least one or from other times: what takes the fewest bits.

    The first rows show which that is.
    """
    column = _plain(values)
    if isinstance(column, dict) or len(values) < FEWEST_ROWS:
        return column
    forms = [_one_by_one, _steps]
    forms += [partial(_like, name, *base) for name, base in (bases or {}).items()]
    return min(forms, key=lambda form: form(values[:SAMPLE])[0])(values)[1]


def _one_by_one(values: Sequence[int]) -> tuple[int, Column]:
    """The bits that it takes about, and the column."""
    return sum(map(int.bit_length, values)), [*values]


def _steps(values: Sequence[int]) -> tuple[int, Column]:
    bits, steps = _from_least([*map(sub, values[1:], values)])
    return FORM_BITS + bits, {"first": values[0], "steps": steps}


def _from_least(values: Sequence[int]) -> tuple[int, Column]:
    column = _plain(values)
    if isinstance(column, dict):
        return 0, column
    least = min(values)
    bits, more = _one_by_one([value - least for value in values])
    as_they_are = _one_by_one(values)
    shorter = FORM_BITS + bits < as_they_are[0]
    return (FORM_BITS + bits, {"least": least, "more": more}) if shorter else as_they_are


def _like(name: str, ns: int, base: Sequence[int], values: Sequence[int]) -> tuple[int, Column]:
    """How much each is more than another time of its row: their distance hardly changes."""
    bits, later = _from_least([v - ns * b for v, b in zip(values, base, strict=False)])
    return FORM_BITS + bits, {"after": name, "ns": ns, "by": later}


def _floats(values: Sequence[float]) -> Column:
    return {"same": values[0]} if _are_same(values) else _rounded(values) or [*values]


def _are_same(values: Sequence[Any]) -> bool:
    """Bit by bit and kind by kind: 0.0 equals -0.0 and 0, and is another."""
    first = values[0]
    if values[-1] != first:
        return False
    try:
        return marshal.dumps([*values], PLAINLY) == marshal.dumps([first] * len(values), PLAINLY)
    except ValueError:  # something that only pydantic can write
        return False


def _rounded(values: Sequence[float]) -> Column | None:
    """Whole numbers in place of numbers with few decimals, where that makes them short."""
    decimals = _decimals_of(values)
    if decimals is None:
        return None
    times = 10**decimals
    whole = [round(value * times) for value in values]
    if array("d", [each / times for each in whole]).tobytes() != array("d", values).tobytes():
        return None
    column = _whole(whole)
    return {"decimals": decimals, "whole": column} if isinstance(column, dict) else None


def _decimals_of(values: Sequence[float]) -> int | None:
    """How many decimals the first ones have; None where those are too many, or one is no number."""
    first = values[:FEWEST_ROWS]
    if len(values) < FEWEST_ROWS or not all(map(isfinite, first)):
        return None
    for decimals in (3, MOST_DECIMALS):
        if all(round(value, decimals) == value for value in first):
            return decimals if _are_small(values) else None
    return None


def _are_small(values: Sequence[float]) -> bool:
    """Whole numbers hold them exactly."""
    small = max(values) <= LARGEST_ROUNDED and min(values) >= -LARGEST_ROUNDED
    return small and all(map(isfinite, values))


# --- texts -------------------------------------------------------------------------------------

_words = re.compile("([0-9A-Za-z]+)").split
_is_number = re.compile("0|[1-9][0-9]{,30}").fullmatch
Pieces: TypeAlias = list[str]
"""Of a text: what stands before its first word, the word, and so on."""


def _texts(values: Sequence[str]) -> Column:
    """What stands between words is mostly the same, and many words are numbers."""
    column = _plain(values)
    if isinstance(column, dict) or len(values) < FEWEST_ROWS:
        return column
    every = [*map(_words, values)]
    counts = [*map(len, every)]
    columns = _columns_of(counts, every)
    if not any(isinstance(each, dict) for each in columns.values()):
        return column
    if len(columns) == 1:
        return columns[counts[0]]
    number = {count: number for number, count in enumerate(columns)}
    return {"kind": [number[count] for count in counts], "kinds": [*columns.values()]}


def _columns_of(counts: Sequence[int], every: Sequence[Pieces]) -> dict[int, Column]:
    """Number of pieces to the column of those texts; none where they are all different."""
    found: dict[int, list[Pieces]] = {}
    for count, pieces in zip(counts, every, strict=True):
        found.setdefault(count, []).append(pieces)
    if len(found) > MOST_KINDS:
        return {}
    return {count: _in_pieces(texts) for count, texts in found.items()}


def _in_pieces(texts: Sequence[Pieces]) -> Column:
    """As they were, where they are few, or where most of what stands between words varies."""
    if len(texts) >= FEWEST_ROWS and len(texts[0]) <= MOST_PIECES:
        pieces = [*zip(*texts, strict=True)]
        between = [_plain(each) for each in pieces[::2]]
        if 2 * sum(isinstance(each, dict) for each in between) >= len(between):
            return {"pieces": [*_alternating(between, [_digits(each) for each in pieces[1::2]])]}
    return [*map("".join, texts)]


def _alternating(between: Sequence[Column], words: Sequence[Column]) -> Iterator[Column]:
    for one, other in zip(between, words, strict=False):
        yield one
        yield other
    yield between[-1]


def _digits(texts: Sequence[str]) -> Column:
    """Whole numbers, where all are digits with no zeros before them."""
    column = _plain(texts)
    if isinstance(column, dict) or not all(map(_is_number, texts)):
        return column
    return _whole([*map(int, texts)])


# --- objects and lists -------------------------------------------------------------------------


def _objects(values: Sequence[dict[str, Any]]) -> Column:
    if _are_same(values):
        return {"same": values[0]}
    names = tuple(values[0])
    if [*map(tuple, values)].count(names) < len(values):
        return _by_kind(values, _kind_of)
    columns = {name: [*map(itemgetter(name), values)] for name in names}
    return _stamps(columns) or _fields(columns)


def _fields(columns: Mapping[str, Sequence[Any]]) -> Column:
    """Each field's column; a time may be told by one before it."""
    made: dict[str, Column] = {}
    bases: dict[str, tuple[int, Sequence[int]]] = {}
    for name, values in columns.items():
        if name.endswith("_ns") and set(map(type, values)) == {int}:
            made[name] = _whole(values, bases)
            bases[name] = 1, values
        else:
            made[name] = column = column_of(values)
            if name.endswith("_s") and isinstance(column, dict) and "decimals" in column:
                whole = 10 ** column["decimals"]
                bases[name] = NS_PER_S // whole, [round(value * whole) for value in values]
    return {"fields": made}


def _stamps(columns: Mapping[str, Sequence[Any]]) -> Column | None:
    """None where the objects are no times of ROS."""
    if tuple(columns) != ("sec", "nanosec"):
        return None
    if any(set(map(type, column)) != {int} for column in columns.values()):
        return None
    sec, nanosec = columns.values()
    if min(nanosec) < 0 or max(nanosec) >= NS_PER_S:
        return None
    return {"stamps_ns": _whole([s * NS_PER_S + ns for s, ns in zip(sec, nanosec, strict=True)])}


def _lists(values: Sequence[Sequence[Any]]) -> Column:
    if _are_same(values):
        return {"same": values[0]}
    lengths = set(map(len, values))
    if len(lengths) > 1:
        return _one_behind_the_other(values)
    if lengths.pop() > len(values):
        return [*values]
    return {"places": [column_of(column) for column in zip(*values, strict=True)]}


def _one_behind_the_other(values: Sequence[Sequence[Any]]) -> Column:
    items = [*chain.from_iterable(values)]
    column = column_of(items) if set(map(type, items)) == {dict} else items
    if isinstance(column, list) or len(items) > MOST_ROWS:
        return [*values]
    return {"lengths": _whole([*map(len, values)]), "items": column}


def _others(values: Sequence[Any]) -> Column:
    """Records by their fields; what we do not know is left to pydantic."""
    kind: Any = type(values[0])
    names = _names_of(kind)
    if not names:
        return [*values]
    return _fields({name: [*map(attrgetter(name), values)] for name in names})


@cache
def _names_of(kind: type[Any]) -> tuple[str, ...]:
    """The fields of a record; none where JSON has other names for them, or it is no record."""
    if dataclasses.is_dataclass(kind):
        return tuple(each.name for each in dataclasses.fields(kind))
    if not issubclass(kind, BaseModel) or kind.model_config.get("extra") != "forbid":
        return ()
    aliased = any(each.serialization_alias for each in kind.model_fields.values())
    return () if aliased else tuple(kind.model_fields)


_WRITTEN: dict[type[Any], Callable[[Sequence[Any]], Column]] = {
    bool: _plain,
    str: _texts,
    NoneType: _plain,
    int: _whole,
    float: _floats,
    dict: _objects,
    list: _lists,
    tuple: _lists,
}
_SINGLE = (bool, str, int, float)
