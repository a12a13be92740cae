"""The options of `ros2 topic`: what each changes in what is printed."""

from __future__ import annotations

import argparse
import re
import signal
from contextlib import ExitStack

import inside
import pytest
from published import QOS, SHAPE, shows
from terminal import Shell, eventually

from ros2_on_pip import qos
from ros2_on_pip.cli import parser_for
from ros2_on_pip.measuring import Ages, Arrival, delay_lines, few_rate
from ros2_on_pip.rates import measure_rate

pytestmark = pytest.mark.slow


def echo(shell: Shell, *words: str) -> str:
    """What `ros2 topic echo --once WORD...` prints."""
    ran = inside.run(shell, "topic", "echo", "--once", *words)
    assert ran.code == 0
    return ran.out


NO_HEADER = "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"


@shows("topic echo", *SHAPE, "--field", "--once")
@pytest.mark.parametrize(
    ("words", "out"),
    [
        ("/flag --field data", "True\n---\n"),
        ("/numbers --field data", "array('d', [0.0, 1.0, 2.0])\n---\n"),
        ("/numbers --field data -l 1", "array('d', [0.0, 1.0, 2.0])\n---\n"),
        ("/joints --field name", "['left']\n---\n"),
        ("/joints --field header.stamp", "sec: 0\nnanosec: 0\n---\n"),
        ("/numbers --field layout --csv", "0\n"),
        ("/numbers --field data --csv", "array('d', [0.0, 1.0, 2.0])\n---\n"),
        ("/flag --field data --csv", "True\n---\n"),
        (
            "/joints --flow-style",
            f"{NO_HEADER}name: [left]\nposition: [1.0, 2.0]\nvelocity: []\neffort: []\n---\n",
        ),
        (
            "/joints",
            f"{NO_HEADER}name:\n- left\nposition:\n- 1.0\n- 2.0\nvelocity: []\neffort: []\n---\n",
        ),
        ("/joints --csv", "0,0,,left,1.0,2.0,,\n"),
        ("/bytes --csv", "0,b'\\x01',b'\\x02'\n"),
        ("/joints --csv -l 1", "0,0,,l...,1.0,...,,\n"),
        ("/joints --csv -l 1 --full-length", "0,0,,left,1.0,2.0,,\n"),
        (
            "/joints --csv --no-arr",
            "0,0,,<sequence type: string, length: 1>,<sequence type: double, length: 2>,"
            "<sequence type: double, length: 0>,<sequence type: double, length: 0>\n",
        ),
        ("/plan", "data: the way\n---\n"),
        ("/plan --csv", "the way\n"),
        ("/plan --csv -l 3", "the...\n"),
        ("/plan -l 3", "data: the...\n---\n"),
        ("/plan -l 3 -f", "data: the way\n---\n"),
        ("/plan --no-str", "data: '<string length: <7>>'\n---\n"),
        ("/plan --no-str --csv", "<string length: <7>>\n"),
    ],
)
def test_echo_prints_as_jazzy_does(workshop: Shell, words: str, out: str) -> None:
    """Byte by byte: fields, flow style, CSV, what is cut and what is left out."""
    assert echo(workshop, *words.split()) == out


def test_an_empty_first_value_leaves_no_comma(workshop: Shell) -> None:
    """As the real tool has it: the list of dimensions is empty, and the offset follows."""
    assert echo(workshop, "/numbers", "--csv") == "0,0.0,1.0,2.0\n"


@shows("topic echo", "--raw", "--include-message-info", "--filter")
def test_echo_with_information_and_raw(workshop: Shell) -> None:
    """When it was sent and received, which number it has; the bytes as they came."""
    info = (
        r"publication_sequence_number: \d+\nreceived_timestamp: \d{19}\n"
        r"reception_sequence_number: null\nsource_timestamp: \d{19}\n---\n"
    )
    assert re.fullmatch(f"{info}data: true\n---\n", echo(workshop, "/flag", "-i"))
    csv = echo(workshop, "/flag", "--include-message-info", "--csv")
    assert re.fullmatch(r"\d{19},\d{19},\d+,None,True\n", csv)
    field = echo(workshop, "/flag", "-i", "--field", "data")
    assert field.startswith("---Got new message, message info:---\n{'source_timestamp': ")
    assert field.endswith("}\n---Message data:---\nTrue\n---\n")
    assert echo(workshop, "/flag", "--raw") == "b'\\x00\\x01\\x00\\x00\\x01\\x00\\x00\\x00'\n---\n"


