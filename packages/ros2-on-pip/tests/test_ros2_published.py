"""Every verb and option of the published command line is here, and some test shows it."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import inside
import pytest
from published import LOOK, PUBLISHED, SHORT, SHOWN, shows
from terminal import HERE, Shell

from ros2_on_pip import discovery as direct_node
from ros2_on_pip.cli import parser_for
from ros2_on_pip.commands.doctor import parser_for as doctor_parser_for
from ros2_on_pip.commands.hello import parser_for as hello_parser_for
from ros2_on_pip.discovery import Settling, Sight
from ros2_on_pip.words import CommandParser

LOOKING = {
    "action info": ("/fibonacci",),
    "action list": (),
    "action type": ("/fibonacci",),
    "lifecycle get": ("/motor",),
    "lifecycle list": ("/motor",),
    "lifecycle nodes": (),
    "node info": ("/talker",),
    "node list": (),
    "param describe": ("/tuner", "speed"),
    "param dump": ("/talker",),
    "param get": ("/talker", "use_sim_time"),
    "param list": ("/tuner",),
    "service info": ("/light",),
    "service list": (),
    "service type": ("/light",),
    "topic find": ("std_msgs/msg/String",),
    "topic info": ("/chatter",),
    "topic list": ("-t",),
    "topic type": ("/chatter",),
}
"""What is looked at with `LOOK`, which changes nothing in what is seen."""


def parser_of(words: str) -> argparse.ArgumentParser:
    """The parser of a verb, or of a command."""
    command, *verbs = words.split()
    if words == "wtf hello":
        return hello_parser_for("wtf")
    if words == "doctor":
        return doctor_parser_for("doctor")
    parser: argparse.ArgumentParser = parser_for(command)
    for word in (command, *verbs):
        parser = children_of(parser)[word]
    return parser


def children_of(parser: argparse.ArgumentParser) -> dict[str, CommandParser]:
    """The words that may follow."""
    actions = parser._actions  # argparse has no other way to look
    return next(a.choices for a in actions if isinstance(a, argparse._SubParsersAction))  # type: ignore[return-value]


@pytest.mark.parametrize("verb", PUBLISHED)
def test_every_published_option_is_taken(verb: str) -> None:
    """By its full name, and the help says what it does."""
    taken = {
        name: action.help for action in parser_of(verb)._actions for name in action.option_strings
    }
    assert set(PUBLISHED[verb]) <= set(taken)
    assert all(taken[option] not in (None, "", argparse.SUPPRESS) for option in PUBLISHED[verb])


def words_with(parser: argparse.ArgumentParser, option: argparse.Action, form: str) -> list[str]:
    """The fewest words that a verb takes together with one option."""
    needed = [one for one in parser._actions if not one.option_strings and one.required]
    words = ["list" if isinstance(one, argparse._SubParsersAction) else "1" for one in needed]
    value = [] if option.nargs == 0 else [value_of(option)]
    return [form, *value, *words] if option.nargs != "+" else [*words, form, *value]


def value_of(option: argparse.Action) -> str:
    """One that it takes."""
    if option.choices:
        return str(next(iter(option.choices)))
    return "225.0.0.1" if option.dest == "group" else "1"


@pytest.mark.parametrize("verb", PUBLISHED)
def test_each_option_that_only_we_take_is_told(
    verb: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line says so, for the habit breaks on a robot; the others are taken without a word."""
    parser = parser_of(verb)
    real = {*PUBLISHED[verb], *SHORT.get(verb, "-s").split(), "-h", "--help"}
    for option in parser._actions:
        for form in set(option.option_strings) - {"-h", "--help"}:
            parser.parse_args(words_with(parser, option, form))
            told = capsys.readouterr().err
            assert told.startswith("NOTE: ") == (form not in real), f"{form}: {told}"
            assert told.count("\n") == (form not in real)
            assert not told or form in told


def wanted() -> Iterator[tuple[str, str]]:
    """Each verb and each of its options."""
    for verb, options in PUBLISHED.items():
        yield verb, ""
        yield from ((verb, option) for option in options)


def test_every_published_option_is_shown_by_a_test() -> None:
    """A test says with `@shows` what it shows; none is left out, none is misspelt."""
    for file in sorted(HERE.glob("test_ros2_*.py")):
        import_module(file.stem)
    assert set(wanted()) - SHOWN == set()
    assert SHOWN - set(wanted()) == set()


@shows("topic echo", *LOOK)
@shows("topic bw", "--spin-time", "--use-sim-time")
@shows("service echo")
def test_the_other_words_of_looking_are_shown_where_they_matter() -> None:
    """Of those that listen `-s` is shown by hz, delay and pub; here, that each takes them."""
    for verb in ("topic echo", "topic bw", "topic delay", "topic hz", "topic pub", "service echo"):
        assert {"--spin-time", "--use-sim-time"} <= {
            name for action in parser_of(verb)._actions for name in action.option_strings
        }


def shown_by_looking(verb: str) -> None:
    """Each of these verbs is run with all three."""
    shows(verb, *LOOK)(shown_by_looking)


for one in LOOKING:
    shown_by_looking(one)


@pytest.mark.slow
@pytest.mark.parametrize("verb", LOOKING)
def test_how_to_look_changes_nothing_in_what_is_seen(stage: Shell, verb: str) -> None:
    """There is no daemon to leave out, and a look ends when it is complete."""
    words = (*verb.split(), *LOOKING[verb])
    plain = inside.run(stage, *words)
    ways = inside.run(stage, *words, "--no-daemon", "--use-sim-time", "--spin-time", "0.1")
    assert plain.code == 0
    assert (ways.code, ways.out) == (0, plain.out)


