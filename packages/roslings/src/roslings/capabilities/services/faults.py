"""Faults of services: who answers, what, and how soon."""

from __future__ import annotations

from dataclasses import dataclass, field

from roslings.judge.faults.base import Fault
from roslings.judge.faults.ends import End, Went
from roslings.judge.faults.graph import LOOK_IN_FRONT, NearlyNamed, with_guess
from roslings.judge.faults.moments import When
from roslings.judge.faults.sentences import Text, one_of, plural, some_of


@dataclass(eq=False)
class NoService(Fault):
    """Nobody answers under this name, or under one like it."""

    service: str
    is_client: bool
    why = "Without a server nobody answers: whoever asks waits for ever."
    expected = "a node that serves {service}"
    hint = (
        "Does your class make a service in __init__? `ros2 service list` tells, while the "
        "node runs."
    )
    mend = (
        "Call self.create_service(TYPE, NAME, FUNCTION) in __init__ of your class. Check with"
        " `ros2 service list` while the node runs."
    )

    measured = one_of(
        client="the node has a client of {service}, and no server",
        nobody="no node serves {service}, or a name like it",
    )

    @property
    def which_measured(self) -> str:
        """What there is."""
        return "client" if self.is_client else "nobody"


@dataclass(eq=False)
class ServedTwice(Fault):
    """More than one server has the name of a service."""

    service: str
    servers: int
    why = "Each server answers each call: what is asked for once is done twice."
    hint = "How often does your code call create_service(...) for this name?"
    mend = "Is self.create_service(...) there twice for this name? Take one of them out."
    expected = "one server of {service}"
    measured = plural("servers", one="there is {servers}", other="there are {servers}")


@dataclass(eq=False)
class WrongService(NearlyNamed):
    """The service is there under another name."""

    why = "Client and server meet only when both use the very same name."
    expected = "a node that serves {near.wanted}"

    hint = some_of(
        name="Look at the name in create_service(...).",
        in_front=LOOK_IN_FRONT,
        check="Check with `ros2 service list`.",
    )
    measured = with_guess("there is no {near.wanted}, but {near.found} is served")

    @property
    def which_hint(self) -> tuple[str, ...]:
        """Where the name is given, and what may put something in front of it."""
        in_front = ("in_front",) if self.near.how == "namespace" else ()
        return "name", *in_front, "check"


@dataclass(eq=False)
class WrongServiceType(Fault):
    """The service has another type."""

    service: str
    wanted: str
    found: str
    call: str = "create_service"
    why = "The type says which fields a request and an answer have. Both sides need the same."
    expected = "{service} has the type {wanted}"
    measured = "its type is {found}"
    hint = "The type is the first word in {call}(...), and comes from an import line."


@dataclass(eq=False)
class NoAnswer(Fault):
    """A request got no answer, though the node lives and its callbacks run."""

    service: str
    asked: str
    """The request's fields, or the card's words for the case."""
    waited_s: float
    why = "Whoever calls a service waits for its answer, and can do nothing until it comes."
    hint = "What does the service's function give back, on each way through it?"
    mend = (
        "Does the function that you gave to create_service end with `return response`, on each"
        " way through it?"
    )
    expected = "{service} ({asked}) is answered"
    measured = "no answer came within {waited_s:.0f} s"


@dataclass(eq=False)
class EndedInsteadOfAnswering(NoAnswer):
    """The node ended while it should have answered."""

    why = "An error in a callback ends the whole node, and the answer is lost with it."
    hint = (
        "Read the last lines below: the last one names the error. What did the service's "
        "function give back?"
    )
    mend = (
        "Read the last lines below: the last one names the error. `TypeError` without more means"
        " that the function gave back no response: end it with `return response`."
    )
    measured = "the node ended, and did not answer"


@dataclass(eq=False)
class StuckInCallback(NoAnswer):
    """A callback of the node does not come to its end."""

    why = "A node does one thing at a time. While a callback runs, nothing else in it does."
    hint = "Look for a loop without an end, a long sleep or input() in the service's function."

    measured = (
        "no answer came within {waited_s:.0f} s, and no other callback of the node runs either"
    )


