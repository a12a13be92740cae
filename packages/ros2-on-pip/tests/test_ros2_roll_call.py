"""Who is there is asked and known: nobody is waited for who has ended, nobody announces slowly."""

from __future__ import annotations

import os
import signal
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import SimpleNamespace

import inside
import pytest
from terminal import Shell, eventually

from ros2_on_pip import discovery as direct_node
from ros2_on_pip import roll_call
from ros2_on_pip.discovery import Settling, Sight
from ros2_on_pip.participants import HERE, give_room, own_participants, participants_here
from ros2_on_pip.roll_call import (
    MOST_TURNS_BETWEEN,
    VENDOR,
    HeardAnswer,
    RollCall,
    announcement,
    first_question,
    not_yet_asked,
    ports_in,
)
from ros2_on_pip.rtps import PREFIX, parts_in, ports_of
from sources import python_path

US, THEM, DEAD = b"us" * 6, b"them" * 3, b"dead" * 3
PLAIN = (
    "import sys; sys.argv[1:] = ['--ros-args', '-r', '__node:=plain'];"
    "from ros2_on_pip.demo_nodes_py.talker import main; main()"
)


def test_an_announcement_is_read_as_it_was_written() -> None:
    """The sender's name and its port; what is cut short or no announcement has no port."""
    message = announcement(THEM, 7412)
    assert message[PREFIX] == THEM
    assert ports_in(message) == [7412]
    for cut in range(len(message) - 40):
        assert ports_in(message[:cut]) in ([], [7412])
    assert ports_in(b"GET / HTTP/1.1\r\n\r\n") == []
    assert ports_in(b"RTPS" + bytes(30)) == []


def test_who_has_not_answered_yet_is_asked_again_and_who_is_new_at_once() -> None:
    """Of three ports one has answered, one was asked, one is new; a port of old has gone."""
    here, asked, answered = frozenset({7410, 7412, 7414}), {7410, 7412, 7416}, {7410, 7416}
    assert not_yet_asked(here, asked, answered, again=False) == {7414}
    assert not_yet_asked(here, asked, answered, again=True) == {7412, 7414}
    assert not_yet_asked(here, here, here, again=True) == frozenset()
    assert not_yet_asked(frozenset(), asked, answered, again=True) == frozenset()


def test_what_is_handed_on_again_comes_more_and_more_seldom() -> None:
    """Soon at first, and never so often that what others say finds no room."""
    answer, turns = HeardAnswer(b""), []
    for turn in range(100):
        if answer.due_turn <= turn:
            turns.append(turn)
            answer.handed_on(turn)
    assert turns[:5] == [0, 1, 3, 7, 15]
    assert turns[-1] - turns[-2] == MOST_TURNS_BETWEEN
    assert len(turns) < 12


def test_a_first_question_is_in_the_name_of_who_asks_and_counts_nothing() -> None:
    """To both that tell of endpoints: nothing is there yet, and the count is below each other."""
    question = first_question(announcement(US, 7410), THEM)
    assert question[PREFIX] == US
    meant_for, *asked = parts_in(question)
    assert (meant_for.kind, meant_for.body) == (0x0E, THEM)
    assert [part.kind for part in asked] == [0x06, 0x06]
    assert [part.body for part in asked] == [
        bytes([0, 0, number, 0xC7, 0, 0, number, 0xC2]) + bytes(16) for number in (3, 4)
    ]
    final = 0x02
    assert not any(part.flags & final for part in asked)
    of_another_vendor = announcement(US, 7410).replace(VENDOR, b"\x01\x10", 1)
    assert first_question(of_another_vendor, THEM) == b""


def test_our_own_participant_gets_room_for_all_that_come_at_once() -> None:
    """More than the kernel gives by itself; another domain's socket is left as it is."""
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as ours,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other,
    ):
        domain = bound_on_a_free_domain(ours)
        other.bind((HERE, 0))
        before = room_of(other)
        give_room(domain)
        assert room_of(ours) > before
        assert room_of(other) == before


def bound_on_a_free_domain(receiver: socket.socket) -> int:
    """Bind as a participant does, where nobody is."""
    for domain in range(90, 60, -1):
        if not participants_here(domain):
            receiver.bind((HERE, ports_of(domain)[10]))
            return domain
    raise AssertionError("no domain is free")


def room_of(receiver: socket.socket) -> int:
    """How many bytes the kernel keeps for it."""
    return receiver.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)


@contextmanager
def participant(name: bytes) -> Iterator[tuple[socket.socket, int]]:
    """A socket that answers as one; `name` is its."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind((HERE, 0))
        receiver.settimeout(60)
        yield receiver, receiver.getsockname()[1]


def test_an_answer_is_handed_on_until_our_own_participant_knows(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It did not listen yet when the others introduced themselves."""
    with participant(US) as (ours, own_port), participant(THEM) as (theirs, port):
        monkeypatch.setattr(roll_call, "participants_here", lambda _: frozenset({own_port, port}))
        monkeypatch.setattr(roll_call, "own_participants", lambda _: frozenset({own_port}))
        with RollCall(domain=0) as roll:
            for receiver, name, at in ((theirs, THEM, port), (ours, US, own_port)):
                asked, asker = receiver.recvfrom(65536)
                assert ports_in(asked) == [asker[1]]
                receiver.sendto(announcement(name, at), asker)
            assert roll.named({1}) is None
            eventually(lambda: roll.named({own_port, port}) == {US, THEM})
            for _ in range(2):  # the first may come too early
                while ours.recv(65536)[PREFIX] != THEM:
                    pass
            # Whom it was told of, it asks.
            while theirs.recv(65536) != first_question(announcement(US, own_port), THEM):
                pass
            roll.knows(frozenset({US, THEM}))


