"""How a node is started, and where its topics go then."""

from __future__ import annotations

import pytest

from roslings.capabilities.parameters.contract import ParameterContract
from roslings.capabilities.parameters.demands import carried, declare_its_parameters
from roslings.capabilities.parameters.faults import WrongDefault
from roslings.capabilities.parameters.record import ParameterDeclared
from roslings.course import NodeContract
from roslings.evidence import GraphSeen, ProcessSeen
from roslings.experiment.start import PLAIN, Start
from roslings.judge import ExperimentView
from seen_with import seen_with


def test_the_words_of_the_command_line() -> None:
    """Names, then the rules that mend slips, then parameters as YAML reads them."""
    start = Start(named="/left/first", parameters={"period": 0.2, "loud": True})
    assert start.arguments(["/a:=/b"]) == [
        "--ros-args",
        *("-r", "__node:=first", "-r", "__ns:=/left", "-r", "/a:=/b"),
        *("-p", "period:=0.2", "-p", "loud:=true"),
    ]
    assert Start(named="/first").arguments()[-1] == "__ns:=/"
    assert PLAIN.arguments() == []


def test_two_of_one_program_have_two_labels() -> None:
    """So that one's output does not hide the other's."""
    node = NodeContract(node="/rover", executable="go")
    assert [PLAIN.label(node), Start(named="/left/first").label(node)] == ["go", "/left/first"]


@pytest.mark.parametrize(
    ("topic", "node", "new"),
    [
        ("/status", "/rover", "/left/status"),
        ("/rover/status", "/rover", "/left/first/status"),
        ("/fleet/status", "/fleet/rover", "/left/status"),
        ("/status", "/fleet/rover", "/status"),
    ],
    ids=["relative", "private", "in a namespace of its own", "absolute, in a namespace"],
)
def test_a_topic_follows_its_node(topic: str, node: str, new: str) -> None:
    """What ROS makes of the name when the node becomes /left/first."""
    assert carried(topic, node, "/left/first") == new


@pytest.mark.parametrize("given", [(), ("port",)])
def test_a_default_is_seen_where_nobody_gave_a_value(given: tuple[str, ...]) -> None:
    """What the process was started with hides the default."""
    port = ParameterContract(name="port", type="string", about="", default="/a", tried="/b")
    node = NodeContract(node="/it", executable="it", parameters=(port,))
    seen = seen_with(
        name="x",
        clock="wall",
        graph=GraphSeen(nodes=["/it"], endpoints=[]),
        processes={"it": ProcessSeen(executable="it", started_ns=0, given=list(given))},
        parameters={"/it": ["port"]},
        declared=[ParameterDeclared(node="/it", name="port", type="string", value="/b")],
    )
    if given:
        declare_its_parameters(node)(ExperimentView(seen))
        return
    with pytest.raises(WrongDefault):
        declare_its_parameters(node)(ExperimentView(seen))
