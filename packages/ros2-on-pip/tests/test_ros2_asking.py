"""Services, parameters, actions, states, interfaces."""

from __future__ import annotations

from pathlib import Path

import pytest
from terminal import Shell

pytestmark = pytest.mark.slow

OWN = ("start_type_description_service", "use_sim_time")
"""Parameters that rclpy adds to every node."""


def test_service_call(stage: Shell) -> None:
    """Request and answer as the real tool prints them."""
    ran = stage("service", "call", "/light", "std_srvs/srv/SetBool", "{data: true}")
    assert ran.code == 0
    assert ran.out == (
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='on')\n\n"
    )


def test_service_call_again_and_again(stage: Shell) -> None:
    """`-r`, until Ctrl-C."""
    with stage.start("service", "call", "-r", "20", "/light", "std_srvs/srv/SetBool") as calls:
        calls.wait_for("message='off'", times=3)
        assert calls.interrupt() == 2


def test_service_call_with_another_type(stage: Shell) -> None:
    """It would wait for ever; so the right type is named."""
    ran = stage("service", "call", "/light", "std_srvs/srv/Trigger")
    assert ran.code == 1
    assert "The service '/light' has the type std_srvs/srv/SetBool" in ran.err


def test_service_call_of_a_misspelt_service(stage: Shell) -> None:
    """It waits, as the real tool does, and says the near miss."""
    with stage.start("service", "call", "/ligth", "std_srvs/srv/SetBool") as call:
        call.wait_for("waiting for service to become available...")
        call.wait_for("No node offers '/ligth' yet. Did you mean /light?")


def test_param_list(stage: Shell) -> None:
    """Of one node, of all nodes, with types."""
    names = sorted(["label", "speed", "steps", "wheel.radius", *OWN])
    assert stage("param", "list", "/tuner").lines == [f"  {name}" for name in names]
    every = stage("param", "list").lines
    assert every[every.index("/tuner:") + 1 :][: len(names)] == [f"  {name}" for name in names]
    assert "  speed (type: double)" in stage("param", "list", "tuner", "--param-type").lines


def test_param_get(stage: Shell) -> None:
    """Label and value."""
    assert stage("param", "get", "/tuner", "wheel.radius").out == "Double value is: 0.1\n"
    assert stage("param", "get", "/tuner", "steps").out == "Integer values are: [1, 2]\n"
    assert stage("param", "get", "/tuner", "wheel.radius", "--hide-type").out == "0.1\n"
    ran = stage("param", "get", "/tuner", "wheel.radus")
    assert ran.code == 1
    assert "Did you mean wheel.radius?" in ran.err


def test_param_set(stage: Shell) -> None:
    """Taken, refused, misspelt, and no such node."""
    assert stage("param", "set", "/tuner", "speed", "2.5").out == "Set parameter successful\n"
    assert stage("param", "get", "/tuner", "speed").out == "Double value is: 2.5\n"
    refused = stage("param", "set", "/tuner", "speed", "9.5")
    assert refused.code == 1
    assert refused.err.startswith("Setting parameter failed: Parameter speed out of range")
    assert "Did you mean speed?" in stage("param", "set", "/tuner", "sped", "1.0").err
    assert "Did you mean /tuner?" in stage("param", "set", "/tunr", "speed", "1.0").err


def test_param_describe(stage: Shell) -> None:
    """Type, description, range."""
    assert stage("param", "describe", "/tuner", "speed").out == (
        "Parameter name: speed\n  Type: double\n  Description: How fast\n  Constraints:\n"
        "    Min value: 0.0\n    Max value: 3.0\n"
    )