@dataclass(eq=False)
class Deadlock(StuckInCallback):
    """A callback calls a service and waits: the answer can never be taken."""

    calls: tuple[str, ...]
    why = (
        "The callback waits for an answer. The node can take that answer only when the callback"
        " has ended. Each waits for the other, for ever: a deadlock."
    )
    hint = "Which line of the callback waits, and who would have to run meanwhile?"
    mend = (
        "Never wait for a service inside a callback. In the same node, call the method itself."
        " For another node, use call_async(...).add_done_callback(...) and return."
    )

    measured = (
        "no answer came within {waited_s:.0f} s, and no other callback of the node runs either: the"
        " node waits inside a callback, and is itself a client of {calls}"
    )


@dataclass(eq=False)
class WrongAnswer(Fault):
    """A field of the answer is not what the card says."""

    service: str
    asked: str
    field_name: str
    wanted: str
    found: str
    case: str = ""
    why = "A client acts on the answer. It must be able to believe it."
    expected = "{service} ({asked}) answers {field_name}: {wanted}"
    measured = "{field_name}: {found}"

    hint = one_of(
        case="Look at `response.{field_name} = ...` on the way through the function where"
        " {case}. What is kept in the node (self.NAME) must tell the cases apart.",
        each="Look at `response.{field_name} = ...` in the service's function. Is it set on"
        " each way through it, and is it what the card says?",
    )

    @property
    def which_hint(self) -> str:
        """Where it is set, and in which case."""
        return "case" if self.case else "each"


@dataclass(eq=False)
class WrongState(Fault):
    """The answer is right, and the state that is published is not."""

    topic: str
    wanted: str
    found: str | None
    service: str = ""
    """After a call of which; empty: at the start."""
    asked: str = ""
    """The request's fields, where it has any."""
    why = "A server that says yes and does nothing is worse than one that says no."
    hint = "Under which name is the state kept? Who changes it, and who publishes it?"
    mend = (
        "Keep the state in the node (self.NAME). The service's function changes it; the timer's"
        " function publishes it. Do both use the same name?"
    )
    expected = one_of(
        start="after the start, before any call, {topic} says {wanted}",
        call="after {service}, {topic} says {wanted}",
        request="after {service} ({asked}), {topic} says {wanted}",
    )
    measured = one_of(another="it says {found}", nothing="nothing came on the topic")

    @property
    def which_expected(self) -> str:
        """After what."""
        return ("request" if self.asked else "call") if self.service else "start"

    @property
    def which_measured(self) -> str:
        """Whether any was seen."""
        return "nothing" if self.found is None else "another"


@dataclass(eq=False)
class LateAnswers(Fault):
    """Too many answers came too late."""

    service: str
    who: str
    limit_s: float
    late: int
    asked: int
    slowest_s: float
    why = "Whoever calls waits so long. A robot that waits for its motors drives on meanwhile."
    hint = "What takes so long in the service's function?"
    mend = (
        "Take sleep and other long work out of the service's function: set the value, fill the"
        " answer, return. The timer can do the rest."
    )

    expected = "{service}, {who}: each answer within {limit_ms:.0f} ms"
    measured = plural(
        "late",
        one="{late} of {asked} answers was late; the slowest took {slowest_ms:.0f} ms",
        other="{late} of {asked} answers were late; the slowest took {slowest_ms:.0f} ms",
    )

    @property
    def limit_ms(self) -> float:
        """The card's time."""
        return 1000 * self.limit_s

    @property
    def slowest_ms(self) -> float:
        """The longest one."""
        return 1000 * self.slowest_s


# --- clients -----------------------------------------------------------------------------------


@dataclass(eq=False)
class DidNotAsk(Fault):
    """A server was there, and the client sent no request."""

    executable: str
    service: str
    went: Went
    why = "The server was ready. A client that does not ask gets no answer."
    hint = (
        "Does your code wait for the server (wait_for_service), and then come to"
        " call_async(request)? Write a line to the log right before the call, and see."
    )
    expected = "{executable} calls {service}"
    measured = "no request came; {went}"


