"""What a launch file may lean on in arguments, substitutions and conditions."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from launched import Launch, actions, base, conditions, described, of, ros, ros_subs, subs

from ros2_on_pip.launching.places import BadLaunchFile

Given = subs.LaunchConfiguration


def test_an_argument_has_its_default_where_nobody_gave_a_value(launch: Launch) -> None:
    """A default may be made of substitutions, and of earlier arguments."""
    launch.context.launch_configurations["given"] = "typed"
    launch.visit(
        actions.DeclareLaunchArgument("given", default_value="default"),
        actions.DeclareLaunchArgument("free", default_value="default"),
        actions.DeclareLaunchArgument("made", default_value=[Given("free"), "/x"]),
    )
    assert launch.context.launch_configurations == {
        "given": "typed",
        "free": "default",
        "made": "default/x",
    }


def test_an_argument_without_value_and_default_ends_the_launch(launch: Launch) -> None:
    """The fault names it, and what it is for."""
    with pytest.raises(BadLaunchFile, match=r"'who' \(description: 'a name'\) was not provided"):
        launch.visit(actions.DeclareLaunchArgument("who", description="a name"))


@pytest.mark.parametrize("value", ["left", "up"])
def test_an_argument_takes_its_choices_alone(launch: Launch, value: str) -> None:
    """By letters: no other text counts as one of them."""
    launch.context.launch_configurations["side"] = value
    argument = actions.DeclareLaunchArgument("side", choices=["left", "right"])
    if value == "left":
        launch.visit(argument)
        return
    with pytest.raises(BadLaunchFile, match=r'"up" is not valid\. Valid options are: '):
        launch.visit(argument)


def test_a_configuration_is_set_and_taken_away(launch: Launch) -> None:
    """Names and values may be substitutions; one that is not there is no fault."""
    launch.visit(
        actions.SetLaunchConfiguration("kind", "color"),
        actions.SetLaunchConfiguration([Given("kind"), "_of"], [Given("kind"), "!"]),
        actions.UnsetLaunchConfiguration("kind"),
        actions.UnsetLaunchConfiguration("never"),
    )
    assert launch.context.launch_configurations == {"color_of": "color!"}


def test_a_configuration_is_read(launch: Launch) -> None:
    """Its default may be a number or a truth; without one it is a SubstitutionFailure."""
    launch.context.launch_configurations["speed"] = "2"
    assert launch.filled(Given("speed")) == "2"
    assert launch.filled(Given(["spe", "ed"])) == "2"
    assert launch.filled(Given("gone", default="x")) == "x"
    assert launch.filled(Given("gone", default=5)) == "5"
    assert launch.filled(Given("gone", default=True)) == "True"
    with pytest.raises(subs.SubstitutionFailure, match="'gone' does not exist"):
        launch.filled(Given("gone"))


def test_a_substitution_is_performed_by_hand(launch: Launch) -> None:
    """As an OpaqueFunction does it, by itself or by the context."""
    launch.context.launch_configurations["speed"] = "2"
    assert Given("speed").perform(launch.context) == "2"
    assert launch.context.perform_substitution(Given("speed")) == "2"
    tools = of("launch.utilities")
    parts = tools.normalize_to_list_of_substitutions(["at ", Given("speed"), Path("/x")])
    assert all(isinstance(one, base.Substitution) for one in parts)
    assert tools.perform_substitutions(launch.context, parts) == "at 2/x"


def test_a_text_is_a_substitution(launch: Launch) -> None:
    """A number is none: TextSubstitution(text=2) is a TypeError."""
    assert launch.filled(subs.TextSubstitution(text="2")) == "2"
    with pytest.raises(TypeError):
        subs.TextSubstitution(text=2)


def test_parts_of_a_path_are_joined(launch: Launch) -> None:
    """An absolute part begins anew, as in os.path.join."""
    launch.context.launch_configurations["file"] = "a.yaml"
    assert launch.filled(subs.PathJoinSubstitution(["/x", "config", Given("file")])) == (
        "/x/config/a.yaml"
    )
    assert launch.filled(subs.PathJoinSubstitution(["/x", "/y", Given("file")])) == "/y/a.yaml"


def test_an_empty_part_leaves_a_slash_at_the_end(launch: Launch) -> None:
    """As in os.path.join; a slash that was there stays."""
    assert launch.filled(subs.PathJoinSubstitution(["/x", ""])) == "/x/"
    assert launch.filled(subs.PathJoinSubstitution(["/x", "y/"])) == "/x/y/"


def test_a_slash_joins_paths(launch: Launch) -> None:
    """Behind either substitution of a path; one part may be made of several texts."""
    launch.context.launch_configurations["file"] = "a"
    config = subs.PathSubstitution("/x") / "config"
    assert launch.filled(config / [Given("file"), ".yaml"]) == "/x/config/a.yaml"
    assert launch.filled(subs.PathJoinSubstitution(["/x"]) / config) == "/x/config"
    share = ros_subs.FindPackageShare("mine") / "config" / "a.yaml"
    assert launch.filled(share) == f"{launch.folder}/share/mine/config/a.yaml"


def test_packages_are_found(launch: Launch) -> None:
    """Their prefix, their share folder, their executables; none of a package that is not there."""
    prefix = str(launch.folder)
    assert launch.filled(ros_subs.FindPackagePrefix("mine")) == prefix
    assert launch.filled(ros_subs.FindPackageShare("mine")) == f"{prefix}/share/mine"
    assert launch.filled(ros_subs.ExecutableInPackage("teller", "mine")) == (
        f"{prefix}/lib/mine/teller"
    )
    assert ros_subs.FindPackageShare("mine").find("mine") == f"{prefix}/share/mine"
    for missing in (
        ros_subs.FindPackageShare("none_such"),
        ros_subs.FindPackagePrefix("none_such"),
        ros_subs.ExecutableInPackage("none_such", "mine"),
    ):
        with pytest.raises(Exception, match="none_such"):
            launch.filled(missing)


def test_a_variable_of_the_environment_is_read(launch: Launch) -> None:
    """It is that of the launch; without a default it is a SubstitutionFailure."""
    launch.visit(actions.SetEnvironmentVariable("MOOD", "calm"))
    assert launch.filled(subs.EnvironmentVariable("MOOD")) == "calm"
    assert launch.filled(subs.EnvironmentVariable("NO_MOOD", default_value="none")) == "none"
    assert launch.filled(subs.EnvironmentVariable("NO_MOOD", default_value="")) == ""
    with pytest.raises(subs.SubstitutionFailure, match="NO_MOOD"):
        launch.filled(subs.EnvironmentVariable("NO_MOOD"))


def test_a_default_is_filled_in_also_where_it_is_not_needed(launch: Launch) -> None:
    """So what it is made of must be there."""
    launch.visit(actions.SetEnvironmentVariable("MOOD", "calm"))
    with pytest.raises(subs.SubstitutionFailure, match="'gone' does not exist"):
        launch.filled(subs.EnvironmentVariable("MOOD", default_value=Given("gone")))


EXPRESSIONS = {
    ("1 + 1",): "2",
    ("'", Given("side"), "' == 'left'"): "True",
    ("sqrt(16)",): "4.0",
    ("math.floor(pi)",): "3",
    ("[1, 2][0]",): "1",
}


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_python_makes_a_text_of_an_expression(launch: Launch, expression: tuple[Any, ...]) -> None:
    """With `math`, by its own name and without it."""
    launch.context.launch_configurations["side"] = "left"
    assert launch.filled(subs.PythonExpression(list(expression))) == EXPRESSIONS[expression]


def test_an_expression_sees_the_modules_that_are_named(launch: Launch) -> None:
    """And `math` no more, unless it is named too."""
    of_os = subs.PythonExpression("os.path.basename('/a/b')", python_modules=["os"])
    assert launch.filled(of_os) == "b"
    with pytest.raises(subs.SubstitutionFailure):
        launch.filled(subs.PythonExpression("sqrt(16)", python_modules=["os"]))


def test_one_module_may_be_a_text(launch: Launch) -> None:
    """Or a substitution; one that is not there is a failure."""
    launch.context.launch_configurations["module"] = "os"
    for modules in ("os", Given("module"), [Given("module")]):
        of_os = subs.PythonExpression("os.path.basename('/a/b')", python_modules=modules)
        assert launch.filled(of_os) == "b"
    with pytest.raises(subs.SubstitutionFailure, match="no_such_module"):
        launch.filled(subs.PythonExpression("1", python_modules="no_such_module"))


def test_a_command_gives_what_it_prints(launch: Launch) -> None:
    """All of it, with the end of the line."""
    launch.context.launch_configurations["word"] = "two words"
    told = f"{sys.executable} -c 'print(1); print(2)'"
    assert launch.filled(subs.Command(told)) == "1\n2\n"
    assert launch.filled(subs.Command(["echo '", Given("word"), "'"])) == "two words\n"


def test_a_command_that_fails_is_a_failure(launch: Launch) -> None:
    """So is one that is not there, and one that writes to standard error, unless that is wanted."""
    warns = f"{sys.executable} -c 'import sys; print(1); sys.stderr.write(\"oh\")'"
    for text in ("false", "no_such_command", warns):
        with pytest.raises(subs.SubstitutionFailure):
            launch.filled(subs.Command(text))
    assert launch.filled(subs.Command(warns, on_stderr="ignore")) == "1\n"
    assert launch.filled(subs.Command(warns, on_stderr="warn")) == "1\n"
    assert "oh" in launch.filled(subs.Command(warns, on_stderr="capture"))


def test_what_is_captured_comes_in_the_order_in_which_it_was_written(launch: Launch) -> None:
    """Both streams are one."""
    words = "sh -c 'echo one; echo two >&2; echo three'"
    assert launch.filled(subs.Command(words, on_stderr="capture")) == "one\ntwo\nthree\n"


def test_on_stderr_is_one_of_four_words(launch: Launch) -> None:
    """Any other is a failure, also where nothing is written there."""
    with pytest.raises(subs.SubstitutionFailure, match="on_stderr is one of fail"):
        launch.filled(subs.Command("true", on_stderr="ignored"))


def test_an_executable_is_found_on_the_path(launch: Launch) -> None:
    """Else it is a SubstitutionFailure."""
    assert launch.filled(subs.FindExecutable(name="sh")).endswith("/sh")
    with pytest.raises(subs.SubstitutionFailure, match="no_such_command"):
        launch.filled(subs.FindExecutable(name="no_such_command"))


def test_a_file_is_read(launch: Launch) -> None:
    """As text; one that is not there is a SubstitutionFailure."""
    (launch.folder / "note.txt").write_text("a note\n")
    assert launch.filled(subs.FileContent(str(launch.folder / "note.txt"))) == "a note\n"
    with pytest.raises(subs.SubstitutionFailure):
        launch.filled(subs.FileContent(str(launch.folder / "none.txt")))


def test_the_file_of_the_launch_is_known_while_it_is_read(launch: Launch) -> None:
    """Its path and its folder; outside of a file it is a SubstitutionFailure."""
    launch.visit(
        launch.included(
            "a.launch.xml",
            '<launch><let name="file" value="$(filename)"/><let name="folder" value="$(dirname)"/>'
            "</launch>",
        )
    )
    known = launch.context.launch_configurations
    assert known == {"file": str(launch.folder / "a.launch.xml"), "folder": str(launch.folder)}
    for one in (subs.ThisLaunchFile(), subs.ThisLaunchFileDir()):
        with pytest.raises(subs.SubstitutionFailure):
            launch.filled(one)


def test_the_folder_of_the_log_is_known(launch: Launch) -> None:
    """It lies below ROS_LOG_DIR."""
    assert Path(launch.filled(subs.LaunchLogDir())).parent == launch.folder / "log"


def test_an_anonymous_name_is_one_name(launch: Launch) -> None:
    """The same in a launch for the same word; it begins with the word, and is a node's name."""
    first = launch.filled(subs.AnonName("ear"))
    assert launch.filled(subs.AnonName("ear")) == first
    assert launch.filled(subs.AnonName("eye")) != first
    assert first.startswith("ear_") and first.isidentifier()


