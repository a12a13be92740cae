"""What a launch file may lean on in actions, nodes and events, where no process is started."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from inside import run
from launched import (
    Launch,
    actions,
    base,
    conditions,
    events,
    handlers,
    logged,
    of,
    process_events,
    ros,
    sources,
    subs,
)
from terminal import Ran, Shell

from ros2_on_pip.launching.places import BadLaunchFile

Given = subs.LaunchConfiguration
Out = pytest.CaptureFixture[str]


def told(command: list[str]) -> list[str]:
    """What ROS reads of a command, without the options."""
    return command[command.index("--ros-args") + 1 :][1::2]


def teller(**words: Any) -> Any:
    """The node of the package."""
    return ros.Node(package="mine", executable="teller", **words)


def test_a_description_is_carried_out_in_order(launch: Launch, capsys: Out) -> None:
    """What is added later comes last; a description may stand inside another."""
    description = base.LaunchDescription([actions.LogInfo(msg="one")])
    description.add_action(actions.LogInfo(msg="two"))
    description.add_entity(base.LaunchDescription([actions.LogInfo(msg=["th", "ree"])]))
    launch.visit(description, actions.LogInfo(msg="four"))
    assert logged(capsys) == ["one", "two", "three", "four"]
    assert len(description.entities) == 3


def test_a_deprecated_description_says_so(launch: Launch, capsys: Out) -> None:
    """When it is carried out; everything in it is done all the same."""
    old = base.LaunchDescription([actions.LogInfo(msg="done")], deprecated_reason="use new")
    assert old.deprecated and not base.LaunchDescription().deprecated
    launch.visit(old)
    told = capsys.readouterr().out
    assert told.startswith("[WARNING] [root]: deprecated launch description: use new\n")
    assert told.endswith("done\n")


def test_a_line_of_the_launch_file_has_its_level_and_its_name(launch: Launch, capsys: Out) -> None:
    """As Jazzy prints it."""
    launch.visit(actions.LogInfo(msg=["side: ", Given("side", default="left")]))
    assert capsys.readouterr().out == "[INFO] [launch.user]: side: left\n"


def test_a_group_keeps_inside_what_is_set_inside(launch: Launch) -> None:
    """Configurations and the environment; with scoped=False it comes out."""
    inside = [
        actions.SetLaunchConfiguration("a", "inner"),
        actions.SetEnvironmentVariable("MOOD", "inner"),
    ]
    launch.visit(
        actions.SetLaunchConfiguration("a", "outer"),
        actions.SetEnvironmentVariable("MOOD", "outer"),
        actions.GroupAction(inside),
    )
    assert (launch.context.launch_configurations["a"], os.environ["MOOD"]) == ("outer", "outer")
    launch.visit(actions.GroupAction(inside, scoped=False))
    assert (launch.context.launch_configurations["a"], os.environ["MOOD"]) == ("inner", "inner")


def test_a_group_takes_configurations_of_its_own(launch: Launch, capsys: Out) -> None:
    """They count inside alone; without forwarding nothing else is there."""
    shown = [actions.LogInfo(msg=[Given("a", default="-"), Given("b", default="-")])]
    set_outside = actions.SetLaunchConfiguration("a", "1")
    own = {"b": [Given("a"), "2"]}
    launch.visit(
        set_outside,
        actions.GroupAction(shown, launch_configurations=own),
        actions.GroupAction(shown, launch_configurations=own, forwarding=False),
        actions.GroupAction(shown, forwarding=False),
    )
    assert logged(capsys) == ["112", "-12", "--"]
    assert launch.context.launch_configurations == {"a": "1"}


def test_a_group_has_one_condition_for_all(launch: Launch, capsys: Out) -> None:
    """Nothing in it is carried out where it does not hold."""
    line = [actions.LogInfo(msg="inside")]
    launch.visit(
        actions.GroupAction(line, condition=conditions.IfCondition("false")),
        actions.GroupAction(line, condition=conditions.IfCondition("true")),
    )
    assert logged(capsys) == ["inside"]


def test_namespaces_are_put_into_each_other(launch: Launch) -> None:
    """An absolute one begins anew; what a node says itself comes last; a group ends it."""
    launch.visit(
        actions.GroupAction(
            [
                ros.PushRosNamespace("outer"),
                teller(),
                teller(namespace="own"),
                actions.GroupAction([ros.PushROSNamespace("inner"), teller()]),
                actions.GroupAction([ros.PushRosNamespace("/away"), teller()]),
                teller(namespace="/root"),
            ]
        ),
        teller(),
        teller(namespace="alone"),
    )
    assert [told(one.command) for one in launch.context.planned] == [
        ["__ns:=/outer"],
        ["__ns:=/outer/own"],
        ["__ns:=/outer/inner"],
        ["__ns:=/away"],
        ["__ns:=/root"],
        [],
        ["__ns:=/alone"],
    ]


def test_a_node_is_told_its_name_and_its_other_names(launch: Launch) -> None:
    """In order, behind --ros-args; each may be a substitution."""
    launch.context.launch_configurations["to"] = "/news"
    node = teller(name="ear", remappings=[("topic", Given("to")), ("a", "b")])
    command = launch.plan(node).command
    assert command[0] == str(launch.folder / "lib" / "mine" / "teller")
    assert told(command) == ["__node:=ear", "topic:=/news", "a:=b"]


def test_the_words_of_a_node_come_before_those_of_ros(launch: Launch) -> None:
    """`arguments` are the program's own, `ros_arguments` stand behind --ros-args."""
    node = teller(arguments=["one", ["two ", Given("x")]], ros_arguments=["--log-level", "debug"])
    launch.context.launch_configurations["x"] = "words"
    assert launch.plan(node).command[1:] == [
        "one",
        "two words",
        "--ros-args",
        "--log-level",
        "debug",
    ]