def test_param_dump_and_load(stage: Shell, tmp_path: Path) -> None:
    """A dump changed by hand is loaded again."""
    dumped = stage("param", "dump", "/tuner").out
    assert dumped.startswith("/tuner:\n  ros__parameters:\n    label: ")
    assert "    wheel:\n      radius: " in dumped
    file = tmp_path / "tuner.yaml"
    file.write_text("/tuner:\n  ros__parameters:\n    label: alice\n    wheel: {radius: 0.2}\n")
    assert stage("param", "load", "/tuner", str(file)).lines == [
        "Set parameter label successful",
        "Set parameter wheel.radius successful",
    ]
    assert stage("param", "get", "/tuner", "label").out == "String value is: alice\n"
    stage("param", "set", "/tuner", "wheel.radius", "0.1")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("/other:\n  ros__parameters:\n    a: 1\n", "does not contain parameters for /tuner"),
        ("/tuner:\n  label: x\n", "has no part 'ros__parameters'"),
        ("/tuner: [", "no valid YAML"),
    ],
)
def test_param_load_of_a_wrong_file(stage: Shell, tmp_path: Path, text: str, said: str) -> None:
    """What is wrong with it, and how it should look."""
    file = tmp_path / "wrong.yaml"
    file.write_text(text)
    ran = stage("param", "load", "/tuner", str(file))
    assert ran.code == 1
    assert said in ran.err


def test_send_goal_with_feedback(stage: Shell) -> None:
    """From the goal to its result."""
    words = ("action", "send_goal", "/fibonacci", "test_msgs/action/Fibonacci", "{order: 2}")
    lines = stage(*words, "--feedback").lines
    assert lines[:4] == [
        "Waiting for an action server to become available...",
        "Sending goal:",
        "     order: 2",
        "",
    ]
    assert lines[4].startswith("Goal accepted with ID: ")
    rest = [line for line in lines[6:] if line]
    feedback = ["Feedback:", "    sequence:", "- 0", "- 1", "- 1"]
    result = ["Result:", "    sequence:", "- 0", "- 1", "- 1"]
    assert rest == [*feedback, *result, "Goal finished with status: SUCCEEDED"]


def test_send_goal_with_another_type(stage: Shell) -> None:
    """The right type is named."""
    ran = stage("action", "send_goal", "/fibonacci", "test_msgs/action/NestedMessage", "{}")
    assert ran.code == 1
    assert "has the type test_msgs/action/Fibonacci" in ran.err


def test_lifecycle(stage: Shell) -> None:
    """Look at a node's state, and change it."""
    assert stage("lifecycle", "nodes").out == "/motor\n"
    assert stage("lifecycle", "get", "/motor").out == "unconfigured [1]\n"
    assert stage("lifecycle", "list", "/motor").out == (
        "- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"
        "- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n"
    )
    assert stage("lifecycle", "set", "/motor", "configure").out == "Transitioning successful\n"
    assert stage("lifecycle", "get").out == "/motor: inactive [2]\n"
    refused = stage("lifecycle", "set", "/motor", "configure")
    assert refused.code == 1
    assert refused.err == (
        "Unknown transition requested, available ones are:\n"
        "- cleanup [2]\n- activate [3]\n- shutdown [6]\n"
    )
    assert stage("lifecycle", "set", "/motor", "2").code == 0
    assert "is no lifecycle node" in stage("lifecycle", "get", "/tuner").err


def test_interface_show(empty: Shell) -> None:
    """Types inside types are shown below their field, without their comments."""
    assert empty("interface", "show", "geometry_msgs/msg/Twist").lines[-8:] == [
        "Vector3  linear",
        "\tfloat64 x",
        "\tfloat64 y",
        "\tfloat64 z",
        "Vector3  angular",
        "\tfloat64 x",
        "\tfloat64 y",
        "\tfloat64 z",
    ]
    assert empty("interface", "show", "std_srvs/srv/Trigger", "--no-comments").lines == [
        "---",
        "bool success",
        "string message",
    ]
    assert "Did you mean std_msgs/msg/String?" in empty("interface", "show", "String").err


def test_interface_proto(empty: Shell) -> None:
    """A message with its defaults, in quotes, to copy into `topic pub`."""
    ran = empty("interface", "proto", "geometry_msgs/msg/Vector3")
    assert ran.out == '"x: 0.0\ny: 0.0\nz: 0.0\n"\n'


def test_interface_list(empty: Shell) -> None:
    """By kind."""
    lines = empty("interface", "list").lines
    assert lines[0] == "Messages:"
    assert lines.index("Services:") < lines.index("Actions:")
    assert "    std_msgs/msg/String" in lines
    only = empty("interface", "list", "-s").lines
    assert only[0] == "Services:"
    assert "    std_srvs/srv/SetBool" in only
    assert not any("/msg/" in line for line in only)