TRUTHS = {
    "true": subs.EqualsSubstitution("a", "a"),
    "false": subs.EqualsSubstitution("a", "b"),
    "True is 1": subs.EqualsSubstitution("True", "1"),
    "0 is false": subs.EqualsSubstitution("0", "false"),
    "1.0 is 1": subs.EqualsSubstitution("1.0", "1"),
    "2.50 is 2.5": subs.EqualsSubstitution("2.50", "2.5"),
    "2 is not 1": subs.NotEqualsSubstitution("2", "1"),
    "not false": subs.NotSubstitution("false"),
    "both": subs.AndSubstitution("true", "True"),
    "one of both": subs.OrSubstitution("false", "1"),
}


@pytest.mark.parametrize("case", TRUTHS)
def test_what_is_equal_and_what_is_true(launch: Launch, case: str) -> None:
    """Truths and numbers are compared by what they mean; the answer is `true` or `false`."""
    assert launch.filled(TRUTHS[case]) == ("false" if case == "false" else "true")


VALUES_COMPARED: dict[str, tuple[Any, Any, str]] = {
    "truth and text": (True, "TRUE", "true"),
    "truth and number": (False, 0, "true"),
    "numbers": (5, 5.0, "true"),
    "number and text": (2.5, "2.50", "true"),
    "nothing and empty": (None, "", "true"),
    "nothing and its name": (None, "None", "false"),
    "no number is itself": ("nan", "nan", "false"),
    "truth with blanks": (" true ", "1", "false"),
    "a list of texts is no text": (["a", "b"], "ab", "false"),
    "a list with a substitution is": (["a", Given("x")], "ab", "true"),
}


