"""Topics: which there are; how often one of them comes, what it says, and a form to publish."""

from __future__ import annotations

from contextlib import ExitStack

from ros2_on_pip.interfaces import class_of, full_name
from ros2_on_pip.listening import SeveralTypes
from ros2_on_pip.measuring import unit_of
from ros2_on_pip.names import checked_topic
from ros2_on_pip.yaml_out import YamlOptions, as_yaml
from roslings_desk.controls import NameTable, Notice, PageText, TextField, button, part, tell, told
from roslings_desk.form import Form
from roslings_desk.hub import GraphTopic, SharedSubscription
from roslings_desk.publisher import Publisher
from roslings_desk.shown import topic_of
from roslings_desk.tab import OpenTab

MOST_ROWS = 100
SHAPE = YamlOptions(longest=64)
LONGEST_TEXT = 6_000
COLUMNS = ("Topic", "Type", "Publishers", "Subscriptions")


class TopicsTab:
    """All topics in a table, and the one that was chosen beside it."""

    title, every_s = "Topics", 0.25

    def __init__(self) -> None:
        self._chosen = ""
        self._heard: SharedSubscription | None = None
        self._drawn = self._shown = 0
        self._publishing = ExitStack()

    def show(self, open_tab: OpenTab) -> None:
        """The table; beside it nothing is chosen yet."""
        self._open = open_tab
        open_tab.ends.callback(self._publishing.close)
        with part("div", "sides"):
            with part("div", "column"):
                self._wanted = TextField("Find a topic", type="search")
                self._count = PageText("p", "", "count")
                self._names = NameTable("All topics", COLUMNS, self._choose_seen)
                self._show_other()
            self._side = part("section", "column", aria_label="The chosen topic")
        self._awaited = topic_of(open_tab.shown)
        with self._side:
            PageText("p", _first_words(self._awaited), "hint")

    def _show_other(self) -> None:
        """For a topic that nobody has yet."""
        PageText("h3", "Another topic")
        with part("div", "row"):
            name = TextField("Name", "/chatter")
            kind = TextField("Type", "std_msgs/msg/String")
            trouble = Notice()
            button("Choose this one", told(trouble, lambda: self._choose_other(name, kind)))

    # --- the table -------------------------------------------------------------------------

    def refresh(self) -> None:
        """Rows, and the newest of what was chosen. Raises SeveralTypes."""
        there = self._open.hub.topics()
        found = [seen for seen in there if self._wanted.value.lower() in seen.name.lower()]
        self._count.say(_counted(len(there), len(found)))
        self._names.show([_row(seen) for seen in found[:MOST_ROWS]], self._chosen)
        if self._awaited and (self._awaited in {seen.name for seen in there} or self._chosen):
            if not self._chosen:
                self._choose_seen(self._awaited)
            self._awaited = ""
        if self._heard:
            self._follow({seen.name: seen for seen in there}.get(self._chosen), self._heard)

    def _choose_seen(self, name: str) -> None:
        seen = next(each for each in self._open.hub.topics() if each.name == name)
        self._choose(name, seen.types[0])

    def _choose_other(self, name: TextField, kind: TextField) -> None:
        """Raises BadName, UnknownInterface."""
        topic, type_name = checked_topic(name.value.strip()), full_name(kind.value.strip(), "msg")
        class_of(type_name, "msg")
        self._choose(topic, type_name)

    # --- the chosen topic ------------------------------------------------------------------

    def _choose(self, topic: str, type_name: str) -> None:
        self._leave()
        self._side.clear()
        self._chosen = topic
        with self._side:
            PageText("h3", topic)
            PageText("p", type_name, "hint")
            self._problem = Notice()
            tell(self._problem, lambda: self._listen(topic, type_name))

    def _listen(self, topic: str, type_name: str) -> None:
        self._heard = self._open.hear(topic, type_name)
        self._drawn = self._shown = 0
        self._rate = PageText("p", "Nothing has come yet.", "value")
        self._drops = PageText("p", "", "count")
        self._value = PageText(
            "pre", "", tabindex=0, role="region", aria_label="The newest message"
        )
        self._show_form(topic, type_name)

    def _leave(self) -> None:
        self._publishing.close()
        if self._heard:
            self._open.leave(self._heard)
        self._heard = None

    def _follow(self, seen: GraphTopic | None, heard: SharedSubscription) -> None:
        if seen and len(seen.types) > 1:
            raise SeveralTypes(seen.name, list(seen.types))
        if seen and seen.types[0] != heard.type_name:
            self._choose(seen.name, seen.types[0])
            return
        rate_hz, bytes_s = heard.per_second()
        if heard.count:
            self._rate.say(f"{rate_hz:.1f} messages/s, {unit_of(bytes_s)(bytes_s)}/s")
        if heard.count != self._drawn:
            self._draw(heard)

    def _draw(self, heard: SharedSubscription) -> None:
        self._drawn = heard.count
        self._shown += 1
        lost = f"; the middleware lost {heard.lost}" if heard.lost else ""
        self._drops.say(f"{heard.count} came, {self._shown} of them were shown here{lost}.")
        text = as_yaml(heard.newest(), SHAPE)
        self._value.say(text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}\n...")

    # --- publishing ------------------------------------------------------------------------

    def _show_form(self, topic: str, type_name: str) -> None:
        PageText("h3", "Publish")
        form = Form(class_of(type_name, "msg"))
        publisher = self._publishing.enter_context(Publisher(self._open.hub, topic, type_name))
        rate = TextField("Rate, Hz", "1", inputmode="decimal")
        trouble = Notice()
        said = PageText("p", "", "hint", role="status")

        def once() -> None:
            publisher.publish(*form.filled())
            said.say(f"Published {publisher.count} by hand.")

        def again() -> None:
            publisher.repeat(*form.filled(), rate.value)
            said.say(f"It is published at {rate.value} Hz until you press Stop publishing.")

        def end() -> None:
            publisher.end()
            said.say("Nothing is published any more.")

        with part("div", "row"):
            button("Publish once", told(trouble, once))
            button("Publish at this rate", told(trouble, again))
            button("Stop publishing", told(trouble, end))


def _first_words(awaited: str) -> str:
    if awaited:
        return f"No node has a topic {awaited} yet. It is shown here as soon as one has it."
    return "Choose a topic. It is listened to as long as you look at it."


def _row(seen: GraphTopic) -> tuple[str, ...]:
    return (seen.name, ", ".join(seen.types), str(seen.publishers), str(seen.subscriptions))


def _counted(there: int, found: int) -> str:
    if found > MOST_ROWS:
        return f"{found} of {there} topics, {MOST_ROWS} of them shown. Type more of the name."
    return f"{found} of {there} topics" if found != there else f"{there} topics"
