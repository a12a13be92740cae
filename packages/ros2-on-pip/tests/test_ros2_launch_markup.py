"""XML and YAML launch files, element by element: what is read, what is refused, and where."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from terminal import HERE

from ros2_on_pip.launching.context import Around, LaunchContext
from ros2_on_pip.launching.markup.building import TAGS
from ros2_on_pip.launching.parameters import value_of
from ros2_on_pip.launching.places import BadLaunchFile
from ros2_on_pip.launching.reading import description_in
from ros2_on_pip.launching.screen import LaunchOutput

SAMPLES = {
    "append_env": '<append_env name="A" value="b" prepend="true" separator=":"/>',
    "arg": '<arg name="a" default="b" description="c"><choice value="b"/></arg>',
    "executable": '<executable cmd="echo a" name="b" cwd="/" output="screen" launch-prefix="env"'
    ' respawn="false"><env name="A" value="b"/></executable>',
    "group": '<group scoped="true" forwarding="false"><keep name="a" value="b"/></group>',
    "include": '<include file="$(dirname)/inner.launch.xml"><arg name="who" value="b"/></include>',
    "let": '<let name="a" value="b"/>',
    "log": '<log message="a"/>',
    "node": '<node pkg="demo_nodes_py" exec="talker" name="a" namespace="b" args="c"'
    ' ros_args="d"><param name="e" value="f"/><param name="g"><param name="h" value="i"/></param>'
    '<remap from="j" to="k"/><env name="L" value="m"/></node>',
    "push-ros-namespace": '<push-ros-namespace namespace="a"/>',
    "push_ros_namespace": '<push_ros_namespace namespace="a"/>',
    "set_env": '<set_env name="A" value="b"/>',
    "set_parameter": '<set_parameter name="a" value="b"/>',
    "set_parameters_from_file": '<set_parameters_from_file filename="numbers.yaml"/>',
    "set_remap": '<set_remap from="a" to="b"/>',
    "set_use_sim_time": '<set_use_sim_time value="true"/>',
    "shutdown": '<shutdown reason="a"/>',
    "timer": '<timer period="1"/>',
    "unset": '<unset name="a"/>',
    "unset_env": '<unset_env name="A"/>',
}
"""An element of each kind, with all that it takes."""
LINE = 2


@pytest.fixture
def context(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[LaunchContext]:
    """A launch of this process, in which nothing is started."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    monkeypatch.chdir(HERE / "launch_files")
    (tmp_path / "inner.launch.xml").write_text("<launch/>")
    with LaunchOutput() as screen:
        yield LaunchContext(around=Around(screen, tmp_path, description_in))


def carried_out(context: LaunchContext, folder: Path, inner: str, kind: str = "xml") -> None:
    """Carry out a launch file with these lines in it. Raises BadLaunchFile."""
    frame = "<launch>\n{}\n</launch>\n" if kind == "xml" else "launch:\n{}\n"
    file = folder / f"a.launch.{kind}"
    file.write_text(frame.format(inner))
    with context.reading(file):
        context.visit(description_in(file, ""))


def test_there_is_a_sample_of_each_element() -> None:
    """None is left out."""
    assert set(SAMPLES) == set(TAGS)


@pytest.mark.parametrize("tag", TAGS)
def test_each_element_is_read(context: LaunchContext, tmp_path: Path, tag: str) -> None:
    """With every attribute and part."""
    carried_out(context, tmp_path, SAMPLES[tag])


@pytest.mark.parametrize("tag", TAGS)
def test_a_fault_in_any_attribute_names_the_line_of_the_file(
    context: LaunchContext, tmp_path: Path, tag: str
) -> None:
    """Never a file of ours, also in an element inside the element."""
    places = list(re.finditer(r'"[^"]*"', SAMPLES[tag]))
    told = []
    for place in places:
        wrong = SAMPLES[tag][: place.start()] + '"$(var nope)"' + SAMPLES[tag][place.end() :]
        try:
            carried_out(context, tmp_path, wrong)
        except BadLaunchFile as fault:
            told.append(str(fault))
    assert bool(told) is (tag not in HANDED_ON)
    for text in told:
        assert text.startswith(f"[ERROR] [launch]: a.launch.xml, line {LINE}: "), text


HANDED_ON = {"shutdown"}
"""Their attributes are never filled in, in Jazzy neither."""

PARTS = re.compile(r"<(?P<tag>[\w-]+)(?P<rest>[^>]*?)(?P<end>/?)>")


@pytest.mark.parametrize("tag", TAGS)
def test_what_an_element_does_not_know_is_refused(
    context: LaunchContext, tmp_path: Path, tag: str
) -> None:
    """An attribute or an element that nobody reads would do nothing, at each depth."""
    sample = SAMPLES[tag]
    for place in PARTS.finditer(sample):
        name = place["tag"]
        more = f'<{name}{place["rest"]} nonsense="1"{place["end"]}>'
        inside = f"<{name}{place['rest']}><nonsense/>" + (f"</{name}>" if place["end"] else "")
        for wrong in (more, inside):
            text = sample[: place.start()] + wrong + sample[place.end() :]
            with pytest.raises(BadLaunchFile, match=f"a.launch.xml, line {LINE}: .*nonsense"):
                carried_out(context, tmp_path, text)


