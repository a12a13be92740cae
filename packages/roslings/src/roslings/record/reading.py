"""Columns into values; what nobody wrote so is refused. `columns.py` says what the forms are."""

from __future__ import annotations

import marshal
from collections import Counter
from collections.abc import Callable, Mapping
from itertools import accumulate, islice, repeat
from operator import add, mul
from typing import Any

from roslings.record.writing import MOST_ROWS, NS_PER_S


class BadColumns(ValueError):
    """A table that nobody wrote: pydantic tells where."""


def values_of(column: Any, rows: int) -> list[Any]:
    """What a column of so many rows stands for. Raises BadColumns."""
    if not 0 <= rows <= MOST_ROWS:
        raise BadColumns(f"{rows} rows")
    values = column if isinstance(column, list) else _read(column, rows)
    if len(values) != rows:
        raise BadColumns(f"a column of {len(values)} values for {rows} rows")
    return values


def _read(column: Any, rows: int) -> list[Any]:
    read = _READ.get(frozenset(column)) if isinstance(column, dict) else None
    if read is None:
        raise BadColumns("a column of a form that nobody knows")
    return read(rows, **column)


def _same(rows: int, same: Any) -> list[Any]:
    """Each row gets a list or an object of its own."""
    if not isinstance(same, list | dict):
        return [same] * rows
    plain = marshal.dumps(same)
    return [marshal.loads(plain) for _ in range(rows)]


def _steps(rows: int, first: Any, steps: Any) -> list[Any]:
    return [*accumulate(_numbers([first, *values_of(steps, rows - 1)]))]


def _from_least(rows: int, least: Any, more: Any) -> list[Any]:
    _numbers([least])
    return [least + each for each in _numbers(values_of(more, rows))]


def _decimals(rows: int, decimals: Any, whole: Any) -> list[Any]:
    over = 10 ** _small(decimals)
    return [each / over for each in _numbers(values_of(whole, rows))]


def _small(decimals: Any) -> int:
    if type(decimals) is not int or not 0 <= decimals <= 9:
        raise BadColumns("no number of decimals")
    return decimals


def _numbers(values: list[Any]) -> list[int]:
    if set(map(type, values)) - {int}:
        raise BadColumns("what is no whole number")
    return values


def _fields(rows: int, fields: Any) -> list[Any]:
    """Name by name: three times as fast as row by row."""
    made: list[dict[str, Any]] = [{} for _ in range(rows)]
    for name, column in _required(fields, dict).items():
        for row, value in zip(made, _field(fields, column, rows), strict=True):
            row[name] = value
    return made


def _field(fields: Mapping[str, Any], column: Any, rows: int) -> list[Any]:
    """A column, which may tell its times by those of another."""
    if not isinstance(column, dict) or column.keys() != _AFTER:
        return values_of(column, rows)
    base = _times(fields, column["after"], rows)
    _numbers([ns := column["ns"]])
    return [*map(add, _numbers(values_of(column["by"], rows)), map(mul, base, repeat(ns)))]


def _times(fields: Mapping[str, Any], name: Any, rows: int) -> list[int]:
    """Of a field the whole numbers; of one in seconds those before its decimals."""
    column = fields.get(name) if isinstance(name, str) else None
    if isinstance(column, dict) and "decimals" in column:
        return _numbers(values_of(column.get("whole"), rows))
    return _numbers(_field(fields, column, rows))


def _required(value: Any, kind: type[Any]) -> Any:
    if not isinstance(value, kind):
        raise BadColumns(f"a column that is no {kind.__name__}")
    return value


def _stamps(rows: int, stamps_ns: Any) -> list[Any]:
    stamps = _numbers(values_of(stamps_ns, rows))
    return [{"sec": ns // NS_PER_S, "nanosec": ns % NS_PER_S} for ns in stamps]


def _places(rows: int, places: Any) -> list[Any]:
    columns = [values_of(column, rows) for column in _required(places, list)]
    return [*map(list, zip(*columns, strict=True))]


def _pieces(rows: int, pieces: Any) -> list[Any]:
    columns = [map(str, values_of(column, rows)) for column in _required(pieces, list)]
    return [*map("".join, zip(*columns, strict=True))]


def _lengths(rows: int, lengths: Any, items: Any) -> list[Any]:
    counts = _numbers(values_of(lengths, rows))
    if min(counts, default=0) < 0:
        raise BadColumns("a list shorter than nothing")
    every = iter(values_of(items, sum(counts)))
    return [[*islice(every, count)] for count in counts]


def _kinds(rows: int, kind: Any, kinds: Any) -> list[Any]:
    numbers = _numbers(values_of(kind, rows))
    count = Counter(numbers)
    columns = [
        iter(values_of(column, count.pop(number, 0)))
        for number, column in enumerate(_required(kinds, list))
    ]
    if count:
        raise BadColumns("a kind without its column")
    return [next(columns[number]) for number in numbers]


_AFTER = frozenset({"after", "ns", "by"})
_READ: dict[frozenset[str], Callable[..., list[Any]]] = {
    frozenset({"same"}): _same,
    frozenset({"first", "steps"}): _steps,
    frozenset({"least", "more"}): _from_least,
    frozenset({"decimals", "whole"}): _decimals,
    frozenset({"pieces"}): _pieces,
    frozenset({"fields"}): _fields,
    frozenset({"stamps_ns"}): _stamps,
    frozenset({"places"}): _places,
    frozenset({"lengths", "items"}): _lengths,
    frozenset({"kind", "kinds"}): _kinds,
}
