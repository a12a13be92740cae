"""Image: the picture of a topic, raw or compressed, with its brightness in a number."""

from __future__ import annotations

from roslings_desk.controls import Notice, PageText, SelectField, StatusLine, button, part, told
from roslings_desk.hub import SharedSubscription
from roslings_desk.pictures import picture_of
from roslings_desk.shown import topic_of
from roslings_desk.tab import OpenTab

TYPES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
NOTHING = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' width='4' height='3'/%3E"


class ImageTab:
    """The newest picture of the topic that was chosen."""

    title, every_s = "Image", 0.08

    def __init__(self) -> None:
        self._heard: SharedSubscription | None = None
        self._drawn = self._shown = 0

    def show(self, open_tab: OpenTab) -> None:
        """A list of topics with pictures; nothing is chosen yet."""
        self._open = open_tab
        trouble = Notice()
        with part("div", "row"):
            self._topic = SelectField("Topic")
            button("Say the brightness", lambda: self._spoken.say(self._bright.text))
        self._topic.on_change(told(trouble, self._choose))
        self._bright = PageText("p", "", "value")
        self._count = PageText("p", "Choose a topic.", "hint")
        self._spoken = StatusLine()
        self._wanted = topic_of(open_tab.shown)
        self._picture = part("img", "picture", alt="No picture yet", src=NOTHING, hidden=True)

    def refresh(self) -> None:
        """Draw the newest picture, where it is another one. Raises UnshowableImage."""
        topics = self._open.hub.topics()
        there = [seen.name for seen in topics if set(seen.types) & set(TYPES)]
        self._topic.offer(there)
        if self._wanted:
            self._open_wanted(there)
        if self._heard and self._heard.count != self._drawn:
            self._draw(self._heard)

    def _open_wanted(self, there: list[str]) -> None:
        """What was typed behind the tab's name, as soon as it is there; unless one is chosen."""
        if self._topic.value:
            self._wanted = ""
        elif self._wanted in there:
            self._topic.choose(self._wanted)
            self._choose()
        else:
            self._count.say(f"No node has a topic {self._wanted} with pictures yet.")

    def _choose(self) -> None:
        """Raises SeveralTypes."""
        self._open.leave_all()
        self._heard, self._drawn, self._shown = None, 0, 0
        topic = self._topic.value
        if topic and (type_name := self._open.hub.type_of(topic)):
            self._heard = self._open.hear(topic, type_name)
            self._count.say("No picture has come yet.")

    def _draw(self, heard: SharedSubscription) -> None:
        self._drawn = heard.count
        picture = picture_of(heard.newest())
        self._shown += 1
        bright = picture.brightness
        self._bright.say("" if bright is None else f"Brightness {bright:.0f} of 255")
        self._count.say(
            f"{picture.words}; {heard.per_second()[0]:.1f} pictures/s; {heard.count} came,"
            f" {self._shown} of them were shown."
        )
        self._picture.props["hidden"] = None
        self._picture.props["src"] = picture.address
        self._picture.props["alt"] = f"Picture of {heard.topic}, {picture.words}"
        self._picture.update()
