"""The room in which a robot says that it is: what its map shows around it.

It is listened to only while somebody publishes it, so the desk makes no topic appear; and a room
whose robot has ended is forgotten.
"""

from __future__ import annotations

from collections.abc import Iterable

from ros2_on_pip.interfaces import UnknownInterface
from roslings_desk.hub import SharedSubscription
from roslings_desk.tab import OpenTab
from roslings_rover.models.world import World, default_world
from roslings_rover.rover.room_markers import MARKERS, MOVING, ROOM, world_in


class RoomHeard:
    """What `/room` and `/room/moving` say, for a tab that is open."""

    def __init__(self, open_tab: OpenTab) -> None:
        self._tab = open_tab
        self._heard: dict[str, SharedSubscription] = {}
        self._unknown = False
        """This computer has not the type: the robot is on another one."""
        self._counts = self._counted()
        self.world = default_world()
        """The course's own room, where nobody says another one."""

    def look(self) -> bool:
        """Whether it is another world now."""
        self._follow()
        if (counts := self._counted()) == self._counts:
            return False
        self._counts = counts
        before, self.world = self.world, world_heard(self._heard.values())
        return self.world != before

    def _counted(self) -> dict[str, int]:
        return {topic: heard.count for topic, heard in self._heard.items()}

    def _follow(self) -> None:
        """Listen to what is published, and to nothing else."""
        said = {seen.name for seen in self._tab.hub.topics() if seen.publishers}
        for topic in (ROOM, MOVING):
            if topic in said and topic not in self._heard and not self._unknown:
                self._hear(topic)
            elif topic not in said and topic in self._heard:
                self._tab.leave(self._heard.pop(topic))

    def _hear(self, topic: str) -> None:
        try:
            self._heard[topic] = self._tab.hear(topic, MARKERS)
        except UnknownInterface:
            self._unknown = True


def world_heard(heard: Iterable[SharedSubscription]) -> World:
    """The room that was heard among other things; the course's own one, where that is none."""
    newest = {each.topic: each.newest() for each in heard if each.type_name == MARKERS}
    room = newest.get(ROOM)
    return (room and world_in(room, newest.get(MOVING))) or default_world()