def test_a_misspelt_element_inside_another_has_a_near_miss(
    context: LaunchContext, tmp_path: Path
) -> None:
    """In YAML too."""
    said = "there is no 'parm' inside 'node'. Did you mean param?"
    xml = '<node pkg="demo_nodes_py" exec="talker"><parm name="a" value="1"/></node>'
    with pytest.raises(BadLaunchFile, match=re.escape(said)):
        carried_out(context, tmp_path, xml)
    yaml = "- node: {pkg: demo_nodes_py, exec: talker, parm: [{name: a, value: 1}]}"
    with pytest.raises(BadLaunchFile, match=re.escape(said)):
        carried_out(context, tmp_path, yaml, "yaml")


KEEPS = {
    "xml": '<let name="bar" value="one"/><group forwarding="false">'
    '<keep name="bar" value="$(var bar) more"/><let name="seen" value="$(var bar)"/>'
    "<log message=\"seen: $(var seen) $(var gone '')\"/></group>",
    "yaml": "- let: {name: bar, value: one}\n- group:\n    forwarding: false\n"
    "    keep: [{name: bar, value: $(var bar) more}]\n"
    "    children:\n    - let: {name: seen, value: $(var bar)}\n"
    "    - log: {message: \"seen: $(var seen) $(var gone '')\"}",
}


@pytest.mark.parametrize("kind", KEEPS)
def test_what_a_group_keeps_is_read_outside_of_it(
    context: LaunchContext, tmp_path: Path, kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before all that is not forwarded is gone; afterwards all is as it was."""
    context.launch_configurations["gone"] = "gone"
    carried_out(context, tmp_path, KEEPS[kind], kind)
    assert "[launch.user]: seen: one more \n" in capsys.readouterr().out
    assert context.launch_configurations == {"gone": "gone", "bar": "one"}


ENVIRONMENT = {
    '<append_env name="MOOD" value="sea"/>': "calm:sea",
    '<append_env name="MOOD" value="sea" prepend="true" separator=" "/>': "sea calm",
    '<append_env name="MOOD" value="sea" if="false"/>': "calm",
}


@pytest.mark.parametrize("line", ENVIRONMENT)
def test_a_variable_grows(
    context: LaunchContext, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str
) -> None:
    """`append_env` of XML; YAML is read by the same words."""
    monkeypatch.setenv("MOOD", "calm")
    carried_out(context, tmp_path, line)
    assert context.environment["MOOD"] == ENVIRONMENT[line]
    monkeypatch.setenv("MOOD", "calm")
    words = ", ".join(f"{k}: '{v}'" for k, v in re.findall(r'(\w+)="([^"]*)"', line))
    carried_out(context, tmp_path, f"- append_env: {{{words}}}", "yaml")
    assert context.environment["MOOD"] == ENVIRONMENT[line]


PARAMETERS: dict[str, Any] = {
    'value="a \\&quot;b\\&quot; c"': 'a "b" c',
    'value="it\\\'s"': "it's",
    'value="\\$(var x)" type="str"': "$(var x)",
    'value="[a, b]" type="list_of_str"': ["a", "b"],
    'value="a;b" value-sep=";" type="list_of_str"': ["a", "b"],
    'value="1;2" value-sep=";" type="list_of_str"': ["1", "2"],
    'value="1;2" value-sep=";" type="list_of_int"': [1, 2],
    'value="1;2" value-sep=";" type="list_of_float"': [1.0, 2.0],
    'value="[true, false]" type="list_of_bool"': [True, False],
    'value="[1, 2]" type="list_of_str"': BadLaunchFile,
    'value="1" type="list_of_int"': BadLaunchFile,
    'value="1" type="list_of_char"': BadLaunchFile,
    'value="[1, 2]" type="yaml"': [1, 2],
}


@pytest.mark.parametrize("words", PARAMETERS)
def test_what_becomes_of_a_parameter(context: LaunchContext, tmp_path: Path, words: str) -> None:
    """Backslashes, and the types of Jazzy."""
    line = f'<node pkg="demo_nodes_py" exec="talker"><param name="p" {words}/></node>'
    if PARAMETERS[words] is BadLaunchFile:
        with pytest.raises(BadLaunchFile):
            carried_out(context, tmp_path, line)
        return
    carried_out(context, tmp_path, line)
    (planned,) = context.planned
    (given,) = planned.action.parameters  # type: ignore[attr-defined]  # a Node
    assert value_of(context, given["p"]) == PARAMETERS[words]


WORDS = {
    "a 'b c' d": ["a", "b c", "d"],
    "a$(var x)b $(var x)": ["atwo wordsb", "two words"],
    "'$(var x) c' d": ["two words c", "d"],
    '\\&quot;b c\\&quot; "d"'.replace('"d"', "d"): ["b c", "d"],
    "$(eval '1 + 1')": ["2"],
    "'' a": ["", "a"],
}


@pytest.mark.parametrize("text", WORDS)
def test_how_a_command_line_is_parted(context: LaunchContext, tmp_path: Path, text: str) -> None:
    """A `$(...)` is within one word, whatever comes of it."""
    context.launch_configurations["x"] = "two words"
    carried_out(context, tmp_path, f'<executable cmd="echo" args="{text}"/>')
    (planned,) = context.planned
    assert planned.command == ["echo", *WORDS[text]]