@dataclass(eq=False)
class AsksElsewhere(WrongService):
    """The client calls a service of another name."""

    hint = "Look at the name in create_client(...). Check with `ros2 service list`."
    expected = "a client of {near.wanted}"

    measured = with_guess("it is a client of {near.found}")


@dataclass(eq=False)
class AskedOtherwise(Fault):
    """The request does not hold what the card says."""

    executable: str
    wanted: str
    found: str
    why = "The server does what the request says, and not what you meant."
    hint = "Which fields of the request are set before the call, and to what?"
    mend = "Set the request's field before the call: request = TYPE.Request(), request.data = ..."
    expected = "{executable} asks with {wanted}"
    measured = "it asked with {found}"


@dataclass(eq=False)
class ClientStays(Fault):
    """The client has its answer and goes on running."""

    executable: str
    waited_s: float
    when: Text = field(default=When("answered"), kw_only=True)
    why = "This client has one task. When it is done, the terminal belongs to you again."
    expected = "{when}, {executable} ends by itself"
    measured = "it still ran {waited_s:.0f} s after its start"
    hint = "What does main() wait for, after the answer has come?"
    mend = (
        "rclpy.spin(node) never ends by itself. Use rclpy.spin_until_future_complete(node,"
        " future), and let main() come to its end."
    )


@dataclass(eq=False)
class ClientDeadlock(ClientStays):
    """The client waits for an answer in a way that keeps the answer out."""

    answered: bool
    why = (
        "An answer is taken while the node spins. Who waits inside a callback, or without"
        " spinning, keeps the answer out and waits for ever: a deadlock."
    )
    hint = "Which line waits for the answer, and who would have to run so that it can arrive?"
    mend = (
        "Use call_async(request), not call(request). Then wait in main(), outside any callback:"
        " rclpy.spin_until_future_complete(node, future)."
    )

    measured = one_of(
        answered="the server answered at once, but after {waited_s:.0f} s it still waits, and no"
        " callback of it runs",
        unanswered="after {waited_s:.0f} s it still waits, and no callback of it runs",
    )

    @property
    def which_measured(self) -> str:
        """Whether it was given an answer."""
        return "answered" if self.answered else "unanswered"


@dataclass(eq=False)
class NeverGivesUp(ClientStays):
    """There is no server, and the client waits for ever."""

    limit_s: float
    wait: str
    why = "A program that waits for ever looks like one that works. Say what is missing, and end."
    expected = "without a server, {executable} ends by itself within {limit_s:g} s"
    hint = "How long does your client wait for a server that never comes?"
    mend = (
        "Give a time to the wait: client.{wait}(timeout_sec=2.0). When no server came, it gives"
        " back False."
    )


@dataclass(eq=False)
class GivesUpLate(NeverGivesUp):
    """There is no server, and the client waits long before it says so."""

    measured = "it ended {waited_s:.1f} s after its node was there"


@dataclass(eq=False)
class WrongExitCode(Fault):
    """The program's exit code does not tell how it went."""

    executable: str
    when: Text
    wanted: int
    end: End
    why = "Other programs see only the exit code: 0 says that all went well, 1 that it did not."
    expected = "{when}, {executable} ends with exit code {wanted}"

    hint = "What does main() return in this case? Read the last lines below, too."

    measured = "{end}"
    mend = one_of(
        one="Let main() return {wanted} in that case. setup.py hands it on.",
        zero="Read the last lines below. Does main() return something other than None or 0?",
    )

    @property
    def which_mend(self) -> str:
        """Which code is to be given."""
        return "one" if self.wanted else "zero"


@dataclass(eq=False)
class AskedAgain(Fault):
    """One request was asked for, and more came."""

    executable: str
    service: str
    count: int
    why = "Each request does something: what is asked twice is done twice."
    hint = "How often is call_async(request) reached? Look for a loop, or a timer that goes on."
    expected = "{executable} calls {service} once"
    measured = plural(
        "count",
        one="it called {count} time, and each call was answered at once",
        other="it called {count} times, and each call was answered at once",
    )
