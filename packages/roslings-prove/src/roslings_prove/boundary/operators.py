"""What can go wrong at a place of the boundary: the operator's word, and the sentence for it."""

from __future__ import annotations

from collections.abc import Iterator

from roslings_prove.boundary.fields import MessageField

WORDS = {
    "zero": "is 0, false or empty",
    "negated": "has the other sign, or is the other truth",
    "absolute": "has no sign",
    "doubled": "is twice as much",
    "nan": "is not a number",
    "plus_one": "is one more",
    "of_before": "is that of the message before",
    "of_first": "is that of the first message",
    "turned_when_repeated": "is the other truth where it is the same as last time",
    "swapped": "is exchanged with the field beside it",
    "upper": "is in capital letters",
    "longer": "has a letter more at its end",
    "shorter": "has a letter less at its end",
    "drop_first": "the first message is lost",
    "drop_nth": "each fifth message is lost",
    "drop_second": "the second message is lost",
    "gap": "four of twenty messages are lost, one after the other",
    "drop_zeros": "messages whose numbers are all 0 are lost",
    "drop_negatives": "messages with a number below 0 are lost",
    "drop_nan": "messages with NaN are lost",
    "drop_repeats": "messages that say the same as the one before are lost",
    "stops_after": "after six there are no more",
    "once": "there is one, and no more",
    "twice": "each comes twice",
    "extra_at_start": "an empty message comes before the first that is heard",
    "late": "each comes 0.3 s late",
    "no_second": "the second request gets no answer",
    "second_cancel_refused": "the second request to cancel is refused",
    "other_default": "has another default",
    "bound_ignored": "takes what it must refuse",
    "nan_let_in": "takes NaN",
    "infinity_let_in": "takes infinity",
    "second_change_only": "takes the first change only in words",
    "not_described": "does not tell its range",
    "reliability": "has the other reliability",
    "durability": "has the other durability",
    "extra_ends": "a publisher and a subscription that nobody asked for",
    "exit_code": "ends with exit code 3",
    "ends_late": "ends 4 s late",
    "ends_after": "ends after twelve messages and calls",
}
"""Operator to what is wrong, for people; `layer.py` does it."""

AIMED = frozenset(
    {
        "zero",
        "negated",
        "absolute",
        "nan",
        "of_before",
        "of_first",
        "turned_when_repeated",
        "drop_nth",
        "drop_zeros",
        "drop_negatives",
        "drop_nan",
        "drop_repeats",
        "stops_after",
        "no_second",
        "second_cancel_refused",
        "nan_let_in",
        "infinity_let_in",
        "second_change_only",
    }
)
"""Kinds that have found holes: fields that nothing fills, another sign, zero, NaN, repeats, the
n-th time, and what was said before. Half of a lab's packages are of these."""

FLOW: dict[str, tuple[str, ...]] = {
    "sent": (
        "drop_nth",
        "drop_zeros",
        "drop_repeats",
        "twice",
        "extra_at_start",
        "late",
        "stops_after",
        "drop_first",
        "drop_second",
        "gap",
    ),
    "heard": (
        "drop_zeros",
        "drop_negatives",
        "drop_nan",
        "drop_repeats",
        "drop_first",
        "drop_nth",
        "stops_after",
        "twice",
        "drop_second",
        "gap",
    ),
    "request": (),
    "response": ("no_second", "stops_after"),
    "asked": ("twice",),
    "goal": (),
    "ordered": (),
    "feedback": ("once", "drop_nth", "twice", "stops_after"),
    "result": (),
    "read": ("drop_first", "drop_nth", "stops_after", "drop_second", "gap"),
}
"""Kind of place to what may happen to whole messages there."""

FIELD: dict[str, dict[str, tuple[str, ...]]] = {
    "sent": {
        "number": (
            "zero",
            "negated",
            "absolute",
            "doubled",
            "nan",
            "plus_one",
            "of_before",
            "swapped",
        ),
        "bool": ("negated", "of_before"),
        "string": ("zero", "of_before", "upper", "longer", "shorter"),
    },
    "heard": {
        "number": ("zero", "absolute", "negated", "of_before", "swapped"),
        "bool": ("negated", "of_before"),
        "string": ("zero", "of_before", "upper", "longer", "shorter"),
    },
    "request": {
        "number": ("zero", "of_before"),
        "bool": ("zero", "of_before"),
        "string": ("zero", "of_before"),
    },
    "response": {
        "number": ("zero", "negated"),
        "bool": ("negated", "turned_when_repeated"),
        "string": ("zero", "of_first", "of_before", "upper", "longer", "shorter"),
    },
    "asked": {"number": ("zero", "negated"), "bool": ("negated",), "string": ("zero",)},
    "goal": {
        "number": ("zero", "negated", "of_before"),
        "bool": ("negated", "of_before"),
        "string": ("zero", "of_before"),
    },
    "ordered": {"number": ("zero", "negated"), "bool": ("negated",), "string": ("zero",)},
    "feedback": {
        "number": ("zero", "negated", "doubled", "plus_one", "of_before", "swapped"),
        "bool": ("negated",),
        "string": ("zero",),
    },
    "result": {
        "number": ("zero", "negated", "doubled", "nan", "of_before"),
        "bool": ("negated", "of_before"),
        "string": ("zero", "of_before"),
    },
    "read": {
        "number": ("zero", "absolute", "of_before", "swapped"),
        "bool": (),
        "string": (),
    },
}
"""Kind of place, and of value, to what may happen to one field there."""


def of_field(kind: str, field: MessageField) -> Iterator[str]:
    """The operators for a field at a place of this kind."""
    for operator in FIELD[kind]["number" if field.is_number else field.kind]:
        fits_unsigned = operator not in ("negated", "absolute")
        if field.kind == "float" or (
            operator != "nan" and (field.kind != "unsigned" or fits_unsigned)
        ):
            yield operator


def of_flow(kind: str, fields: list[MessageField]) -> Iterator[str]:
    """The operators for whole messages at a place of this kind."""
    kinds = {field.kind for field in fields}
    for operator in FLOW[kind]:
        needs = {
            "drop_nan": {"float"},
            "drop_negatives": {"float", "int"},
            "drop_zeros": {"float", "int", "unsigned", "bool"},
        }
        if operator not in needs or needs[operator] & kinds:
            yield operator
