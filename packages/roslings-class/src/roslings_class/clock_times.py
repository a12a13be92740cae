"""Dates and times as people and platforms write them, and the zone in which they are read."""

from __future__ import annotations

from datetime import datetime, tzinfo
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from roslings_class.errors import BatchError

EXAMPLES = "2026-11-30T23:59, 2026-11-30T23:59+01:00 or '2026-11-30 23:59 Europe/Berlin'"
COMPUTERS_OWN = ""
"""The name of the zone that this computer's clock shows."""


class NoSuchZone(BatchError):
    """Nobody here knows a time zone of this name."""

    def __init__(self, name: str) -> None:
        super().__init__(
            f"No time zone {name!r} is known here.",
            "Write the hours from UTC instead: 2026-11-30T23:59+01:00",
        )


def zone_named(name: str) -> tzinfo | None:
    """The zone `Europe/Berlin` or `+01:00`; None for the computer's own. Raises NoSuchZone."""
    if name == COMPUTERS_OWN:
        return None
    try:
        if name[0] in "+-":
            return datetime.fromisoformat(f"2000-01-01T00:00{name}").tzinfo
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError):
        raise NoSuchZone(name) from None


def as_time(text: str, zone: tzinfo | None = None) -> datetime:
    """A date and time; what names no zone is of `zone`, and without one of the computer's.

    Raises ValueError for what is no time, NoSuchZone.
    """
    moment, name = _apart(text.strip())
    time = datetime.fromisoformat(moment.replace("Z", "+00:00"))
    if time.tzinfo and not name:
        return time
    return in_zone(time.replace(tzinfo=None), zone_named(name) if name else zone)


def in_zone(time: datetime, zone: tzinfo | None) -> datetime:
    """What a clock on a wall of this zone shows; None is the computer's own zone."""
    return time.replace(tzinfo=zone) if zone else time.astimezone()


def zone_of(text: str) -> str:
    """What a time says of its zone, as `zone_named` takes it. Raises ValueError, NoSuchZone."""
    _, name = _apart(text.strip())
    if name:
        zone_named(name)
        return name
    time = datetime.fromisoformat(text.strip().replace("Z", "+00:00"))
    return f"{time:%z}"[:3] + ":" + f"{time:%z}"[3:5] if time.tzinfo else COMPUTERS_OWN


def _apart(text: str) -> tuple[str, str]:
    """The time, and the name of a zone behind it: `2026-11-30 23:59 Europe/Berlin`."""
    moment, _, last = text.rpartition(" ")
    is_zone = bool(moment) and any(char.isalpha() for char in last)
    return (moment.strip(), last) if is_zone else (text, "")


def shown(time: datetime) -> str:
    """For a person: `Monday 30 November 2026, 23:59 (UTC+01:00)`."""
    zone = f"{time:%z}"
    hours = f"UTC{zone[:3]}:{zone[3:5]}" if zone.strip("+-0") else "UTC"
    return f"{time:%A} {time.day} {time:%B %Y, %H:%M} ({hours})"