@pytest.mark.parametrize("case", VALUES_COMPARED)
def test_any_values_are_compared(launch: Launch, case: str) -> None:
    """By what they are as texts."""
    launch.context.launch_configurations["x"] = "b"
    left, right, wanted = VALUES_COMPARED[case]
    assert launch.filled(subs.EqualsSubstitution(left, right)) == wanted
    other = "false" if wanted == "true" else "true"
    assert launch.filled(subs.NotEqualsSubstitution(left, right)) == other


@pytest.mark.parametrize(
    ("word", "is_true"),
    [("on", True), ("yes", True), ("True", True), ("1", True), ("off", False), ("No", False)],
)
def test_outside_of_conditions_yaml_says_what_is_true(
    launch: Launch, word: str, is_true: bool
) -> None:
    """In and, or, not and if, and where a process shall come back."""
    truth = str(is_true).lower()
    assert launch.filled(subs.AndSubstitution(word, "on")) == truth
    assert launch.filled(subs.OrSubstitution("off", word)) == truth
    assert launch.filled(subs.NotSubstitution(word)) == str(not is_true).lower()
    assert launch.filled(subs.IfElseSubstitution(word, "true", "false")) == truth
    process = actions.ExecuteProcess(cmd=["true"], respawn=subs.TextSubstitution(text=word))
    assert launch.plan(process).respawn.wanted is is_true