@shows("topic echo", "--filter", "--timeout")
def test_echo_of_what_passes_a_filter(workshop: Shell) -> None:
    """An expression over the message, or over the chosen field; none passes, and time runs out."""
    assert echo(workshop, "/numbers", "--field", "data", "--filter", "len(m) == 3")
    ended = ("--timeout", "0.3")
    none = inside.run(workshop, "topic", "echo", "/numbers", "--filter", "m.data[0] > 1", *ended)
    assert (none.code, none.out, none.err) == (0, "", "")
    for expression, said in (("m.date", "has no attribute 'date'"), ("m.", "invalid syntax")):
        ran = inside.run(workshop, "topic", "echo", "/numbers", "--filter", expression)
        assert ran.code == 1
        assert said in ran.err


def test_an_index_in_a_field_is_told(workshop: Shell) -> None:
    """It works here, and not on a robot."""
    ran = inside.run(workshop, "topic", "echo", "--once", "/numbers", "--field", "data[2]")
    assert (ran.code, ran.out) == (0, "2.0\n---\n")
    assert ran.err == "NOTE: write data. On a robot, ros2 does not take 'data[2]' here.\n"


def test_echo_with_one_quality_starts_from_sensor_data(workshop: Shell) -> None:
    """So a map that was sent before does not come, as on a robot; with a second option it does."""
    kept = ("topic", "echo", "--once", "/plan", "--qos-durability", "transient_local")
    alone = inside.run(workshop, *kept, "--timeout", "1")
    assert (alone.code, alone.out) == (0, "")
    assert "Add: --qos-reliability reliable" in alone.err
    both = inside.run(workshop, *kept, "--qos-reliability", "reliable")
    assert (both.code, both.out, both.err) == (0, "data: the way\n---\n", "")
    assert echo(workshop, "/plan") == "data: the way\n---\n"


def asked(verb: str, *words: str) -> argparse.Namespace:
    """The options of `ros2 VERB WORD...`."""
    return parser_for(verb.split()[0]).parse_args([*verb.split(), *words])


@shows("topic echo", *QOS)
@shows("service echo", *QOS)
def test_the_quality_that_a_listener_asks_for(workshop: Shell) -> None:
    """Others see most of it; of depth and history DDS tells nobody, so the profile is looked at."""
    every = (
        "--qos-reliability",
        "reliable",
        "--qos-durability",
        "transient_local",
        "--qos-liveliness",
        "manual_by_topic",
        "--qos-liveliness-lease-duration-seconds",
        "5",
    )
    kind = "std_msgs/msg/String"
    with (
        workshop.start("topic", "echo", "/a", kind, *every),
        workshop.start("topic", "echo", "/b", kind),
        workshop.start("topic", "echo", "/c", kind, "--qos-profile", "default"),
        workshop.start("service", "echo", "/lamp", *every),
    ):
        for topic, lines in (
            ("/a", ("RELIABLE", "TRANSIENT_LOCAL", "MANUAL_BY_TOPIC", "5000000000 nanoseconds")),
            ("/b", ("BEST_EFFORT", "VOLATILE", "AUTOMATIC", "Infinite")),
            ("/c", ("RELIABLE", "VOLATILE", "AUTOMATIC", "Infinite")),
            (
                "/lamp/_service_event",
                ("RELIABLE", "TRANSIENT_LOCAL", "MANUAL_BY_TOPIC", "5000000000 nanoseconds"),
            ),
        ):
            shown = subscribed(workshop, topic)
            for word, value in zip(
                ("Reliability", "Durability", "Liveliness", "Liveliness lease duration"),
                lines,
                strict=True,
            ):
                assert f"  {word}: {value}" in shown, topic
    for verb, preset in (("topic echo", "sensor_data"), ("service echo", "services_default")):
        depth = qos.chosen(asked(verb, "/a", "--qos-depth", "77"), preset)
        assert (depth.depth, depth.history.name) == (77, "KEEP_LAST")
        kept = qos.chosen(asked(verb, "/a", "--qos-history", "keep_all"), preset)
        assert kept.history.name == "KEEP_ALL"
        chosen = qos.chosen(asked(verb, "/a", "--qos-profile", "parameters"), preset)
        assert chosen.depth == 1000