def test_spin_time_is_the_least_that_a_look_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nodes of another computer begin late, a longer look sees them too."""
    now_s = iter((100.0, 100.0, 100.0, *(100.0 + n for n in range(20))))
    monkeypatch.setattr(direct_node.time, "monotonic", lambda: next(now_s))
    monkeypatch.setattr(direct_node, "participants_here", lambda _: frozenset({7410}))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    seen = Sight(frozenset({b"us"}), frozenset({b"us"}), endpoints=3, unnamed=0, nodes=1)
    settling = Settling(domain=0, at_least_s=5.0)
    looks = [settling.after(seen) for _ in range(direct_node.BELIEVED_READINGS + 8)]
    assert True in looks
    assert next(now_s) - 100.0 > 5.0 + len(looks[looks.index(True) + 1 :])


@pytest.mark.slow
@shows("node list", "--all", "--count-nodes")
@shows("node info", "--include-hidden")
@shows("action list", "--show-types", "--count-actions")
@shows("action info", "--show-types", "--count")
@shows("topic list", "--show-types", "--count-topics", "--include-hidden-topics", "--verbose")
@shows("topic info", "--verbose")
@shows("topic find", "--count-topics", "--include-hidden-topics")
@shows("service list", "--show-types", "--count-services", "--include-hidden-services")
@shows("service find", "--count-services", "--include-hidden-services")
@shows("lifecycle nodes", "--all", "--count-nodes")
@shows("lifecycle list", "--all")
@shows("topic", "--include-hidden-topics")
@shows("service", "--include-hidden-services")
@pytest.mark.parametrize(
    ("words", "shown"),
    [
        ("node list -a", "/_hidden\n"),
        ("node list -c", "5\n"),
        ("node info /_hidden --include-hidden", "/_hidden\n"),
        ("action list -t", "/fibonacci [test_msgs/action/Fibonacci]\n"),
        ("action list -c", "1\n"),
        ("action info /fibonacci -t", "    /tuner [test_msgs/action/Fibonacci]\n"),
        ("topic list -t", "/chatter [std_msgs/msg/String]\n"),
        ("topic list -c", "7\n"),
        ("topic list --include-hidden-topics", "/_whisper\n"),
        ("topic --include-hidden-topics list", "/_whisper\n"),
        ("topic list -v", " * /chatter [std_msgs/msg/String] 1 publisher\n"),
        ("topic info -v /scan", "  Reliability: BEST_EFFORT\n"),
        ("topic find -c std_msgs/msg/String", "2\n"),
        ("topic find std_msgs/msg/String --include-hidden-topics", "/_whisper\n"),
        ("service list -t", "/light [std_srvs/srv/SetBool]\n"),
        ("service list --include-hidden-services", "/fibonacci/_action/send_goal\n"),
        ("service --include-hidden-services list", "/fibonacci/_action/send_goal\n"),
        ("service find -c std_srvs/srv/SetBool", "1\n"),
        (
            "service find --include-hidden-services test_msgs/action/Fibonacci_SendGoal",
            "/fibonacci/_action/send_goal\n",
        ),
        ("lifecycle nodes -c", "1\n"),
        ("lifecycle list /motor -a", "- transition_success [10]\n"),
    ],
)
def test_what_an_option_of_looking_shows(stage: Shell, words: str, shown: str) -> None:
    """The line that is there with the option, and not without."""
    verb = [word for word in words.split() if not word.startswith("-")]
    with_it, without = inside.run(stage, *words.split()), inside.run(stage, *verb)
    assert (with_it.code, shown in with_it.out) == (0, True)
    assert shown not in without.out


@pytest.mark.slow
@shows("lifecycle get", "--include-hidden-nodes")
@shows("lifecycle set", "--include-hidden-nodes", *LOOK)
@shows("lifecycle list", "--include-hidden-nodes")
@shows("param describe", "--include-hidden-nodes")
@shows("param dump", "--include-hidden-nodes")
@shows("param get", "--include-hidden-nodes")
@shows("param list", "--include-hidden-nodes")
@shows("param load", "--include-hidden-nodes", *LOOK)
@shows("param set", "--include-hidden-nodes", *LOOK)
@shows("param delete", "--include-hidden-nodes", *LOOK)
@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("param describe /_hidden use_sim_time", "Parameter name: use_sim_time"),
        ("param dump /_hidden", "/_hidden:"),
        ("param get /_hidden use_sim_time", "Boolean value is: False"),
        ("param list /_hidden", "  use_sim_time"),
        ("param set /_hidden use_sim_time false", "Set parameter successful"),
        ("param load /_hidden {file}", "Set parameter use_sim_time successful"),
        ("param delete /_hidden use_sim_time", "cannot be undeclared"),
        ("lifecycle get /_hidden", "'/_hidden' runs, but it is no lifecycle node"),
        ("lifecycle list /_hidden", "'/_hidden' runs, but it is no lifecycle node"),
        ("lifecycle set /_hidden configure", "'/_hidden' runs, but it is no lifecycle node"),
    ],
)
def test_a_hidden_node_is_found_when_asked_for(
    stage: Shell, tmp_path: Path, words: str, said: str
) -> None:
    """And not found where it is not."""
    file = tmp_path / "hidden.yaml"
    file.write_text("/**:\n  ros__parameters:\n    use_sim_time: false\n")
    asked = words.format(file=file).split()
    ways = ("--include-hidden-nodes", "--no-daemon", "--spin-time", "0", "-s")
    found, lost = inside.run(stage, *asked, *ways), inside.run(stage, *asked)
    assert said in found.out + found.err
    assert "Node not found: '/_hidden'" in lost.err
