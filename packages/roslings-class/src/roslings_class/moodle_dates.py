"""The dates in Moodle's grading worksheet.

What its columns hold is from mod/assign/gradingtable.php. `Last modified (submission)` is the time
of the hand-in (`userdate`), of the team's where teams hand in, and `-` where nothing is. `Status`
ends with `Extension granted until: DATE` where an instructor has granted one. The words are of the
language in which Moodle is read, and the clock is the reader's own: no zone is written. So the
names of the months are a table, to which others can be added; what is not understood is no date.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from datetime import datetime
from functools import cache

MONTHS = {
    "de": "januar februar märz april mai juni juli august september oktober november dezember",
    "en": "january february march april may june july august september october november december",
    "es": "enero febrero marzo abril mayo junio julio agosto septiembre octubre noviembre"
    " diciembre",
    "fr": "janvier février mars avril mai juin juillet août septembre octobre novembre décembre",
    "it": "gennaio febbraio marzo aprile maggio giugno luglio agosto settembre ottobre novembre"
    " dicembre",
    "nl": "januari februari maart april mei juni juli augustus september oktober november december",
    "pt": "janeiro fevereiro março abril maio junho julho agosto setembro outubro novembro"
    " dezembro",
}
"""Language to its months, from the first to the twelfth; they may be cut short (`nov`)."""
SUBMITTED = (
    "last modified (submission)",
    "zuletzt geändert (abgabe)",
    "última modificación (entrega)",
    "última modificação (envio)",
    "ultima modifica (consegna)",
    "上次修改（作业）",  # noqa: RUF001
)
"""`lastmodifiedsubmission` of Moodle's language packs (mod/assign), in small letters."""
STATUS = "status"
SHORTEST = 3
"""Letters of a month that is cut short: `nov`."""
_CHINESE = re.compile(r"(\d{4})年\s*(\d{1,2})月\s*(\d{1,2})日")
_YEAR, _DAY = (
    re.compile(r"(?<!\d)((?:19|20)\d\d)(?!\d)"),
    re.compile(r"(?<![\d:.])(\d{1,2})(?![\d:])"),
)
_CLOCK = re.compile(r"(?<!\d)(\d{1,2})[:h](\d\d)(?:[:h]\d\d)?")
_WORD = re.compile(r"[^\W\d_]+")
_AFTERNOON = re.compile(r"\bp\.?\s?m\b|下午", re.IGNORECASE)
_MORNING = re.compile(r"\ba\.?\s?m\b|上午", re.IGNORECASE)


def moodle_time(text: str) -> datetime | None:
    """The time, without a zone; None where the text holds none that is understood for sure."""
    clock = _CLOCK.search(text)
    date = _date(text[: clock.start()] + text[clock.end() :]) if clock else None
    if clock is None or date is None:
        return None
    try:
        return datetime(*date, _hour(int(clock[1]), text), int(clock[2]))
    except ValueError:
        return None


def submitted_at(cells: Mapping[str, str]) -> datetime | None:
    """When a line of the worksheet says that its student handed in."""
    told = (cells[column] for column in SUBMITTED if column in cells)
    return next((time for text in told if (time := moodle_time(text))), None)


def extended_to(cells: Mapping[str, str]) -> datetime | None:
    """Until when a line of the worksheet says that its student has time.

    It stands last in `Status`, behind ` - `; how late somebody is, is told in days and hours.
    """
    is_of_a_worksheet = any(column in cells for column in SUBMITTED)
    *_, last = cells.get(STATUS, "").split(" - ")
    return moodle_time(last) if is_of_a_worksheet else None


def _date(text: str) -> tuple[int, int, int] | None:
    if found := _CHINESE.search(text):
        return int(found[1]), int(found[2]), int(found[3])
    year = _YEAR.search(text)
    months = set(_months_in(text))
    day = _DAY.search(text)
    if year is None or day is None or len(months) != 1:
        return None
    return int(year[1]), months.pop(), int(day[1])


def _months_in(text: str) -> Iterator[int]:
    """The numbers of the months that the words name."""
    for word in _WORD.findall(plain(text)):
        cut = {(number, name) for number, name in _names() if name.startswith(word)}
        named = {number for number, name in cut if name == word}
        found = named or ({number for number, _ in cut} if len(word) >= SHORTEST else set())
        if len(found) == 1:
            yield found.pop()


@cache
def _names() -> tuple[tuple[int, str], ...]:
    in_all = (enumerate(plain(months).split(), start=1) for months in MONTHS.values())
    return tuple(numbered for months in in_all for numbered in months)


def plain(text: str) -> str:
    """In small letters without accents: `Août` is `aout`."""
    apart = unicodedata.normalize("NFKD", text.casefold())
    return "".join(char for char in apart if not unicodedata.combining(char))


def _hour(hour: int, text: str) -> int:
    if _AFTERNOON.search(text):
        return hour % 12 + 12
    return hour % 12 if _MORNING.search(text) else hour