def subscribed(shell: Shell, topic: str) -> list[str]:
    """How somebody has subscribed to `topic`, as soon as somebody has."""
    counted = "Subscription count: 1"
    eventually(lambda: counted in inside.run(shell, "topic", "info", "-v", topic).out)
    return inside.run(shell, "topic", "info", "-v", topic).out.partition(counted)[2].splitlines()


@shows("topic pub", *QOS, "--node-name")
def test_the_quality_that_a_publisher_offers(empty: Shell) -> None:
    """Others see it; of depth and history what a late listener still gets."""
    kind, name = "std_msgs/msg/String", ("--node-name", "speaker")
    every = (
        "--qos-reliability",
        "best_effort",
        "--qos-durability",
        "transient_local",
        "--qos-liveliness",
        "manual_by_topic",
        "--qos-liveliness-lease-duration-seconds",
        "5",
    )
    with (
        empty.start("topic", "pub", "/a", kind, *every, *name) as a,
        empty.start("topic", "pub", "/b", kind, "--qos-profile", "sensor_data") as b,
    ):
        a.wait_for("publishing #1")
        b.wait_for("publishing #1")
        shown = inside.run(empty, "topic", "info", "-v", "/a").out
        for line in (
            "Node name: speaker",
            "  Reliability: BEST_EFFORT",
            "  Durability: TRANSIENT_LOCAL",
            "  Liveliness: MANUAL_BY_TOPIC",
            "  Liveliness lease duration: 5000000000 nanoseconds",
        ):
            assert f"{line}\n" in shown
        assert "  Reliability: BEST_EFFORT\n" in inside.run(empty, "topic", "info", "-v", "/b").out


@shows("topic pub", "--qos-depth", "--qos-history", "--keep-alive", "--times", "--rate", "--print")
@pytest.mark.parametrize(
    ("words", "heard"),
    [
        (("--qos-depth", "2"), ["4", "5"]),
        (("--qos-history", "keep_all"), ["1", "2", "3", "4", "5"]),
    ],
)
def test_what_a_publisher_keeps_for_those_who_come_late(
    empty: Shell, words: tuple[str, ...], heard: list[str]
) -> None:
    """The last ones, or all; it stays for them after its last message."""
    said = ("-t", "5", "-r", "100", "-w", "0", "-p", "5", "--keep-alive", "600")
    kept = ("--qos-durability", "transient_local", "--qos-reliability", "reliable", *words)
    kind = "rcl_interfaces/msg/ParameterEvent"
    with empty.start("topic", "pub", "/late", kind, "{stamp: now}", *said, *kept) as pub:
        pub.wait_for("publishing #5")
        assert "publishing #4" not in pub.text
        every = ("--qos-durability", "transient_local", "--qos-reliability", "reliable")
        echo = ("topic", "echo", "/late", "--field", "node", "-i", "--qos-depth", "10", *every)
        with empty.start(*echo) as late:
            late.wait_for(f"'publication_sequence_number': {heard[-1]},")
            numbers = re.findall(r"'publication_sequence_number': (\d+)", late.text)
    assert numbers == heard


@shows("topic pub", "--stdin", "--once", "--wait-matching-subscriptions", "--max-wait-time-secs")
def test_pub_of_what_another_program_writes(stage: Shell) -> None:
    """`--stdin`; and how many must listen, and how long that is waited for."""
    pub = ("topic", "pub", "--once", "/heard", "std_msgs/msg/String")
    ran = inside.run(stage, *pub, "--stdin", stdin="data: from a pipe\n")
    assert "publishing #1: std_msgs.msg.String(data='from a pipe')" in ran.lines
    stage.wait_heard("from a pipe")
    alone = inside.run(stage, *pub, "-w", "2", "--max-wait-time-secs", "0.1")
    assert alone.code == 1
    assert alone.lines[0] == "Waiting for at least 2 matching subscription(s)..."
    assert alone.err.startswith(
        "Timed out waiting for subscribers: Expected 2 subscribers but only got 1 subscribers"
    )