def test_who_does_not_hurry_asks_nobody_for_endpoints(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each answer is handed on again and again; the first question is left to the middleware."""
    with participant(US) as (ours, own_port), participant(THEM) as (theirs, port):
        monkeypatch.setattr(roll_call, "participants_here", lambda _: frozenset({own_port, port}))
        monkeypatch.setattr(roll_call, "own_participants", lambda _: frozenset({own_port}))
        with RollCall(domain=0, hurries=False):
            for receiver, name, at in ((theirs, THEM, port), (ours, US, own_port)):
                _, asker = receiver.recvfrom(65536)
                receiver.sendto(announcement(name, at), asker)
            for _ in range(4):
                while ours.recv(65536)[PREFIX] != THEM:
                    pass
        theirs.setblocking(False)
        asked = []
        with suppress(BlockingIOError):
            while True:
                asked.append(theirs.recv(65536))
    assert first_question(announcement(US, own_port), THEM) not in asked


def test_our_own_port_is_known(empty: Shell) -> None:
    """Of the domain's ports, those of this very process."""
    domain = int(empty.environment["ROS_DOMAIN_ID"])
    with (
        inside.surroundings_of(empty),
        empty.start("run", "demo_nodes_py", "talker") as talker,
    ):
        talker.wait_for("Publishing")
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        assert own_participants(domain) == frozenset()
        with direct_node.DirectNode():
            assert len(own_participants(domain)) == 1
            assert own_participants(domain) < participants_here(domain)


def test_half_a_service_is_not_all() -> None:
    """Its request came and its reply did not yet; a client is looked at by itself."""

    def of(*participants: bytes) -> list[SimpleNamespace]:
        return [SimpleNamespace(endpoint_gid=each + bytes(4)) for each in participants]

    server = {"rq/lightRequest": ([], of(US)), "rr/lightReply": (of(US), [])}
    client = {"rq/lightRequest": (of(THEM), of(US)), "rr/lightReply": (of(US), of(THEM))}
    half = {"rq/lightRequest": (of(THEM), of(US)), "rr/lightReply": (of(US), [])}
    assert (
        direct_node.with_half_a_service(server)
        == direct_node.with_half_a_service(client)
        == frozenset()
    )
    assert direct_node.with_half_a_service(half) == {THEM}
    assert direct_node.with_half_a_service({"rq/lightRequest": ([], of(US))}) == {US}
    assert direct_node.with_half_a_service({"rt/light": (of(US), [])}) == frozenset()
    everybody = frozenset({US, THEM})
    assert not Sight(everybody, everybody, 3, 0, 2, half_known=frozenset({THEM})).complete(2)


def test_who_has_ended_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """It was killed while it introduced its nodes: half of it is known, and no more will come."""
    monkeypatch.setattr(direct_node, "participants_here", lambda _: frozenset({7410, 7412}))
    monkeypatch.setattr(direct_node, "QUIET_S", 0.0)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    roll = RollCall(domain=0)
    roll._answered = {7410: US, 7412: THEM}
    everybody = frozenset({US, THEM, DEAD})
    with_dead = Sight(
        everybody, frozenset({US, THEM}), 5, unnamed=2, nodes=2, half_known=frozenset({DEAD})
    )
    settling = Settling(0, roll)
    assert any(settling.after(with_dead) for _ in range(direct_node.BELIEVED_READINGS + 1))
    without_them = Sight(
        everybody, frozenset({US}), 5, unnamed=2, nodes=2, half_known=frozenset({THEM})
    )
    waiting = Settling(0, roll)
    assert not any(waiting.after(without_them) for _ in range(50))


def test_beside_a_killed_program_nothing_is_missing_and_nothing_is_said(empty: Shell) -> None:
    """One node is killed, one lives and announces itself seldom, as plain Python does."""
    plain = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONPATH": python_path()}
    with (
        empty.program([sys.executable, "-c", PLAIN], **plain) as lives,
        empty.start("run", "demo_nodes_py", "talker") as killed,
    ):
        lives.wait_for("Publishing")
        killed.wait_for("Publishing")
        assert inside.run(empty, "node", "list").lines == ["/plain", "/talker"]
        os.killpg(killed.process.pid, signal.SIGKILL)
        killed.wait()
        for _ in range(3):
            ran = inside.run(empty, "node", "list")
            assert (ran.lines, ran.err) == (["/plain"], "")
            heard = inside.run(empty, "topic", "echo", "--once", "/chatter")
            assert heard.out.startswith("data: ")
            assert heard.err == ""


def test_a_stranger_leaves_no_trace_in_the_graph(empty: Shell) -> None:
    """Who only asks has no node, and holds no port of the domain."""
    domain = int(empty.environment["ROS_DOMAIN_ID"])
    with empty.start("run", "demo_nodes_py", "talker") as talker:
        talker.wait_for("Publishing")
        with RollCall(domain) as roll:
            (port,) = participants_here(domain)
            eventually(lambda: roll.named({port}) is not None)
            assert participants_here(domain) == {port}
            assert inside.run(empty, "node", "list").lines == ["/talker"]
