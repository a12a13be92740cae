"""Which nodes, topics, services and actions there are: the format is the one of Jazzy's tools."""

from __future__ import annotations

import pytest
from terminal import Shell

pytestmark = pytest.mark.slow

NODES = ["/ear", "/field/rover", "/motor", "/talker", "/tuner"]
TALKER = """\
/talker
  Subscribers:

  Publishers:
    /chatter: std_msgs/msg/String
    /parameter_events: rcl_interfaces/msg/ParameterEvent
    /rosout: rcl_interfaces/msg/Log
  Service Servers:
    /talker/describe_parameters: rcl_interfaces/srv/DescribeParameters
    /talker/get_parameter_types: rcl_interfaces/srv/GetParameterTypes
    /talker/get_parameters: rcl_interfaces/srv/GetParameters
    /talker/get_type_description: type_description_interfaces/srv/GetTypeDescription
    /talker/list_parameters: rcl_interfaces/srv/ListParameters
    /talker/set_parameters: rcl_interfaces/srv/SetParameters
    /talker/set_parameters_atomically: rcl_interfaces/srv/SetParametersAtomically
  Service Clients:

  Action Servers:

  Action Clients:

"""
TOPICS = {
    "/chatter": "std_msgs/msg/String",
    "/cmd_vel": "geometry_msgs/msg/TwistStamped",
    "/heard": "std_msgs/msg/String",
    "/motor/transition_event": "lifecycle_msgs/msg/TransitionEvent",
    "/parameter_events": "rcl_interfaces/msg/ParameterEvent",
    "/rosout": "rcl_interfaces/msg/Log",
    "/scan": "sensor_msgs/msg/LaserScan",
}


def test_node_list(stage: Shell) -> None:
    """Every node, in order; the hidden one only when asked for."""
    assert stage("node", "list").lines == NODES
    assert stage("node", "list", "-a").lines == ["/_hidden", *NODES]
    assert stage("node", "list", "-c").out == f"{len(NODES)}\n"


def test_node_list_where_nothing_runs(empty: Shell) -> None:
    """No node is no error."""
    ran = empty("node", "list")
    assert (ran.code, ran.out) == (0, "")


def test_node_info(stage: Shell) -> None:
    """The six parts, an empty line where there is nothing."""
    assert stage("node", "info", "/talker").out == TALKER
    assert "    /fibonacci: test_msgs/action/Fibonacci" in stage("node", "info", "tuner").lines


def test_node_info_of_a_misspelt_node(stage: Shell) -> None:
    """A near miss, and the next step."""
    ran = stage("node", "info", "/talkr")
    assert (ran.code, ran.out) == (1, "")
    assert "Unable to find node '/talkr'. Did you mean /talker?" in ran.err


def test_hidden_node_is_shown_only_when_asked_for(stage: Shell) -> None:
    """As the real tool does."""
    assert stage("node", "info", "/_hidden").code == 1
    assert stage("node", "info", "/_hidden", "--include-hidden").lines[0] == "/_hidden"


def test_two_nodes_of_one_name(empty: Shell) -> None:
    """Both are listed, and a warning says so."""
    talker = ("run", "demo_nodes_py", "talker")
    with empty.start(*talker) as one, empty.start(*talker) as two:
        one.wait_for("Publishing")
        two.wait_for("Publishing")
        ran = empty("node", "list")
    assert ran.lines == ["/talker", "/talker"]
    assert "share an exact name" in ran.err


def test_topic_list(stage: Shell) -> None:
    """Names, types, numbers, details."""
    assert stage("topic", "list").lines == list(TOPICS)
    assert stage("topic", "list", "-t").lines == [f"{n} [{t}]" for n, t in TOPICS.items()]
    assert stage("topic", "list", "-c").out == f"{len(TOPICS)}\n"
    assert "/_whisper" in stage("topic", "list", "--include-hidden-topics").lines


def test_topic_list_verbose(stage: Shell) -> None:
    """Who publishes, who subscribes."""
    lines = stage("topic", "list", "-v").lines
    assert lines[0] == "Published topics:"
    assert " * /chatter [std_msgs/msg/String] 1 publisher" in lines
    assert " * /rosout [rcl_interfaces/msg/Log] 6 publishers" in lines
    assert lines[-4:-1] == [
        "",
        "Subscribed topics:",
        " * /heard [std_msgs/msg/String] 1 subscriber",
    ]


def test_topic_info(stage: Shell) -> None:
    """Type and counts."""
    expected = "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n"
    assert stage("topic", "info", "/chatter").out == expected


def test_topic_info_verbose(stage: Shell) -> None:
    """Each endpoint with its quality of service; only the id differs from run to run."""
    lines = stage("topic", "info", "-v", "scan").lines
    gid = next(line for line in lines if line.startswith("GID: "))
    kind = next(line for line in lines if line.startswith("Topic type hash: RIHS01_"))
    assert lines == [
        "Type: sensor_msgs/msg/LaserScan",
        "",
        "Publisher count: 1",
        "",
        "Node name: rover",
        "Node namespace: /field",
        "Topic type: sensor_msgs/msg/LaserScan",
        kind,
        "Endpoint type: PUBLISHER",
        gid,
        "QoS profile:",
        "  Reliability: BEST_EFFORT",
        "  History (Depth): UNKNOWN",
        "  Durability: VOLATILE",
        "  Lifespan: Infinite",
        "  Deadline: Infinite",
        "  Liveliness: AUTOMATIC",
        "  Liveliness lease duration: Infinite",
        "",
        "Subscription count: 0",
        "",
    ]


def test_topic_type_and_find(stage: Shell) -> None:
    """From a name to a type and back."""
    assert stage("topic", "type", "/chatter").out == "std_msgs/msg/String\n"
    assert stage("topic", "find", "std_msgs/msg/String").lines == ["/chatter", "/heard"]
    assert stage("topic", "find", "std_msgs/msg/NotThere").out == ""


def test_unknown_topics_get_near_misses(stage: Shell) -> None:
    """Each verb that takes a topic names the one that was meant."""
    for verb in ("info", "type", "echo"):
        ran = stage("topic", verb, "/chater")
        assert ran.code == 1
        assert "Did you mean /chatter?" in ran.err, verb


def test_service_words(stage: Shell) -> None:
    """list, type, find."""
    assert "/light" in stage("service", "list").lines
    assert "/light [std_srvs/srv/SetBool]" in stage("service", "list", "-t").lines
    assert stage("service", "type", "/light").out == "std_srvs/srv/SetBool\n"
    assert stage("service", "find", "std_srvs/srv/SetBool").out == "/light\n"
    assert "Did you mean /light?" in stage("service", "type", "/ligth").err


def test_action_words(stage: Shell) -> None:
    """list and info."""
    assert stage("action", "list").out == "/fibonacci\n"
    assert stage("action", "list", "-t").out == "/fibonacci [test_msgs/action/Fibonacci]\n"
    assert stage("action", "info", "/fibonacci", "-t").lines == [
        "Action: /fibonacci",
        "Action clients: 0",
        "Action servers: 1",
        "    /tuner [test_msgs/action/Fibonacci]",
    ]
    assert stage("action", "info", "/fibonaci").lines[1:] == [
        "Action clients: 0",
        "Action servers: 0",
    ]