@shows("topic pub", "--use-sim-time", "--spin-time")
def test_pub_in_simulated_time(workshop: Shell) -> None:
    """Its stamps are the time of /clock, and its beat is too: the 100th second comes soon."""
    words = ("topic", "pub", "-s", "-r", "1", "/stamped", "std_msgs/msg/Header", "{stamp: now}")
    with workshop.start(*words) as pub:
        pub.wait_for("publishing #5:")
        stamps = [int(sec) for sec in re.findall(r"\(sec=(\d+)", pub.text)]
    assert max(stamps) < 1_000_000, "the time since 1970 is no simulated time"
    assert len(set(stamps)) == len(stamps)


@shows("topic hz", "--filter", "--window", "--spin-time", "--use-sim-time", "--wall-time")
def test_hz_of_some_messages_and_of_a_small_window(workshop: Shell) -> None:
    """/tick comes each 0.02 s of this computer and each 0.2 s of its own time."""
    each_tenth = "int(m.data) // 200_000_000 % 10 == 0"
    with (
        workshop.start("topic", "hz", "/tick", "-w", "3") as small,
        workshop.start("topic", "hz", "/tick", "--filter", each_tenth) as some,
        workshop.start("topic", "hz", "/tick", "--use-sim-time", "-w", "20") as by_sim,
        workshop.start("topic", "hz", "/tick", "-s", "--wall-time", "-w", "20") as by_wall,
    ):
        small.wait_for("window: 3$")
        small.wait_for(r"^\tlost: \d+ of \d+ messages$")
        some.wait_for("lost: not known, because --filter leaves messages out")
        some.wait_for(r"^average rate: [1-9]\.\d{3}$")
        by_sim.wait_for(r"^average rate: [1-9]\.\d{3}$")
        by_wall.wait_for(r"^average rate: [1-9]\d\.\d{3}$")


def test_a_small_window_has_a_rate() -> None:
    """Of three periods the mean, and how many messages are missing among them."""
    arrivals = [Arrival(n * 10**8, n, n * 10**8, 10) for n in (1, 2, 4, 5)]
    rate = few_rate(arrivals)
    assert rate
    assert (round(rate.hz, 3), rate.lost) == (7.5, 1)


def test_two_messages_have_a_rate() -> None:
    """The first line of `topic hz` comes with the second message, as the real one's."""
    arrivals = [Arrival(n * 10**8, n, n * 10**8, 10) for n in (1, 2, 3, 4, 5, 6)]
    shown = [measure_rate(arrivals[:count]) or few_rate(arrivals[:count]) for count in range(7)]  # type: ignore[arg-type]  # only the stamps are read
    assert [bool(rate) for rate in shown] == [False, False, True, True, True, True, True]
    assert {round(rate.hz, 6) for rate in shown if rate} == {10.0}


@shows("topic bw", "--window")
@shows("topic delay", "--window", "--spin-time", "--use-sim-time")
def test_delay_and_bw_of_the_newest_messages(workshop: Shell) -> None:
    """The pose is half a second old, and by the simulated time far in the future."""
    with (
        workshop.start("topic", "delay", "/pose", "-w", "4") as delay,
        workshop.start("topic", "delay", "/pose", "-s") as by_sim,
        workshop.start("topic", "bw", "/flag", "-w", "2") as bw,
    ):
        delay.wait_for(r"^average delay: \d+\.\d{3}$")
        delay.wait_for(r"^\tmin: \d+\.\d{3}s max: \d+\.\d{3}s std dev: \d+\.\d{5}s window: 4$")
        by_sim.wait_for(r"^average delay: -\d+\.\d{3}$")
        bw.wait_for(r"from 2 messages$")
        shown = [float(text) for text in re.findall(r"average delay: ([\d.]+)", delay.text)]
    assert min(shown) >= 0.5
    without = inside.run(workshop, "topic", "delay", "/flag")
    assert without.code == 1
    assert "msg does not have header" in without.err


class Standing:
    """A clock that stands still."""

    nanoseconds = 0

    def now(self) -> Standing:
        """The one moment that it has."""
        return self


def test_delay_before_the_simulated_time_begins() -> None:
    """No message counts, and nothing is printed; one that stays away is told."""
    ages = Ages(10, Standing())
    ages.hear(object())
    assert ages.lines() == []
    ages.delays_s.append(0.5)
    assert ages.lines() == ["no new messages"]
    assert delay_lines([0.25, 0.75])[0] == "average delay: 0.500"


