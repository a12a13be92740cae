"""Lists of records in columns: nothing is lost, whatever they hold, and they are much smaller."""

from __future__ import annotations

import dataclasses
import json
import random
import types
import typing
import zlib
from collections.abc import Iterator
from functools import cache
from typing import Annotated, Any, Literal

import pytest
from judged_words import LABS, evidence_of
from pydantic import BaseModel, TypeAdapter, ValidationError

from roslings.capability import capabilities
from roslings.evidence import (
    Evidence,
    MessageSeen,
    evidence_json,
    read_json,
    thin_json,
)
from roslings.record import Columns, Record
from roslings.record.columns import IN_COLUMNS, InColumns, rows_of, table_of
from roslings.record.reading import values_of
from roslings.record.writing import FEWEST_ROWS, column_of
from roslings_class.grading import THOROUGHLY, packed, unpacked

Value = Any


# --- every record that is written in columns ---------------------------------------------------


@cache
def fields() -> dict[str, tuple[Any, InColumns | None]]:
    """Every list of records in evidence, its parts included: (of what, how in columns)."""
    found: dict[str, tuple[Any, InColumns | None]] = {}
    for model in models():
        for name, annotation in typing.get_type_hints(model, include_extras=True).items():
            for of, in_columns in lists_in(annotation):
                found[f"{model.__name__}.{name}"] = of, in_columns
    return found


def models() -> Iterator[Any]:
    """Evidence, and all records that it holds."""
    waiting: list[Any] = [Evidence, *(each.seen for each in capabilities() if each.seen)]
    seen = set()
    while waiting:
        if (model := waiting.pop()) in seen:
            continue
        seen.add(model)
        yield model
        for annotation in typing.get_type_hints(model).values():
            waiting += [each for each in inner(annotation) if is_record(each)]


def inner(annotation: Any) -> Iterator[Any]:
    """An annotation and all that it is made of."""
    yield annotation
    for each in typing.get_args(annotation):
        yield from inner(each)


def is_record(kind: Any) -> bool:
    """One of ours, with slots or without."""
    is_model = isinstance(kind, type) and issubclass(kind, BaseModel)
    return is_model or (isinstance(kind, type) and dataclasses.is_dataclass(kind))


def lists_in(
    annotation: Any, mark: InColumns | None = None
) -> Iterator[tuple[Any, InColumns | None]]:
    """The lists of records in an annotation, and how they are in columns."""
    if typing.get_origin(annotation) is list and is_record(typing.get_args(annotation)[0]):
        yield typing.get_args(annotation)[0], mark
    marks = [
        each for each in getattr(annotation, "__metadata__", ()) if isinstance(each, InColumns)
    ]
    for each in typing.get_args(annotation):
        yield from lists_in(each, *marks)


def test_every_list_of_records_is_in_columns() -> None:
    """But for experiments, which are few, and for pictures, which have nothing in common."""
    plain = {name for name, (_, mark) in fields().items() if mark is None}
    assert plain == {"Evidence.attempts", "CameraSeen.pictures"}
    assert {"TopicSeen.messages", "BoardSeen.told", "ProcessSeen.lines"} <= fields().keys()


ROWS = {name: (of, mark) for name, (of, mark) in fields().items() if mark}


@pytest.mark.parametrize("name", ROWS)
def test_any_record_comes_back_as_it_was(name: str) -> None:
    """Random ones, of one shape and of several, some lists of each."""
    of, mark = ROWS[name]
    whole = TypeAdapter(Annotated[list[of], mark])  # type: ignore[valid-type]
    for seed in range(25):
        draw = Draw(random.Random(f"{name} {seed}"))
        rows = draw.rows(of)
        content = whole.dump_json(rows, context=IN_COLUMNS)
        again = whole.validate_json(content)
        assert repr(again) == repr(whole.validate_json(whole.dump_json(rows))) == repr(rows), seed
        assert len(content) <= len(whole.dump_json(rows)) + 40 * len(rows), seed


# --- whatever JSON holds -----------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(400))
def test_any_values_come_back_as_they_were(seed: int) -> None:
    """Of their kind, with their sign, in order: `repr` tells 1 from 1.0, 0.0 from -0.0."""
    draw = Draw(random.Random(seed))
    shape = draw.shape(3)
    values = [draw.value(shape) for _ in range(draw.random.choice((1, 2, 6, 7, 30, 120)))]
    column = json.loads(json.dumps(column_of(values)))
    assert repr(values_of(column, len(values))) == repr(values)
    turned = json.loads(json.dumps(column, sort_keys=True))
    assert values_of(turned, len(values)) == values, "a form depends on the order of its words"


