"""Messages with a header, moved from their frame into another; by type, as others register them."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar

from rclpy.duration import Duration
from std_msgs.msg import Header

Function = Callable[..., Any]
NO_WAIT = Duration()


class TypeException(Exception):
    """Nobody has registered how a type is moved or converted."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """A buffer of somebody's own cannot look up."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class BufferInterface:
    """What moves messages by the look-ups of its subclass."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = NO_WAIT, new_type: Any = None
    ) -> Any:
        """The same message in the target frame, looked up at the message's own time.

        Raises TypeException where no package that moves its type was imported, and as
        `lookup_transform`.
        """
        move = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _as_type(move(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = NO_WAIT,
        new_type: Any = None,
    ) -> Any:
        """The same, in the target frame at another time; `fixed_frame` does not move between."""
        move = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _as_type(move(object_stamped, found), new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NO_WAIT
    ) -> Any:
        """A subclass does it."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_WAIT,
    ) -> Any:
        """A subclass does it."""
        raise NotImplementedException

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NO_WAIT
    ) -> Any:
        """A subclass does it."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_WAIT,
    ) -> Any:
        """A subclass does it."""
        raise NotImplementedException


def _as_type(moved: Any, new_type: Any) -> Any:
    return moved if new_type is None else convert(moved, new_type)


class TransformRegistration:
    """How messages are moved: one table for all buffers, by type."""

    _moves: ClassVar[dict[Any, Function]] = {}

    def add(self, key: Any, callback: Function) -> None:
        """`callback(message, transform)` moves messages of the type `key`."""
        self._moves[key] = callback

    def get(self, key: Any) -> Function:
        """Raises TypeException."""
        return _registered(self._moves, key)


class ConvertRegistration:
    """How types become others: one table for all, each to and from a message, or at once."""

    _to_msg: ClassVar[dict[Any, Function]] = {}
    _from_msg: ClassVar[dict[Any, Function]] = {}
    _at_once: ClassVar[dict[Any, Function]] = {}

    def add_from_msg(self, key: Any, callback: Function) -> None:
        """`callback(message)` makes an object of the type `key`."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Function) -> None:
        """`callback(object)` makes a message of one of the type `key`."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Function) -> None:
        """`callback(object)` makes, of one of the first type, one of the second."""
        self._at_once[key] = callback

    def get_from_msg(self, key: Any) -> Function:
        """Raises TypeException."""
        return _registered(self._from_msg, key)

    def get_to_msg(self, key: Any) -> Function:
        """Raises TypeException."""
        return _registered(self._to_msg, key)

    def get_convert(self, key: tuple[Any, Any]) -> Function:
        """Raises TypeException."""
        return _registered(self._at_once, key)


def _registered(table: dict[Any, Function], key: Any) -> Function:
    if key not in table:
        raise TypeException(f"Type {key} is not loaded or supported")
    return table[key]


def convert(a: Any, b_type: Any) -> Any:
    """An object as another type. Raises TypeException."""
    known = ConvertRegistration()
    try:
        return known.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
        return known.get_from_msg(b_type)(known.get_to_msg(type(a))(a))


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802  Jazzy's name
    """The same object, with a header."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj
