"""Lists of records as columns in JSON: what all rows have in common is written once.

A list of at least FEWEST_ROWS values is written as a table, where a form makes it shorter. A table
is the number of its `rows` beside a column of them. A column has one of these forms:

    [v, w, ...]                             the values, one by one
    {"same": v}                             each of them is v
    {"fields": {name: column}}              records, or objects with the same names in one order
    {"places": [column, ...]}               lists of one length: a column for each place in them
    {"lengths": column, "items": column}    lists of objects, one behind the other
    {"kind": column, "kinds": [column, ...]}    several kinds: the kind of each row, by its number,
                                            and a column of each kind
    {"first": i, "steps": column}           whole numbers: the first, then how much each is more
    {"least": i, "more": column}            how much each is more than the least of them
    {"after": name, "ns": i, "by": column}  times: so much later than i times the same row of
                                            another field, which may be whole numbers of `decimals`
    {"stamps_ns": column}                   a ROS time each, `sec` and `nanosec`
    {"decimals": n, "whole": column}        numbers of n decimals, without their point
    {"pieces": [column, ...]}               texts, in pieces: between numbers, number, and so on

What fits no form is written one by one, so nothing is lost. Numbers keep their kind, zeros their
sign, and objects the order of their names. `writing.py` chooses, `reading.py` reads.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypeVar

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, SerializationInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from roslings.record.reading import BadColumns, values_of
from roslings.record.writing import FEWEST_ROWS, MOST_ROWS, column_of

IN_COLUMNS = {"lists": "columns"}
"""The context of who writes JSON in columns: it is several times smaller, and takes longer."""
T = TypeVar("T")


def _as_they_are(rows: list[Any]) -> list[Any]:
    return rows


@dataclass(frozen=True)
class InColumns:
    """Of a list in a record: JSON may have it as a table, and gets it as one."""

    thinned: Callable[[list[Any]], list[Any]] = _as_they_are
    """Rows that are written in place of the rows: what can be reckoned from the rest is left out.

    Each keeps its number.
    """
    restored: Callable[[list[Any]], list[Any]] = _as_they_are
    """From those, as objects, to those that the list holds."""

    def __get_pydantic_core_schema__(self, source: Any, rest: GetCoreSchemaHandler) -> CoreSchema:
        """The list's own schema reads the rows: of a plain list no object is made in between."""
        rows = rest(source)
        table = core_schema.chain_schema(
            [
                core_schema.dict_schema(core_schema.str_schema()),
                core_schema.no_info_plain_validator_function(self._rows_of),
                rows,
            ]
        )
        return core_schema.union_schema(
            [(rows, "list"), (table, "table")],
            mode="left_to_right",
            serialization=core_schema.plain_serializer_function_ser_schema(
                self._as_asked, info_arg=True, when_used="json"
            ),
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, rest: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """A list, or the same as a table."""
        rows = schema["choices"][0][0]
        table = {"type": "object", "required": ["rows"], "description": "The list in columns"}
        return {"anyOf": [rest(rows), table]}

    def _as_asked(self, values: list[Any], info: SerializationInfo) -> Any:
        if info.context != IN_COLUMNS:
            return values
        table = table_of(self.thinned(values))
        return table if isinstance(table, dict) else values

    def _rows_of(self, table: Mapping[str, Any]) -> list[Any]:
        return self.restored(rows_of(table))


Columns = Annotated[list[T], InColumns()]
"""A list in a record, of which there may be many: a table in JSON, a list everywhere else."""


def table_of(values: Sequence[Any]) -> Any:
    """The values as JSON gets them: a table, or as they are where no form fits."""
    if not FEWEST_ROWS <= len(values) <= MOST_ROWS:
        return values
    column = column_of(values)
    return {"rows": len(values), **column} if isinstance(column, dict) else values


def rows_of(table: Mapping[str, Any]) -> list[Any]:
    """The rows of a table. Raises BadColumns."""
    column = dict(table)
    rows = column.pop("rows", None)
    if type(rows) is not int:
        raise BadColumns("a table does not say how many rows it has")
    try:
        return values_of(column, rows)
    except (OverflowError, RecursionError) as error:
        raise BadColumns("numbers or columns without an end") from error