class Draw:
    """Random values; those of one shape look alike, as the messages of one topic do."""

    TEXTS = (
        *("", "a", "ü ñ \u2028", "[INFO] [1795728112.374]: hello 7", "007", "١٢"),
        *("$W,1,20*F2F8", "$M,1,100,-100*7AC2", "$M,1,100,-100*", "*", "$*\n"),
    )
    WHOLE = (0, 1, -1, 7, 2**31, 2**63, -(2**70), 1_795_728_112_374_779_239)
    NUMBERS = (0.0, -0.0, 1.0, 0.1, -2.618, 1e300, 5e-324, 0.30000000000000004, 4503599627.370497)

    def __init__(self, numbers: random.Random) -> None:
        self.random = numbers
        self.at_ns = numbers.choice((0, 886_735_498_201))

    def rows(self, kind: Any) -> list[Any]:
        """Rows of one record; some fields are the same in all."""
        first = self.of(kind)
        rows = []
        for _ in range(self.random.choice((0, 1, FEWEST_ROWS - 1, FEWEST_ROWS, 9, 40))):
            row = self.of(kind)
            for name in names_of(kind):
                if self.random.random() < 0.4:
                    setattr(row, name, getattr(first, name))
            rows.append(row)
        return rows

    def of(self, annotation: Any) -> Any:
        """A value of a field."""
        origin, inside = typing.get_origin(annotation), typing.get_args(annotation)
        if annotation in (Any, object):
            return self.value(self.shape(2))
        if is_record(annotation):
            hints = typing.get_type_hints(annotation)
            return annotation(**{name: self.of(hints[name]) for name in names_of(annotation)})
        if origin is Literal:
            return self.random.choice(inside)
        if origin in (typing.Union, types.UnionType):
            return self.of(self.random.choice(inside))
        if origin is list:
            return [self.of(inside[0]) for _ in range(self.random.choice((0, 1, 2, 16)))]
        if origin is tuple:
            return tuple(self.of(each) for each in inside)
        if origin is dict:
            return {self.random.choice("abcd"): self.of(inside[1]) for _ in range(3)}
        return None if annotation in (None, type(None)) else self.value(annotation)

    def shape(self, depth: int) -> Any:
        """What values look alike: a kind, a mixture, the names of objects, the length of lists."""
        kinds = [bool, int, float, str, "nothing", "times", "rounded", "one", "mixed", "stamp"]
        kind = self.random.choice([*kinds, *(["object", "list", "lists"] * 2 if depth else [])])
        if kind == "one":
            return kind, self.value(self.shape(0))
        if kind == "mixed":
            return kind, [self.shape(max(depth - 1, 0)) for _ in range(2)]
        if kind == "object":
            names = self.random.sample(["x", "y", "at_ns", "to_ns", "for_s", "same"], 3)
            return kind, {name: self.shape(depth - 1) for name in names}
        if kind in ("list", "lists"):
            return kind, (self.random.randrange(4), self.shape(depth - 1))
        return kind

    def value(self, shape: Any) -> Value:
        """A value of this shape."""
        kind, rest = shape if isinstance(shape, tuple) else (shape, None)
        return getattr(self, f"_{getattr(kind, '__name__', kind)}")(rest)

    def _bool(self, _: Any) -> bool:
        return self.random.random() < 0.5

    def _int(self, _: Any) -> int:
        return self.random.choice((*self.WHOLE, self.random.randrange(-300, 300)))

    def _float(self, _: Any) -> float:
        return self.random.choice((*self.NUMBERS, self.random.gauss(0, 1)))

    def _str(self, _: Any) -> str:
        some = f"[INFO] [{self.random.random()}] [node]: number {self.random.randrange(99)}"
        return self.random.choice((some, some, *self.TEXTS))

    def _nothing(self, _: Any) -> None:
        return None

    def _times(self, _: Any) -> int:
        self.at_ns += 20_000_000 + self.random.randrange(10_000)
        return self.at_ns

    def _rounded(self, _: Any) -> float:
        return round(self.random.gauss(0, 5), self.random.choice((3, 6)))

    def _one(self, value: Any) -> Value:
        return json.loads(json.dumps(value))

    def _mixed(self, shapes: Any) -> Value:
        return self.value(self.random.choice(shapes))

    def _stamp(self, _: Any) -> dict[str, int]:
        ns = self._times(_) if self.random.random() < 0.99 else -5
        return {"sec": ns // 1_000_000_000, "nanosec": ns % 1_000_000_000}

    def _object(self, shapes: Any) -> dict[str, Value]:
        return {name: self.value(shape) for name, shape in shapes.items()}

    def _list(self, shape: Any) -> list[Value]:
        return [self.value(shape[1]) for _ in range(shape[0])]

    def _lists(self, shape: Any) -> list[Value]:
        return [self.value(shape[1]) for _ in range(self.random.randrange(4))]


def names_of(kind: Any) -> list[str]:
    """The fields of a record."""
    if dataclasses.is_dataclass(kind):
        return [each.name for each in dataclasses.fields(kind)]
    return [*kind.model_fields]


# --- the forms ---------------------------------------------------------------------------------

BEGAN_NS = 1_795_728_064_578_431_505
COVARIANCE = [0.0] * 36
FORMS: dict[str, tuple[list[Value], Value]] = {
    "one by one": ([0.5, 0.1234567, 3e-9], [0.5, 0.1234567, 3e-9]),
    "the same": (["a", "a", "a"], {"same": "a"}),
    "the same object": ([{"x": 1.0}] * 3, {"same": {"x": 1.0}}),
    "the same list": ([COVARIANCE] * 3, {"same": COVARIANCE}),
    "zeros with signs": ([0.0, -0.0, 0.0], [0.0, -0.0, 0.0]),
    "one and true": ([1, True, 1], [1, True, 1]),
    "one and 1.0 in lists": ([[1.0], [1], [1.0]], {"places": [[1.0, 1, 1.0]]}),
    "counted": ([*range(500, 540)], {"first": 500, "steps": {"same": 1}}),
    "decimals": (
        [n / 1000 for n in range(7000, 7100, 10)],
        {"decimals": 3, "whole": {"first": 7000, "steps": {"same": 10}}},
    ),
    "stamps": (
        [{"sec": n // 4, "nanosec": n % 4 * 250_000_000} for n in range(8)],
        {"stamps_ns": {"first": 0, "steps": {"same": 250_000_000}}},
    ),
    "texts": (
        [f"hello {n}!" for n in range(500, 540)],
        {
            "pieces": [
                {"same": ""},
                {"same": "hello"},
                {"same": " "},
                {"first": 500, "steps": {"same": 1}},
                {"same": "!"},
            ]
        },
    ),
    "two kinds": (
        [{"a": 1}, {"b": 2}] * 6,
        {"kind": [0, 1] * 6, "kinds": [{"same": {"a": 1}}, {"same": {"b": 2}}]},
    ),
    "lists of several lengths": (
        [[{"x": True}] * n for n in (1, 0, 2)],
        {"lengths": [1, 0, 2], "items": {"same": {"x": True}}},
    ),
    "a time after another": (
        [
            {"at_ns": BEGAN_NS + n**3 * 977_777, "to_ns": BEGAN_NS + n**3 * 977_777 + 5 + n % 2}
            for n in range(40)
        ],
        {"after": "at_ns", "ns": 1, "by": [5, 6] * 20},
    ),
}


@pytest.mark.parametrize("name", FORMS)
def test_each_form_is_taken_where_it_fits(name: str) -> None:
    """And is read back, also where a program between us sorted its words."""
    values, wanted = FORMS[name]
    column = column_of(values)
    inside = column.get("fields", {}) if isinstance(column, dict) else {}
    assert column == wanted or wanted in inside.values()
    assert repr(values_of(json.loads(json.dumps(column)), len(values))) == repr(values)


def test_rows_that_are_the_same_are_not_one() -> None:
    """Who changes one message changes no other."""
    first, second, *_ = rows_of({"rows": 6, "same": {"x": [1]}})
    first["x"].append(2)
    assert second == {"x": [1]}


@pytest.mark.parametrize("number", [float("nan"), float("inf"), float("-inf")])
def test_what_is_no_number_is_a_text_as_before(number: float) -> None:
    """JSON has no such numbers; float() reads the texts."""
    content = [{"x": number, "y": [number, n]} for n in range(9)]
    rows = [
        MessageSeen(source_ns=1, sequence=None, arrival_ns=n, size=4, content=each)
        for n, each in enumerate(content)
    ]
    thin = Holder.model_validate_json(Holder(rows=rows).model_dump_json(context=IN_COLUMNS))
    plain = Holder.model_validate_json(Holder(rows=rows).model_dump_json())
    assert thin == plain
    assert float(thin.rows[3].content["x"]) == pytest.approx(number, nan_ok=True)


class Holder(Record):
    """A record with a list, as evidence is."""

    rows: Columns[MessageSeen]


def test_few_rows_stay_as_they_are() -> None:
    """They are read more easily so."""
    rows = [{"a": 1}] * (FEWEST_ROWS - 1)
    assert table_of(rows) is rows
    assert table_of([]) == []


DAMAGED: dict[str, Value] = {
    "no rows": {"fields": {}},
    "rows that are none": {"rows": True, "same": 1},
    "more rows than anybody has": {"rows": 10**12, "same": 1},
    "fewer than none": {"rows": -1, "same": 1},
    "a form that nobody knows": {"rows": 6, "sames": 1},
    "a column that is too short": {"rows": 6, "fields": {"arrival_ns": [1, 2]}},
    "fields that are a list": {"rows": 6, "fields": [1]},
    "steps that are texts": {"rows": 3, "first": 1, "steps": ["a", "b"]},
    "a step that is too much": {"rows": 3, "first": 1, "steps": [1, 1, 1]},
    "a time after itself": {
        "rows": 2,
        "fields": {"a_ns": {"after": "a_ns", "ns": 1, "by": [1, 2]}},
    },
    "a time after nothing": {"rows": 2, "fields": {"a_ns": {"after": "b", "ns": 1, "by": [1, 2]}}},
    "numbers without an end": {"rows": 2, "decimals": 6, "whole": [10**400, 1]},
    "decimals without an end": {"rows": 2, "decimals": 10**9, "whole": [1, 1]},
    "a kind without a column": {"rows": 2, "kind": [0, 1], "kinds": [[1]]},
    "a kind too many": {"rows": 2, "kind": [0, 0], "kinds": [[1, 2], [3]]},
    "lists shorter than nothing": {"rows": 2, "lengths": [-1, 1], "items": []},
    "more items than anybody has": {"rows": 2, "lengths": {"same": 10**9}, "items": {"same": 1}},
    "places that are no list": {"rows": 2, "places": {"0": [1, 2]}},
    "right columns of a wrong record": {"rows": 6, "fields": {"colour": {"same": "red"}}},
}


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_table_is_refused(name: str) -> None:
    """With pydantic's own error, which every reader of evidence expects."""
    with pytest.raises(ValidationError):
        Holder.model_validate_json(json.dumps({"rows": DAMAGED[name]}))


# --- real evidence -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", LABS)
def test_real_evidence_comes_back_as_it_was(name: str) -> None:
    """The solution and some wrong packages of each lab: to the sign of a zero."""
    for package, evidence in evidence_of(name):
        again = read_json(thin_json(evidence))
        assert again == evidence, package
        assert evidence_json(again) == evidence_json(evidence), package
        assert thin_json(again) == thin_json(evidence), package


def test_what_gradebooks_hold_is_read() -> None:
    """Also what was packed before there were columns."""
    evidence = dict(evidence_of("topics"))["solution"]
    assert unpacked(packed(evidence)) == evidence
    assert unpacked(packed(evidence, THOROUGHLY)) == evidence
    assert unpacked(zlib.compress(evidence_json(evidence))) == evidence


SMALLER = {"serial-bridge": 3.5, "actions": 1.7, "nodes": 1.6, "topics": 1.6}
"""Lab to how many times smaller the columns of its solution are, at least; others 1.3."""


@pytest.mark.parametrize("name", LABS)
def test_columns_are_several_times_smaller(name: str) -> None:
    """What many messages have in common is written once."""
    evidence = dict(evidence_of(name))["solution"]
    for seen in evidence.runs:
        seen.parts.pop("camera", None)  # pictures are as small as they get
    times = len(evidence_json(evidence)) / len(thin_json(evidence))
    assert times >= SMALLER.get(name, 1.3), times