def test_a_node_without_a_package_is_a_program(launch: Launch) -> None:
    """By its path."""
    program = str(launch.folder / "lib" / "mine" / "teller")
    planned = launch.plan(ros.Node(executable=program, exec_name="other"))
    assert planned.command == [program, "--ros-args"]
    assert planned.name.rpartition("-")[0] == "other"


@pytest.mark.parametrize("wrong", [{"name": "a/b"}, {"namespace": "2nd"}, {"package": "none"}])
def test_a_node_with_a_wrong_name_ends_the_launch(launch: Launch, wrong: dict[str, str]) -> None:
    """Its own, its namespace's, its package's."""
    with pytest.raises(BadLaunchFile):
        launch.visit(ros.Node(**{"package": "mine", "executable": "teller", **wrong}))


@pytest.mark.parametrize("wrong", ["2nd", "a b", "a//b", "a-b"])
def test_a_wrong_namespace_is_refused_when_it_is_pushed(launch: Launch, wrong: str) -> None:
    """Also where no node follows."""
    with pytest.raises(BadLaunchFile, match="is no namespace"):
        launch.visit(ros.PushRosNamespace(wrong))
    launch.visit(ros.PushRosNamespace("a_b2/c"))


def test_what_is_set_for_all_nodes_counts_for_those_that_follow(launch: Launch) -> None:
    """Parameters, files of them and other names; a group ends it, a node's own come later."""
    file = launch.folder / "a.yaml"
    file.write_text("/**: {ros__parameters: {a: 1}}\n")
    launch.visit(
        teller(),
        actions.GroupAction(
            [
                ros.SetParameter("speed", 2.5),
                ros.SetParametersFromFile(str(file)),
                ros.SetRemap("topic", "/news"),
                teller(remappings=[("topic", "/own")]),
            ]
        ),
        teller(),
    )
    before, inside, behind = (told(one.command) for one in launch.context.planned)
    assert before == behind == []
    assert inside == [
        "speed:=2.5",
        str(file),
        "topic:=/news",
        "topic:=/own",
    ]


def test_a_parameter_for_all_is_written_without_quotes(launch: Launch) -> None:
    """So a text of digits is a number for the node, and a dictionary is several names."""
    launch.visit(ros.SetParameter("a", "7"), ros.SetParameter("b", {"c": True, "d": "e"}), teller())
    assert told(launch.context.planned[-1].command) == ["a:=7", "b.c:=True", "b.d:=e"]


def test_sim_time_of_the_launch_reaches_no_node(launch: Launch, capsys: Out) -> None:
    """It is said where the nodes get it; False ends the launch."""
    assert told(launch.plan(ros.SetUseSimTime(True), teller()).command) == []
    assert "SetParameter('use_sim_time', True)" in capsys.readouterr().out
    with pytest.raises(BadLaunchFile, match="takes True alone"):
        launch.visit(ros.SetUseSimTime(False))