@pytest.mark.parametrize("word", ["", " 1 ", "tRue", "2", "y", "[true]"])
def test_what_yaml_takes_for_no_truth_is_none(launch: Launch, word: str) -> None:
    """It is a SubstitutionFailure."""
    with pytest.raises(subs.SubstitutionFailure, match="true or false"):
        launch.filled(subs.NotSubstitution(word))


def test_a_context_is_made_by_hand() -> None:
    """As a test of a launch file makes it: empty, and ready to fill substitutions in."""
    context = base.LaunchContext(argv=["a:=b"], noninteractive=True)
    assert (context.argv, context.noninteractive) == (["a:=b"], True)
    assert base.LaunchContext().argv == []
    context.launch_configurations["x"] = "1"
    assert Given("x").perform(context) == "1"
    assert base.LaunchContext().launch_configurations == {}


def test_and_or_not_take_no_other_word(launch: Launch) -> None:
    """Each is a SubstitutionFailure."""
    for one in (
        subs.NotSubstitution("maybe"),
        subs.AndSubstitution("true", "maybe"),
        subs.OrSubstitution("maybe", "false"),
        subs.IfElseSubstitution("maybe", "a", "b"),
    ):
        with pytest.raises(subs.SubstitutionFailure):
            launch.filled(one)


