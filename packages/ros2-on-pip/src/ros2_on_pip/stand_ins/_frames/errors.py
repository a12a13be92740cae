"""What cannot be looked up, in geometry2's words: students search the web for them.

`COMMANDS.md` has the same texts in a table, with the file of geometry2 that each stands in.
"""

from __future__ import annotations

NANOSECONDS = 1_000_000_000


class TransformException(Exception):
    """Above all others of tf2."""


class ConnectivityException(TransformException):
    """No path leads from one frame to the other."""


class LookupException(TransformException):
    """There is no such frame, or the tree is none."""


class ExtrapolationException(TransformException):
    """Nothing is known of that time."""


class InvalidArgumentException(TransformException):
    """A name that no frame can have."""


class TimeoutException(TransformException):
    """It did not come in time. Jazzy's Buffer never raises it: it says what is missing instead."""


EXCEPTIONS = (
    TransformException,
    ConnectivityException,
    LookupException,
    ExtrapolationException,
    InvalidArgumentException,
    TimeoutException,
)
for _each in EXCEPTIONS:
    _each.__module__ = "tf2"  # as a traceback of the real one has it: tf2.LookupException

EMPTY = "in tf2 frame_ids cannot be empty"
SLASH = "in tf2 frame_ids cannot start with a '/'"
UNKNOWN = "frame does not exist"

BAD_NAME = 'Invalid argument "{frame}" passed to {argument} - {why}'
NO_FRAME = '"{frame}" passed to {argument} does not exist. '
NO_SUCH_ID = 'Invalid frame ID "{frame}" passed to {argument} - {why}'
NOT_CONNECTED = (
    "Could not find a connection between '{target}' and '{source}' because they are not part of the"
    " same tree.Tf has two or more unconnected trees."
)
LOOP = "The tf tree is invalid because it contains a loop.\n{frames}\n"
ONE_TIME = (
    "Lookup would require extrapolation at time {asked}, but only time {known} is in the buffer"
)
FUTURE = (
    "Lookup would require extrapolation into the future.  Requested time {asked}"
    " but the latest data is at time {known}"
)
PAST = (
    "Lookup would require extrapolation into the past.  Requested time {asked}"
    " but the earliest data is at time {known}"
)
ON_THE_WAY = ", when looking up transform from frame [{source}] to frame [{target}]"

SELF_TRANSFORM = (
    'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and '
    ' child_frame_id "{child}" because they are the same'
)
NO_CHILD = (
    'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because child_frame_id'
    " not set "
)
NO_PARENT = (
    'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority'
    ' "{authority}" because frame_id not set'
)
NAN = (
    'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}"'
    " because of a nan value in the transform ({shift}) ({rotation})"
)
NOT_NORMALIZED = (
    'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority'
    ' "{authority}" because of an invalid quaternion in the transform ({rotation})'
)
OLD = (
    "TF_OLD_DATA ignoring data from the past for frame {child} at time {time} according to"
    " authority {authority}\nPossible reasons are listed at"
    " http://wiki.ros.org/tf/Errors%20explained"
)


def seconds(time_ns: int) -> str:
    """A time as these texts have it."""
    return f"{time_ns / NANOSECONDS:.6f}"
