"""What can be wrong with a button and a guard, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from roslings.judge.faults import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural


@dataclass(frozen=True)
class After(SentencePart):
    """After something was done, in the words of who did it."""

    cause: Text
    text = "after {cause}"


@dataclass(frozen=True)
class Zero(SentencePart):
    """A command whose fields are all zero."""

    text = "zero"


EventName = Literal[
    "press",
    "release",
    "silence",
    "command",
    "freeze",
    "thaw",
    "leave",
    "join",
    "second_joins",
    "second_leaves",
]
"""A value of `orders.Happens`."""


@dataclass(frozen=True)
class Happening(SentencePart):
    """One event around a guard: a value of `orders.Happens`."""

    event: EventName
    text = one_of(
        press="a press",
        release="a release",
        silence="no more commands",
        command="a new command",
        freeze="the button's program hangs",
        thaw="the button's program runs on",
        leave="the button's program ends",
        join="a button's program begins, and says pressed",
        second_joins="a second button begins, and says pressed",
        second_leaves="the second button ends",
    )

    @property
    def which_text(self) -> str:
        """By the event."""
        return self.event


HAPPENINGS = {name: Happening(name) for name in get_args(EventName)}
"""Value of `orders.Happens` to its words."""


def in_words(told: str) -> Text:
    """What was done, in words; that of a walk stands in the evidence by its name."""
    return HAPPENINGS.get(told, told)


# --- a button ----------------------------------------------------------------------------------


@dataclass(eq=False)
class OtherThanPressed(Fault):
    """A press did not lead to one message with its value."""

    topic: str
    asked: str
    wanted: str
    found: Text
    why = "The topic is all that the guard hears of the button."
    expected = "the call with {asked} leads to one message on {topic}: {wanted}"
    measured = "it leads to: {found}"
    hint = "Compare what the service was asked with what is published."
    mend = "Publish request.data in the function of the service, once for each call."


@dataclass(eq=False)
class SaysMore(Fault):
    """The latched topic says more than it was asked to."""

    topic: str
    wanted: int
    found: int
    why = "A topic that keeps its last message need not say it again. Each message is an event."
    expected = plural(
        "wanted",
        one="at most {wanted} message on {topic}: one at the start, and one for each call",
        other="at most {wanted} messages on {topic}: one at the start, and one for each call",
    )
    measured = "{found}"
    hint = "Is there a timer that publishes? A latched topic needs none."


@dataclass(eq=False)
class ToldLate(Fault):
    """Each press is told, and some time after it was answered."""

    topic: str
    service: str
    within_s: float
    found_s: float
    why = "Who presses the stop has no time to wait. The answer says that it is pressed already."
    expected = "within {within_s:g} s of the answer of {service}, {topic} says what it was asked"
    measured = "it says so {found_s:.2f} s after the answer"
    hint = "What happens between the call and the line that publishes?"
    mend = "Publish in the function of the service, before it returns: no timer and no sleep."


# --- a guard -----------------------------------------------------------------------------------


@dataclass(eq=False)
class TellsTheMotorsNothing(Fault):
    """No message comes to the motors."""

    topic: str
    when: Text
    why = "Motors that hear nothing do what they were told last."
    expected = "messages on {topic} {when}"
    measured = "none came"
    hint = "What does your node publish while there is a reason to stop, and how often?"
    mend = "A timer publishes 20 times a second, also while there is a reason to stop: then zero."


@dataclass(eq=False)
class StandsStill(Fault):
    """It does not drive, though nothing speaks against it."""

    topic: str
    when: str
    command: Text
    why = "A guard that stops the rover for no reason is switched off soon, and then guards nobody."
    expected = "{when}, {topic} says what the operator wants: {command}"
    measured = "it says zero all the time"
    hint = (
        "Log which reason to stop your guard sees. Each must go away again: on `false`, on the next"
        " command, and when a publisher is alive again (alive_count)."
    )


@dataclass(eq=False)
class OtherCommand(Fault):
    """The motors are told something else than the operator wants."""

    topic: str
    when: str
    command: Text
    found: Text
    why = "The guard stands between the operator and the motors, and changes nothing on the way."
    expected = "{when}, {topic} says what the operator wants: {command}"
    measured = "it says: {found}"
    hint = "What becomes of the fields of /cmd_vel_raw on their way through your node?"
    mend = "Keep the last message of /cmd_vel_raw as it is, with all its fields, and publish it."


@dataclass(eq=False)
class Stutters(Fault):
    """In the middle of a drive it stops for a moment."""

    topic: str
    when: Text
    gap_s: float
    why = "A rover that stops and starts again and again wears its gears, and throws its load."
    expected = "{when}, {topic} says all the time what the operator wants"
    measured = "in between it says zero, though no command was more than {gap_s:.2f} s late"
    hint = (
        "Does a lost or a late command stop it? One that is lost is no reason to stop: only the"
        " deadline is."
    )


@dataclass(eq=False)
class DoesNotStop(Fault):
    """The motors go on, though there is a reason to stop."""

    KNOWN_AS = "GuardDoesNotStop"

    topic: str
    cause: str
    within_s: float
    watched_s: float
    why = "This is what the guard is there for."
    expected = "after {cause}, {topic} says zero within {within_s:g} s"
    measured = "{watched_s:.1f} s later it still says another command"
    hint = (
        "Which function of yours is called then? For a press it is the subscription's, for the"
        " others an event's: SubscriptionEventCallbacks(deadline=..., liveliness=...). Log in it."
    )


@dataclass(eq=False)
class StopsLate(DoesNotStop):
    """It stops, and not soon enough."""

    KNOWN_AS = "GuardStopsLate"

    measured = "the last other command came {watched_s:.2f} s later"
    hint = "What lies between the event and your stop: a wait, a timer?"
    mend = (
        "Act in the event's own function. A wait, or a timer that looks now and then, comes on top"
        " of the time that the middleware takes."
    )


@dataclass(eq=False)
class SilentMeanwhile(Fault):
    """While there is a reason to stop, the motors hear nothing for a while."""

    topic: str
    cause: str
    most_s: float
    found_s: float
    why = "Motors that hear nothing do what they were told last."
    expected = "after {cause}, {topic} has a message every {most_s:g} s at least"
    measured = "for {found_s:.2f} s there was none"
    hint = (
        "Something in your node waits: a time.sleep(), or a loop, in the function of an event or of"
        " a subscription. Nothing else of the node runs meanwhile, its timer neither."
    )


@dataclass(eq=False)
class DrivesUnasked(Fault):
    """It drives before anybody released the stop."""

    topic: str
    when: str
    found: Text
    why = "A robot that nobody has released must not move: somebody may stand before it."
    expected = "{when}, {topic} says zero"
    measured = "it says: {found}"
    hint = "In which state does your guard begin, before anything has come?"
    mend = "Begin with `stopped = True`, and with a button that is not there."


@dataclass(eq=False)
class DoesNotGoOn(StandsStill):
    """After a reason to stop is gone, it stands for ever."""

    why = "A guard that never lets go again must be started anew after each stop."


@dataclass(eq=False)
class WrongInThisOrder(Fault):
    """One event after the other, and then the motors are told what the card does not say."""

    topic: str
    events: tuple[Happening, ...]
    must_drive: bool
    found: Text
    why = "Two reasons can hold at once. When one of them ends, the other is still there."
    expected = one_of(
        drive="one after the other: {events}. Then {topic} says what the operator wants",
        stand="one after the other: {events}. Then {topic} says zero",
    )
    measured = "it says: {found}"
    hint = (
        "Go through these events with a finger in your code: which of your variables change at"
        " each, and what do they say at the end?"
    )
    mend = one_of(
        drive="Look at all publishers that are alive, not at the one that has gone.",
        stand="Keep one variable for each reason, and drive only where no reason is left.",
    )

    @property
    def which_expected(self) -> str:
        """What the card says."""
        return "drive" if self.must_drive else "stand"

    which_mend = which_expected


@dataclass(eq=False)
class ReasonNotTold(Fault):
    """The log does not say why it stopped."""

    line: str
    cause: str
    near: str | None
    why = "Who stands beside a rover that stopped wants to know why, before anything else."
    expected = "after {cause}, the guard writes: {line}"
    hint = "Where in your code does a stop begin, and what is written there?"
    mend = "Write the line where the stop begins. Text, colon and reason are those of the card."

    measured = one_of(near="it writes: {near}", none="it writes nothing like it")

    @property
    def which_measured(self) -> str:
        """The nearest line."""
        return "near" if self.near else "none"


@dataclass(eq=False)
class ReasonToldAgain(Fault):
    """One stop is told many times."""

    line: str
    cause: str
    times: int
    why = "A log that says the same again and again hides all that is new."
    expected = "after {cause}, one line: {line}"
    measured = plural(
        "times", one="it stands there {times} time", other="it stands there {times} times"
    )
    hint = "How often does this event come, and when is the reason a new one?"
    mend = (
        "The deadline's event comes again, for each deadline that passes. Write the line only when"
        " the reason is new."
    )


# --- two computers -----------------------------------------------------------------------------


@dataclass(eq=False)
class NotReached(Fault):
    """The nodes do not find each other across the link."""

    what: Literal["service", "topic", "guard"]
    name: str
    """Of the service or the topic."""
    why = "On two computers there is often no multicast: in schools, and on many a Wi-Fi."
    expected = one_of(
        service="on two computers, {name} is served",
        topic="on two computers, {name} is heard on the other one",
        guard="on two computers, the guard hears {name}",
    )

    @property
    def which_expected(self) -> str:
        """What should be reached."""
        return self.what

    measured = "they did not find each other, though ROS_STATIC_PEERS names the other computer"
    hint = (
        "The check sets ROS_STATIC_PEERS and ROS_AUTOMATIC_DISCOVERY_RANGE, as you would in a"
        " terminal. Your program must leave these variables as they are."
    )
