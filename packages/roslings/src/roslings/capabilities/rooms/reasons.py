"""Why nothing can be said of a drive, and by which clock it was judged."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.capabilities.rooms.record import WhyWall
from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import SentencePart, one_of


@dataclass(eq=False)
class NothingDriven(NothingToJudge):
    """No drive is there to look at."""

    text = "no room was driven"


@dataclass(eq=False)
class HeldUpInARoom(Inconclusive):
    """In real time, and this computer was too busy."""

    room: int
    held_s: float
    text = (
        "room {room} was driven in real time, and this computer held the world or your node up for"
        " {held_s:.2f} s; close other programs and check again"
    )


@dataclass(frozen=True)
class NothingInItsWay(SentencePart):
    """In no room did something that moves come before it."""

    text = "nothing that moves came into its way in these rooms"


@dataclass(frozen=True)
class InRealTime(SentencePart):
    """Lockstep could not tell how the nodes drive."""

    why: WhyWall
    thread: str = ""
    text = one_of(
        main_sleeps="judged in real time: the main thread of your node sleeps on the wall clock"
        " (time.sleep, or what calls it); a timer would follow /clock",
        thread_sleeps="judged in real time: the thread {thread} of your node sleeps on the wall"
        " clock (time.sleep, or what calls it); a timer would follow /clock",
        ends_otherwise="judged in real time: at half the speed the same room ends otherwise, so"
        " your node uses the wall clock, or computes too long for each message",
        never_quiet="judged in real time: something in your node runs on and on, such as a loop"
        " that never waits",
        over_budget="judged in real time: your node computes too long for each message",
        nobody_follows="judged in real time: no node with the card's name follows /clock",
        no_account="judged in real time: this computer does not tell what a node's threads do",
    )

    @property
    def which_text(self) -> str:
        """Why."""
        if self.why == "sleeps":
            return "thread_sleeps" if self.thread else "main_sleeps"
        return self.why.replace(" ", "_")