def test_the_environment_of_a_process(launch: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    """That of the launch, and more; or one that is given, and more."""
    monkeypatch.setenv("MOOD", "calm")
    more = {"MOOD": [subs.EnvironmentVariable("MOOD"), "er"], "NEW": "1"}
    added = launch.plan(teller(additional_env=more)).environment
    assert (added["MOOD"], added["NEW"], "PATH" in added) == ("calmer", "1", True)
    given = launch.plan(teller(env={"ONLY": "this"}, additional_env={"NEW": "1"})).environment
    assert (given["ONLY"], given["NEW"]) == ("this", "1")
    assert not {"MOOD", "PATH", "HOME"} & set(given)


def test_variables_are_set_grown_and_taken_away(launch: Launch) -> None:
    """For all that follows; one that is not there begins with the value."""
    for action in (
        actions.SetEnvironmentVariable("A", "x"),
        actions.AppendEnvironmentVariable("A", "y"),
        actions.AppendEnvironmentVariable("A", "w", prepend=True, separator=" "),
        actions.AppendEnvironmentVariable("B", "z"),
        actions.SetEnvironmentVariable("C", "x"),
        actions.UnsetEnvironmentVariable("C"),
        actions.UnsetEnvironmentVariable("NEVER"),
    ):
        launch.visit(action)
    assert (os.environ["A"], os.environ["B"], "C" in os.environ) == ("w x:y", "z", False)


def test_what_is_empty_is_grown_too(launch: Launch) -> None:
    """The separator stands behind nothing then."""
    for word, first in (("A", False), ("B", True)):
        launch.visit(
            actions.SetEnvironmentVariable(word, ""),
            actions.AppendEnvironmentVariable(word, "x", prepend=first),
        )
    assert (os.environ["A"], os.environ["B"]) == (":x", "x:")


def test_a_process_with_a_prefix_is_called_as_the_prefix_is(launch: Launch) -> None:
    """Unless it has a name; a prefix of the command line is for the programs that it fits."""
    launch.visit(
        teller(prefix="nice -n 5"),
        teller(prefix="/usr/bin/nice", exec_name="mine"),
        actions.SetLaunchConfiguration("launch-prefix", "nice"),
        actions.SetLaunchConfiguration("launch-prefix-filter", "tell"),
        teller(exec_name="other"),
        actions.ExecuteProcess(cmd=["echo"], name="teller"),
    )
    names = [one.name for one in launch.context.planned]
    assert names == ["nice-1", "mine-2", "other-3", "teller-4"]
    prefixed = [one.command[0].endswith("nice") for one in launch.context.planned]
    assert prefixed == [True, True, True, False]


def test_what_a_process_is_started_with(launch: Launch) -> None:
    """Words, folder, prefix, shell and a name on the screen."""
    launch.context.launch_configurations["x"] = "two words"
    plain = launch.plan(
        actions.ExecuteProcess(
            cmd=["echo", Given("x"), ["a", Given("x")]], cwd="/tmp", prefix="nice -n 5"
        )
    )
    assert plain.command == ["nice", "-n", "5", "echo", "two words", "atwo words"]
    assert (plain.folder, plain.shell) == ("/tmp", False)
    shell = launch.plan(actions.ExecuteProcess(cmd=["echo $HOME"], shell=True, name="teller"))
    assert (shell.shell, shell.name.rpartition("-")[0]) == (True, "teller")


def test_each_process_has_a_number_of_its_own(launch: Launch) -> None:
    """In the order in which they are carried out."""
    launch.visit(teller(), teller(), actions.ExecuteProcess(cmd=["echo"]))
    assert [one.name for one in launch.context.planned] == ["teller-1", "teller-2", "echo-3"]


OUTPUTS: dict[Any, tuple[set[str], set[str]]] = {
    "screen": ({"screen"}, {"screen"}),
    "log": ({"log"}, {"log", "screen"}),
    "both": ({"screen", "log"}, {"screen", "log"}),
    "own_log": ({"own_log"}, {"own_log"}),
    "full": ({"screen", "log", "own_log"}, {"screen", "log", "own_log"}),
}


@pytest.mark.parametrize("output", OUTPUTS)
def test_where_the_output_of_a_process_goes(launch: Launch, output: str) -> None:
    """By word or by stream; what is not said is `log`."""
    stdout, stderr = OUTPUTS[output]
    assert launch.plan(teller(output=output)).output == {"stdout": stdout, "stderr": stderr}
    apart = launch.plan(teller(output={"stdout": "screen", "stderr": ["log"]})).output
    assert apart == {"stdout": {"screen"}, "stderr": {"log"}}
    assert launch.plan(teller()).output == {"stdout": {"log"}, "stderr": {"log", "screen"}}
    for wrong in ("scren", {"stdout": "scren"}, {"stdin": "screen"}, {"both": ["log", "full"]}):
        with pytest.raises(BadLaunchFile):
            launch.visit(teller(output=wrong))


def test_whether_a_process_comes_back(launch: Launch) -> None:
    """Never where nothing is said; for ever where nobody counts."""
    never, ever, some = (
        launch.plan(teller(**words)).respawn
        for words in (
            {},
            {"respawn": subs.TextSubstitution(text="true")},
            {"respawn": True, "respawn_delay": 2.0, "respawn_max_retries": 3},
        )
    )
    assert not never.wanted
    assert (ever.wanted, ever.delay_s, ever.most) == (True, 0.0, -1)
    assert (some.wanted, some.delay_s, some.most) == (True, 2.0, 3)


def test_how_long_a_process_may_take_to_end(launch: Launch) -> None:
    """Five seconds after SIGINT, five more after SIGTERM; or what it says, or the launch says."""

    def times(**words: str) -> tuple[float, float]:
        planned = launch.plan(teller(**words))
        return planned.sigterm_after_s, planned.sigkill_after_s

    assert times() == (5.0, 5.0)
    assert times(sigterm_timeout="1", sigkill_timeout="2.5") == (1.0, 2.5)
    launch.context.launch_configurations |= {"sigterm_timeout": "7", "sigkill_timeout": "8"}
    assert times() == (7.0, 8.0)
    assert times(sigterm_timeout="1") == (1.0, 8.0)


def test_a_process_is_carried_out_once(launch: Launch) -> None:
    """The same object a second time ends the launch."""
    node = teller()
    with pytest.raises(BadLaunchFile, match="a second time"):
        launch.visit(node, node)


def test_a_terminal_is_taken_as_a_wish(launch: Launch) -> None:
    """emulate_tty of Jazzy's files is no mistake here."""
    launch.visit(teller(emulate_tty=True, log_cmd=True))
    assert len(launch.context.planned) == 1


def test_a_function_makes_actions(launch: Launch, capsys: Out) -> None:
    """It knows the values of all arguments; its list is carried out where it stands."""

    def made(context: Any, word: str, *, end: str) -> list[Any]:
        assert isinstance(context, base.LaunchContext)
        return [actions.LogInfo(msg=word + Given("side").perform(context) + end)]

    launch.visit(
        actions.SetLaunchConfiguration("side", "left"),
        actions.OpaqueFunction(function=made, args=["the "], kwargs={"end": "!"}),
        actions.OpaqueFunction(function=lambda context: None),
        actions.LogInfo(msg="last"),
    )
    assert logged(capsys) == ["the left!", "last"]


INNER = (
    '<launch><arg name="who"/><arg name="end" default="!"/><log message="$(var who)$(var end)"/>'
)


def test_an_included_file_gets_its_arguments(launch: Launch, capsys: Out) -> None:
    """They stay set behind it, and what they are is known when it is reached."""
    (launch.folder / "inner.launch.xml").write_text(f"{INNER}</launch>")
    source = sources.AnyLaunchDescriptionSource([str(launch.folder), "/inner.launch.xml"])
    launch.visit(
        actions.SetLaunchConfiguration("name", "me"),
        actions.IncludeLaunchDescription(source, launch_arguments=[("who", Given("name"))]),
        actions.LogInfo(msg=[Given("who"), Given("end")]),
        actions.IncludeLaunchDescription(
            source, launch_arguments={"who": "you", "end": "?"}.items()
        ),
    )
    assert logged(capsys) == ["me!", "me!", "you?"]


def test_a_group_ends_the_arguments_of_an_included_file(launch: Launch) -> None:
    """Nothing of it is left behind the group."""
    inner = launch.included("inner.launch.xml", '<launch><let name="a" value="1"/></launch>')
    launch.visit(actions.GroupAction([inner]))
    assert launch.context.launch_configurations == {}


def test_an_included_file_without_its_argument_ends_the_launch(launch: Launch) -> None:
    """Before anything of it is carried out."""
    included = launch.included(
        "inner.launch.xml", '<launch><let name="a" value="1"/><arg name="who"/></launch>'
    )
    with pytest.raises(BadLaunchFile, match="'who'"):
        launch.visit(included)
    assert launch.context.launch_configurations == {}


def test_the_surroundings_give_an_included_file_no_argument(launch: Launch, capsys: Out) -> None:
    """What has no default must be handed on; what has one sees the surroundings."""
    (launch.folder / "inner.launch.xml").write_text(f"{INNER}</launch>")
    file = str(launch.folder / "inner.launch.xml")
    around = [
        actions.SetLaunchConfiguration("who", "me"),
        actions.SetLaunchConfiguration("end", "?"),
    ]
    with pytest.raises(BadLaunchFile, match=r"'who' .* must be handed on there: launch_arguments"):
        launch.visit(*around, actions.IncludeLaunchDescription(file))
    handed = {"who": Given("who")}.items()
    launch.visit(*around, actions.IncludeLaunchDescription(file, launch_arguments=handed))
    assert logged(capsys) == ["me?"]


@pytest.mark.parametrize(
    "inner",
    [
        '<group if="false"><arg name="who"/></group>',
        '<arg name="who" if="false"/>',
        '<timer period="0"><arg name="who"/></timer>',
        '<arg name="who" default="a"/><arg name="who"/>',
    ],
)
def test_what_may_never_be_asked_for_is_not_required(launch: Launch, inner: str) -> None:
    """An argument behind a condition, one of later, and one that has a default before."""
    launch.visit(launch.included("inner.launch.xml", f"<launch>{inner}</launch>"))


LANGUAGES = {
    "a.launch.py": (
        "PythonLaunchDescriptionSource",
        "from launch import LaunchDescription\nfrom launch.actions import LogInfo\n"
        "def generate_launch_description():\n    return LaunchDescription([LogInfo(msg='hi')])\n",
    ),
    "a.launch.xml": ("XMLLaunchDescriptionSource", '<launch><log message="hi"/></launch>'),
    "a.launch.yaml": ("YAMLLaunchDescriptionSource", "launch: [{log: {message: hi}}]"),
}


@pytest.mark.parametrize("name", ["a.launch.xml", "a.launch.yaml"])
def test_a_file_of_each_language_is_included(launch: Launch, capsys: Out, name: str) -> None:
    """By its own source, by that of any language, and by its bare path."""
    source, text = LANGUAGES[name]
    file = str(launch.folder / name)
    Path(file).write_text(text)
    module = of(f"launch_{name.rpartition('.')[2]}.launch_description_sources")
    launch.visit(
        actions.IncludeLaunchDescription(getattr(module, source)(file)),
        actions.IncludeLaunchDescription(sources.AnyLaunchDescriptionSource(file)),
        actions.IncludeLaunchDescription(sources.FrontendLaunchDescriptionSource(file)),
        actions.IncludeLaunchDescription(file),
    )
    assert logged(capsys) == ["hi"] * 4


def test_a_timer_waits_and_carries_out(launch: Launch, capsys: Out) -> None:
    """The shorter one first; what is behind it does not wait; the launch ends with the last."""
    late = actions.TimerAction(period=0.02, actions=[actions.LogInfo(msg="late")])
    soon = actions.TimerAction(period=Given("soon"), actions=[actions.LogInfo(msg="soon")])
    code = launch.run(
        actions.SetLaunchConfiguration("soon", "0.001"),
        late,
        soon,
        actions.LogInfo(msg="at once"),
    )
    assert (code, logged(capsys)) == (0, ["at once", "soon", "late"])


def test_a_shutdown_ends_timers_that_do_not_say_otherwise(launch: Launch, capsys: Out) -> None:
    """With cancel_on_shutdown=False a timer goes on; so does none that was cancelled."""
    cancelled = actions.TimerAction(period=0.001, actions=[actions.LogInfo(msg="cancelled")])
    cancelled.cancel()
    code = launch.run(
        cancelled,
        actions.TimerAction(period=60.0, actions=[actions.LogInfo(msg="never")]),
        actions.TimerAction(
            period=0.001, actions=[actions.LogInfo(msg="still")], cancel_on_shutdown=False
        ),
        actions.Shutdown(reason="enough"),
    )
    assert (code, logged(capsys)) == (0, ["still"])


def test_a_timer_keeps_the_configurations_of_its_beginning(launch: Launch, capsys: Out) -> None:
    """Also of a group that has ended by then; what it sets stays inside."""
    word = actions.LogInfo(msg=[Given("a", default="-"), Given("b", default="-")])
    later = [actions.SetLaunchConfiguration("b", "2"), word]
    launch.run(
        actions.GroupAction(
            [
                actions.SetLaunchConfiguration("a", "1"),
                actions.TimerAction(period=0.001, actions=later),
            ]
        ),
        actions.SetLaunchConfiguration("a", "3"),
        actions.TimerAction(period=0.01, actions=[word]),
    )
    assert logged(capsys) == ["12", "3-"]
    assert launch.context.launch_configurations == {"a": "3"}


def test_a_cancelled_timer_is_not_waited_for(launch: Launch, capsys: Out) -> None:
    """Neither one that was cancelled before it began, nor one that another ends."""
    before = actions.TimerAction(period=600.0, actions=[actions.LogInfo(msg="never")])
    before.cancel()
    other = actions.TimerAction(period=600.0, actions=[actions.LogInfo(msg="never")])
    ends = actions.OpaqueFunction(function=lambda context: other.cancel())
    launch.run(before, other, actions.TimerAction(period=0.001, actions=[ends]))
    assert logged(capsys) == []


def complete(target: Any, word: str) -> Any:
    """What says a word when `target` is complete."""
    line = [actions.LogInfo(msg=word)]
    handler = handlers.OnExecutionComplete(target_action=target, on_completion=line)
    return actions.RegisterEventHandler(handler)


def test_any_action_is_complete_at_some_time(launch: Launch, capsys: Out) -> None:
    """A line at once, a timer when it was due, a process when it has ended."""
    line = actions.LogInfo(msg="line")
    timer = actions.TimerAction(period=0.001, actions=[actions.LogInfo(msg="due")])
    process = actions.ExecuteProcess(cmd=["true"])
    launch.run(
        complete(line, "line is complete"),
        complete(timer, "timer is complete"),
        complete(process, "process is complete"),
        timer,
        process,
        line,
    )
    said = logged(capsys)
    assert said[:2] == ["line", "line is complete"]
    assert said.index("due") < said.index("timer is complete")
    assert "process is complete" in said


def test_who_comes_late_hears_of_no_completion(launch: Launch, capsys: Out) -> None:
    """The handler must be there when the action is carried out."""
    process, line = actions.ExecuteProcess(cmd=["true"]), actions.LogInfo(msg="line")
    launch.run(process, line, complete(process, "late"), complete(line, "late"))
    assert logged(capsys) == ["line"]


@pytest.mark.parametrize(
    "ends",
    [actions.EmitEvent(event=events.Shutdown(reason="enough")), actions.Shutdown(reason="enough")],
)
def test_a_shutdown_has_a_reason(launch: Launch, capsys: Out, ends: Any) -> None:
    """By action and by event; handlers read it from the event or by a substitution."""
    seen: list[Any] = []

    def note(event: Any, context: Any) -> list[Any]:
        seen.append(event.reason)
        return [actions.LogInfo(msg=subs.LocalSubstitution("event.reason"))]

    code = launch.run(actions.RegisterEventHandler(handlers.OnShutdown(on_shutdown=note)), ends)
    assert (code, seen, logged(capsys)) == (0, ["enough"], ["enough"])
    assert events.Shutdown().reason == "reason not given"
    assert events.Shutdown().due_to_sigint is False


def test_a_reason_is_handed_on_as_it_is(launch: Launch) -> None:
    """Also a substitution, which nobody fills in."""
    seen: list[Any] = []
    handler = handlers.OnShutdown(on_shutdown=lambda event, context: seen.append(event.reason))
    reason = Given("x")
    launch.run(actions.RegisterEventHandler(handler), actions.Shutdown(reason=reason))
    assert seen == [reason]


def test_a_launch_with_nothing_left_to_do_is_over(launch: Launch, capsys: Out) -> None:
    """It shuts down by itself, and says that it is idle."""
    idle = subs.LocalSubstitution("event.reason")
    handler = handlers.OnShutdown(on_shutdown=[actions.LogInfo(msg=idle)])
    assert launch.run(actions.RegisterEventHandler(handler)) == 0
    assert logged(capsys) == ["idle"]


def test_a_node_is_not_started_during_a_shutdown(launch: Launch) -> None:
    """Who asks for it then gets nothing."""
    handler = handlers.OnShutdown(on_shutdown=lambda event, context: [teller()])
    assert launch.run(actions.RegisterEventHandler(handler)) == 0
    assert list(launch.context.planned) == []


def test_handlers_answer_events_that_they_match(launch: Launch, capsys: Out) -> None:
    """The newest first; one that answers once, and one that was taken away, answer no more."""

    class Mine(base.Event):  # type: ignore[misc]  # base is made while the test runs
        name = "mine.Mine"

    def handler(word: str, **more: Any) -> Any:
        return base.EventHandler(
            matcher=lambda event: isinstance(event, Mine),
            entities=[actions.LogInfo(msg=word)],
            **more,
        )

    gone = handler("gone")
    code = launch.run(
        actions.RegisterEventHandler(handler("old")),
        actions.RegisterEventHandler(handler("once", handle_once=True)),
        actions.RegisterEventHandler(gone),
        actions.UnregisterEventHandler(gone),
        actions.EmitEvent(event=Mine()),
        actions.EmitEvent(event=Mine()),
    )
    assert (code, logged(capsys)) == (0, ["once", "old", "old"])


def test_a_handler_is_for_a_process(launch: Launch) -> None:
    """For one that is started, for those that a function takes, or for all."""
    for target in (teller(), lambda action: True, None):
        handlers.OnProcessExit(target_action=target, on_exit=[])
        handlers.OnProcessStart(target_action=target, on_start=[])
    with pytest.raises(TypeError):
        handlers.OnProcessExit(target_action="teller", on_exit=[])
    with pytest.raises(TypeError):
        handlers.OnExecutionComplete(target_action="teller", on_completion=[])
    assert issubclass(process_events.ProcessExited, base.Event)


def test_an_empty_list_for_an_action_ends_the_launch(launch: Launch) -> None:
    """When the event is there; None, and an empty list for a shutdown, are right."""
    for process, code in (
        (actions.ExecuteProcess(cmd=["true"], on_exit=[]), 1),
        (actions.ExecuteProcess(cmd=["true"], on_exit=None), 0),
    ):
        fresh = launch.again()
        assert fresh.run(process) == code
    shutdown = handlers.OnShutdown(on_shutdown=[])
    assert launch.run(actions.RegisterEventHandler(shutdown)) == 0


def test_what_is_wrong_in_a_handler_ends_the_launch_with_one(launch: Launch) -> None:
    """Exit 1; Jazzy, too, counts an exception in what is done later."""

    def fails(event: Any, context: Any) -> None:
        raise RuntimeError("no")

    handler = handlers.OnShutdown(on_shutdown=fails)
    assert launch.run(actions.RegisterEventHandler(handler)) == 1


def test_an_action_of_ones_own(launch: Launch, capsys: Out) -> None:
    """A class of the launch file with `execute`, and a substitution with `perform`."""

    class Twice(base.Action):  # type: ignore[misc]  # base is made while the test runs
        def __init__(self, line: Any, **more: Any) -> None:
            super().__init__(**more)
            self.line = line

        def execute(self, context: Any) -> list[Any]:
            return [self.line, self.line]

    class Loud(base.Substitution):  # type: ignore[misc]
        def perform(self, context: Any) -> str:
            return str(context.launch_configurations["word"]).upper()

    launch.visit(
        actions.SetLaunchConfiguration("word", "hi"),
        Twice(actions.LogInfo(msg=Loud())),
        Twice(actions.LogInfo(msg="no"), condition=conditions.IfCondition("false")),
    )
    assert logged(capsys) == ["HI", "HI"]


@pytest.mark.parametrize("name", ["a.launch.xml", "a.launch.yaml"])
def test_unknown_words_of_xml_and_yaml_end_the_launch(launch: Launch, name: str) -> None:
    """A tag and an attribute that nobody knows, and `if` beside `unless`."""
    for line in (
        {"logg": {"message": "a"}},
        {"log": {"message": "a", "colour": "red"}},
        {"log": {"message": "a", "if": "true", "unless": "true"}},
        {"log": {"message": "a", "level": "INFO"}},
        {"arg": {"name": "a", "value": "b"}},
        {"set_parameter": {"name": "a", "value": "b", "type": "str"}},
        {"executable": {"cmd": "true", "launch_prefix": "env"}},
        {"set-env": {"name": "a", "value": "b"}},
    ):
        ((tag, attributes),) = line.items()
        words = " ".join(f'{key}="{value}"' for key, value in attributes.items())
        pairs = ", ".join(f"{key}: '{value}'" for key, value in attributes.items())
        xml, yaml = f"<launch><{tag} {words}/></launch>", f"launch: [{{{tag}: {{{pairs}}}}}]"
        included = launch.included(name, xml if name.endswith("xml") else yaml)
        with pytest.raises(BadLaunchFile):
            launch.visit(included)


ARGUMENT = '<launch><arg name="who" default="nobody"/><log message="$(var who)"/></launch>'


def typed(launch: Launch, *words: str) -> Ran:
    """`ros2 launch FILE words...` of a file with one argument."""
    (launch.folder / "a.launch.xml").write_text(ARGUMENT)
    return run(
        Shell(dict(os.environ), launch.folder),
        "launch",
        str(launch.folder / "a.launch.xml"),
        *words,
    )


def test_arguments_are_typed_as_name_and_value(launch: Launch) -> None:
    """The last one wins; a value may hold the sign of assignment."""
    for words, said in (((), "nobody"), (("who:=a", "who:=b"), "b"), (("who:=a:=b",), "a:=b")):
        ran = typed(launch, *words)
        assert (ran.code, ran.lines[-1]) == (0, f"[INFO] [launch.user]: {said}")


@pytest.mark.parametrize("word", ["who=me", "who", ":=me", "who:="])
def test_what_is_typed_otherwise_is_refused(launch: Launch, word: str) -> None:
    """With the words of Jazzy, and exit 1."""
    ran = typed(launch, word)
    assert ran.code == 1
    assert f"malformed launch argument '{word}', expected format '<name>:=<value>'" in ran.err


def test_a_file_is_printed_or_its_arguments_are_shown(launch: Launch) -> None:
    """Not both."""
    ran = typed(launch, "--print", "--show-args")
    assert (ran.code, "not allowed with argument" in ran.err) == (2, True)
    assert typed(launch, "--print").code == typed(launch, "--show-args").code == 0


def test_two_launch_files_of_one_name_are_refused(launch: Launch) -> None:
    """By the package; the path of one is taken."""
    share = launch.folder / "share" / "mine"
    for folder in ("launch", "more"):
        (share / folder).mkdir(parents=True)
        (share / folder / "a.launch.xml").write_text(f'<launch><log message="{folder}"/></launch>')
    shell = Shell(dict(os.environ), launch.folder)
    ran = run(shell, "launch", "mine", "a.launch.xml")
    assert (ran.code, "was found more than once" in ran.err) == (1, True)
    ran = run(shell, "launch", str(share / "more" / "a.launch.xml"))
    assert (ran.code, ran.lines[-1]) == (0, "[INFO] [launch.user]: more")


OF_YAML = {
    "arg: {name: a, default: 5}": "'default' of 'arg' must be a text",
    "let: {name: a, value: true}": "'value' of 'let' must be a text",
    "log: {message: hi, if: true}": "'if' of 'log' must be a text",
    "timer: {period: 5, children: []}": "Write it with a point: 5.0",
    "node: {exec: a, respawn: true}": "'respawn' of 'node' must be a text",
    "node: {exec: a, respawn_delay: 2}": "Write it with a point: 2.0",
    "node: {exec: a, args: 5}": "'args' of 'node' must be a text",
    "set_parameter: {name: a, value: 2.5}": "'value' of 'set_parameter' must be a text",
}


@pytest.mark.parametrize("line", OF_YAML)
def test_yaml_makes_no_text_of_a_number(launch: Launch, line: str) -> None:
    """Between quotes it is one."""
    with pytest.raises(BadLaunchFile, match=OF_YAML[line]):
        launch.visit(launch.included("a.launch.yaml", f"launch:\n- {line}\n"))


@pytest.mark.parametrize("name", ["a.launch.xml", "a.launch.yaml"])
def test_a_file_may_be_deprecated(launch: Launch, capsys: Out, name: str) -> None:
    """It says so with its path, and is carried out."""
    xml = '<launch deprecated="use b"><push-ros-namespace namespace="c"/></launch>'
    yaml = "launch: {deprecated: use b, children: [{push-ros-namespace: {namespace: c}}]}"
    launch.visit(launch.included(name, xml if name.endswith("xml") else yaml))
    said = f"[WARNING] [root]: launch file [{launch.folder / name}] is deprecated: use b"
    assert said in capsys.readouterr().out
    assert launch.context.launch_configurations == {"ros_namespace": "/c"}


def test_yaml_takes_numbers_and_texts_where_they_belong(launch: Launch, capsys: Out) -> None:
    """A number with a point for a time, and a text for anything."""
    text = "launch:\n- timer: {period: 0.001, children: [{log: {message: late}}]}\n"
    text += '- arg: {name: a, default: "5"}\n- log: {message: $(var a), if: "true"}\n'
    launch.run(launch.included("a.launch.yaml", text))
    assert logged(capsys) == ["5", "late"]