@shows("topic echo", "--no-lost-messages")
def test_lost_messages_are_told_or_not(empty: Shell) -> None:
    """Two listeners are stopped while more is said than the computer keeps for them."""
    flood = (
        "topic",
        "pub",
        "-r",
        "2000",
        "-p",
        "500",
        "/flood",
        "std_msgs/msg/String",
        "{data: " + "x" * 2000 + "}",
        "--qos-reliability",
        "best_effort",
        "--qos-depth",
        "1",
    )
    hear = ("topic", "echo", "/flood", "std_msgs/msg/String", "--field", "data", "-i")
    with (
        empty.start(*flood) as pub,
        empty.start(*hear) as telling,
        empty.start(*hear, "--no-lost-messages") as silent,
    ):
        for listener in (telling, silent):
            listener.wait_for("Message data")
        for listener in (telling, silent):
            listener.process.send_signal(signal.SIGSTOP)
        before = pub.text.count("publishing #")
        pub.wait_for("publishing #", times=before + 6)
        for listener in (telling, silent):
            listener.process.send_signal(signal.SIGCONT)
        telling.wait_for("^A message was lost!!!$")
        telling.wait_for(r"^\ttotal count change:\d+$")
        telling.wait_for(r"^\ttotal count: \d+---$")
        gap = int(re.findall(r"number': (\d+)", silent.text)[-1]) + 2000
        silent.wait_for(rf"'publication_sequence_number': ({gap // 1000 + 1}\d\d\d),")
        assert "lost" not in silent.text


@shows("service echo", *SHAPE)
def test_service_echo(workshop: Shell) -> None:
    """What is asked and answered, in each shape."""
    forms = {
        "plain": (),
        "flow": ("--flow-style",),
        "csv": ("--csv",),
        "short": ("-l", "1"),
        "whole": ("-l", "1", "-f"),
        "counted": ("--no-arr",),
        "mute": ("--no-str",),
    }
    with ExitStack() as stack:
        echoes = {
            name: stack.enter_context(workshop.start("service", "echo", "/lamp", *words))
            for name, words in forms.items()
        }
        info = ("topic", "info", "/lamp/_service_event")
        heard = f"Subscription count: {len(forms)}\n"
        eventually(lambda: heard in inside.run(workshop, *info).out)
        words = ("service", "call", "/lamp", "std_srvs/srv/SetBool", "{data: true}")
        assert inside.run(workshop, *words).code == 0
        for name, echoed in echoes.items():
            echoed.wait_for("," if name == "csv" else "^---$", times=2)
    text = echoes["plain"].text
    assert text.startswith("info:\n  event_type: REQUEST_RECEIVED\n  stamp:\n    sec: ")
    assert "request:\n- data: true\nresponse: []\n---" in text
    assert "event_type: RESPONSE_SENT" in text
    assert "response:\n- success: true\n  message: 'on'\n---" in text
    assert "request: [{data: true}]\n" in echoes["flow"].text
    assert re.search(r"^1,\d+,\d+,(\d+,){16}\d+,True,$", echoes["csv"].text, re.MULTILINE)
    assert "message: o...\n" in echoes["short"].text
    assert "message: 'on'\n" in echoes["whole"].text
    assert "response: '<sequence type: std_srvs/msg/SetBool_Response" in echoes["counted"].text
    assert "message: '<string length: <2>>'" in echoes["mute"].text


@shows("topic echo", "--once")
def test_service_echo_of_one_that_tells_nothing(stage: Shell) -> None:
    """It is said, as the real tool does."""
    with stage.start("service", "echo", "/light") as echoed:
        echoed.wait_for(
            "^No publishers on topic '/light/_service_event'; is service introspection on the"
            " client or server enabled[?]$"
        )
    assert "Did you mean /light?" in inside.run(stage, "service", "echo", "/ligth").err


def test_topic_list_where_nothing_runs(empty: Shell) -> None:
    """The two topics that every node has: the real tool's own node has them too."""
    assert inside.run(empty, "topic", "list").lines == ["/parameter_events", "/rosout"]
    assert inside.run(empty, "topic", "list", "-c").lines == ["2"]