def test_one_of_two_texts(launch: Launch) -> None:
    """The other one is not even looked at; where it is left out, it is empty."""
    gone = Given("gone")
    assert launch.filled(subs.IfElseSubstitution("true", "yes", gone)) == "yes"
    assert launch.filled(subs.IfElseSubstitution("false", gone, "no")) == "no"
    assert launch.filled(subs.IfElseSubstitution("false", if_value="yes")) == ""


WORDS = {"true": True, "True": True, " 1 ": True, "FALSE": False, "0": False}


@pytest.mark.parametrize("word", WORDS)
def test_a_condition_takes_four_words(launch: Launch, word: str) -> None:
    """true, 1, false and 0, in capitals or not, with blanks around them or not."""
    assert conditions.IfCondition(word).evaluate(launch.context) is WORDS[word]
    assert conditions.UnlessCondition(word).evaluate(launch.context) is not WORDS[word]


@pytest.mark.parametrize("word", ["yes", "on", "", "2", "maybe"])
def test_a_condition_takes_no_other_word(launch: Launch, word: str) -> None:
    """The launch ends, and nothing behind it is carried out."""
    unsure = actions.SetLaunchConfiguration("a", "b", condition=conditions.IfCondition(word))
    with pytest.raises(BadLaunchFile, match="a condition is true or false"):
        launch.visit(unsure, actions.SetLaunchConfiguration("c", "d"))
    assert launch.context.launch_configurations == {}


def test_a_condition_holds_an_action_back(launch: Launch) -> None:
    """It is asked when the action is reached, with what was set before."""
    launch.visit(
        actions.SetLaunchConfiguration("on", "true"),
        actions.SetLaunchConfiguration("a", "1", condition=conditions.IfCondition(Given("on"))),
        actions.SetLaunchConfiguration("b", "1", condition=conditions.UnlessCondition(Given("on"))),
    )
    assert launch.context.launch_configurations == {"on": "true", "a": "1"}


def test_a_condition_compares_a_configuration(launch: Launch) -> None:
    """With a text, letter by letter; with None it holds where the configuration is not set."""
    launch.context.launch_configurations["side"] = "left"
    for name, value, equal in (
        ("side", "left", True),
        ("side", ["le", "ft"], True),
        ("side", "Left", False),
        ("side", None, False),
        ("gone", None, True),
        ("gone", "left", False),
    ):
        same = conditions.LaunchConfigurationEquals(name, value)
        other = conditions.LaunchConfigurationNotEquals(name, value)
        assert same.evaluate(launch.context) is equal
        assert other.evaluate(launch.context) is not equal


VALUES: dict[str, tuple[Any, Any]] = {
    "a list in a list is one text": ([[Given("side"), "_wheel"], ["b"]], ["left_wheel", "b"]),
    "a substitution beside numbers": ([Given("rate"), 5], [4, 5]),
    "text stays text": ("7", "7"),
    "number": (2.5, 2.5),
    "truth": (True, True),
    "substitution is read as YAML": (Given("rate"), 4),
    "texts and substitutions are one text": ([Given("side"), "_wheel"], "left_wheel"),
    "substitution as text": (described.ParameterValue(Given("rate"), value_type=str), "4"),
    "substitution as number": (described.ParameterValue(Given("rate"), value_type=float), 4.0),
    "whole numbers beside others": ([1, 2.5], [1.0, 2.5]),
    "list of texts": (["a", "b"], ["a", "b"]),
}


@pytest.mark.parametrize("case", VALUES)
def test_what_becomes_of_a_value_in_a_dictionary(launch: Launch, case: str) -> None:
    """It goes into a file that the node reads, below its full name or for every node."""
    launch.context.launch_configurations |= {"rate": "4", "side": "left"}
    given, wanted = VALUES[case]
    planned = launch.plan(ros.Node(package="mine", executable="teller", parameters=[{"p": given}]))
    found = parameters_in(planned.command)
    assert found == {"/**": {"ros__parameters": {"p": wanted}}}
    assert type(found["/**"]["ros__parameters"]["p"]) is type(wanted)


