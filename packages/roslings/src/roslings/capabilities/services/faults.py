"""Faults of services: who answers, what, and how soon."""

from __future__ import annotations

from dataclasses import dataclass, field

from ros2_on_pip.near_names import Near
from roslings.judge.faults.base import Fault
from roslings.judge.faults.graph import guess, look_in_front


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

    @property
    def measured(self) -> str:
        """What there is."""
        if self.is_client:
            return f"the node has a client of {self.service}, and no server"
        return f"no node serves {self.service}, or a name like it"


@dataclass(eq=False)
class ServedTwice(Fault):
    """More than one server has the name of a service."""

    service: str
    servers: int
    why = "Each server answers each call: what is asked for once is done twice."
    hint = "How often does your code call create_service(...) for this name?"
    mend = "Is self.create_service(...) there twice for this name? Take one of them out."
    expected = "one server of {service}"
    measured = "there are {servers}"


@dataclass(eq=False)
class WrongService(Fault):
    """The service is there under another name."""

    near: Near
    why = "Client and server meet only when both use the very same name."
    expected = "a node that serves {near.wanted}"

    @property
    def hint(self) -> str:
        """Where the name is given."""
        return (
            f"Look at the name in create_service(...).{look_in_front(self.near)} Check with"
            " `ros2 service list`."
        )

    @property
    def measured(self) -> str:
        """The name that is there, and the likely slip."""
        return f"there is no {self.near.wanted}, but {self.near.found} is served{guess(self.near)}"


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
    waited_s: float
    why = "Whoever calls a service waits for its answer, and can do nothing until it comes."
    hint = "What does the service's function give back, on each way through it?"
    mend = (
        "Does the function that you gave to create_service end with `return response`, on each"
        " way through it?"
    )
    expected = "{service}{asked} is answered"
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

    @property
    def measured(self) -> str:  # type: ignore[override]
        """That nothing runs any more."""
        return f"{super().measured}, and no other callback of the node runs either"


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

    @property
    def measured(self) -> str:  # type: ignore[override]
        """What it waits for."""
        return (
            f"{super().measured}: the node waits inside a callback,"
            f" and is itself a client of {', '.join(self.calls)}"
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
    expected = "{service}{asked} answers {field_name}: {wanted}"
    measured = "{field_name}: {found}"

    @property
    def hint(self) -> str:
        """Where it is set, and in which case."""
        if self.case:
            return (
                f"Look at `response.{self.field_name} = ...` on the way through the function where"
                f" {self.case}. What is kept in the node (self.NAME) must tell the cases apart."
            )
        return (
            f"Look at `response.{self.field_name} = ...` in the service's function. Is it set on"
            " each way through it, and is it what the card says?"
        )


@dataclass(eq=False)
class WrongState(Fault):
    """The answer is right, and the state that is published is not."""

    topic: str
    after: str
    wanted: str
    found: str | None
    why = "A server that says yes and does nothing is worse than one that says no."
    hint = "Under which name is the state kept? Who changes it, and who publishes it?"
    mend = (
        "Keep the state in the node (self.NAME). The service's function changes it; the timer's"
        " function publishes it. Do both use the same name?"
    )
    expected = "after {after}, {topic} says {wanted}"

    @property
    def measured(self) -> str:
        """The state that was seen."""
        return f"it says {self.found}" if self.found is not None else "nothing came on the topic"


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

    @property
    def expected(self) -> str:
        """The time."""
        return f"{self.service}, {self.who}: each answer within {1000 * self.limit_s:.0f} ms"

    @property
    def measured(self) -> str:
        """How many took longer."""
        return (
            f"{self.late} of {self.asked} answers were late; the slowest took"
            f" {1000 * self.slowest_s:.0f} ms"
        )


# --- clients -----------------------------------------------------------------------------------


@dataclass(eq=False)
class DidNotAsk(Fault):
    """A server was there, and the client sent no request."""

    executable: str
    service: str
    how: str
    why = "The server was ready. A client that does not ask gets no answer."
    hint = (
        "Does your code wait for the server (wait_for_service), and then come to"
        " call_async(request)? Write a line to the log right before the call, and see."
    )
    expected = "{executable} calls {service}"
    measured = "no request came; {how}"


@dataclass(eq=False)
class AsksElsewhere(WrongService):
    """The client calls a service of another name."""

    hint = "Look at the name in create_client(...). Check with `ros2 service list`."
    expected = "a client of {near.wanted}"

    @property
    def measured(self) -> str:
        """The name that it uses, and the likely slip."""
        return f"it is a client of {self.near.found}{guess(self.near)}"


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
    when: str = field(default="after the answer", kw_only=True)
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

    @property
    def measured(self) -> str:  # type: ignore[override]
        """What stands still."""
        server = "the server answered at once, but " if self.answered else ""
        return f"{server}after {self.waited_s:.0f} s it still waits, and no callback of it runs"


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
    when: str
    wanted: int
    found: str
    why = "Other programs see only the exit code: 0 says that all went well, 1 that it did not."
    expected = "{when}, {executable} ends with exit code {wanted}"

    hint = "What does main() return in this case? Read the last lines below, too."

    @property
    def measured(self) -> str:
        """The code that came."""
        return self.found

    @property
    def mend(self) -> str:
        """How a code is given."""
        if self.wanted:
            return f"Let main() return {self.wanted} in that case. setup.py hands it on."
        return "Read the last lines below. Does main() return something other than None or 0?"


@dataclass(eq=False)
class AskedAgain(Fault):
    """One request was asked for, and more came."""

    executable: str
    service: str
    count: int
    why = "Each request does something: what is asked twice is done twice."
    hint = "How often is call_async(request) reached? Look for a loop, or a timer that goes on."
    expected = "{executable} calls {service} once"
    measured = "it called {count} times, and each call was answered at once"