def parameters_in(command: list[str]) -> Any:
    """What stands in the parameter file that a command names."""
    import yaml

    return yaml.safe_load(Path(command[command.index("--params-file") + 1]).read_text("utf-8"))


@pytest.mark.parametrize("value", [[], [1, "a"], None, {"a": []}])
def test_what_is_no_value_of_a_parameter(launch: Launch, value: Any) -> None:
    """An empty list, a list of several kinds, None."""
    node = ros.Node(package="mine", executable="teller", parameters=[{"p": value}])
    with pytest.raises(BadLaunchFile, match="parameter 'p"):
        launch.visit(node)


@pytest.mark.parametrize(
    ("text", "kind"), [("4.5", int), ("four", float), ("maybe", bool), ("[1]", int)]
)
def test_a_substitution_must_be_of_the_type_that_is_said(
    launch: Launch, text: str, kind: type[Any]
) -> None:
    """A number with a point is no whole number."""
    given = described.ParameterValue(Given("x"), value_type=kind)
    launch.context.launch_configurations["x"] = text
    with pytest.raises(BadLaunchFile, match="parameter 'p"):
        launch.visit(ros.Node(package="mine", executable="teller", parameters=[{"p": given}]))


@pytest.mark.parametrize(
    ("value", "kind"), [(5, str), (5, float), ("5", int), ("true", bool), (5, dict)]
)
def test_a_value_that_is_known_is_not_made_another(value: Any, kind: type[Any]) -> None:
    """Only what a substitution gives is read as a type."""
    described.ParameterValue(Given("x"), value_type=str)
    with pytest.raises((TypeError, ValueError)):
        described.ParameterValue(value, value_type=kind)


def test_names_inside_names_are_joined_by_dots(launch: Launch) -> None:
    """And a name may be a substitution."""
    tree = {"pid": {"p": 1.0, "limit": {"high": 2}}, (Given("side"), "_on"): True}
    launch.context.launch_configurations["side"] = "left"
    node = ros.Node(package="mine", executable="teller", name="a", namespace="b", parameters=[tree])
    assert parameters_in(launch.plan(node).command) == {
        "/b/a": {"ros__parameters": {"pid.p": 1.0, "pid.limit.high": 2, "left_on": True}}
    }


def test_files_and_dictionaries_come_in_order(launch: Launch) -> None:
    """A text, a path and a substitution each name a file; the last word wins in the node."""
    for name in ("a", "b", "c"):
        (launch.folder / f"{name}.yaml").write_text(f"/**: {{ros__parameters: {{{name}: 1}}}}\n")
    launch.context.launch_configurations["file"] = str(launch.folder / "c.yaml")
    node = ros.Node(
        package="mine",
        executable="teller",
        parameters=[
            str(launch.folder / "a.yaml"),
            {"p": 1},
            launch.folder / "b.yaml",
            Given("file"),
            described.Parameter("q", 2),
        ],
    )
    command = launch.plan(node).command
    first = command.index("--ros-args") + 1
    told = list(zip(command[first::2], command[first + 1 :: 2], strict=True))
    assert [Path(word).name for option, word in told if option == "--params-file"][::2] == [
        "a.yaml",
        "b.yaml",
    ]
    assert told[-2:] == [("--params-file", str(launch.folder / "c.yaml")), ("-p", "q:=2")]


def test_substitutions_in_a_parameter_file(launch: Launch) -> None:
    """They are filled in where allow_substs says so, and are letters elsewhere."""
    file = launch.folder / "a.yaml"
    file.write_text("/**: {ros__parameters: {side: $(var side)}}\n")
    launch.context.launch_configurations["side"] = "left"
    for allow, wanted in ((True, "left"), (False, "$(var side)")):
        given = described.ParameterFile(str(file), allow_substs=allow)
        node = ros.Node(package="mine", executable="teller", parameters=[given])
        found = parameters_in(launch.plan(node).command)
        assert found["/**"]["ros__parameters"]["side"] == wanted
