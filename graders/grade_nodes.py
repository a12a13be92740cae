"""What counts as done in the lab "nodes": one node that tells how the rover is.

The numbers, names, texts and points stand in labs/nodes/card.yaml. Experiments run the
student's node and watch; checks read what was seen and run nothing.
"""

from roslings.capabilities.parameters.act import await_publishers, list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import (
    carry_topic_along,
    follow_its_parameter,
    has_parameter,
    take_names,
)
from roslings.capabilities.topics.demands import count_up, have_rate, say_its_text
from roslings.course import lab
from roslings.experiment import Run, Scene, experiment
from roslings.experiment.start import Start
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_named,
    be_the_only_one,
    be_there,
    carry_its_type,
    check,
    come_up,
    depends,
    end_within,
    exit_cleanly,
    install,
    log_each,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)

CARD = lab("nodes").card
NODE = CARD.node("minimal_publisher")
STATUS = NODE.publishes[0]
PERIOD = NODE.of(ParameterWords).parameters[0]
QUICK = STATUS.at(hz=1 / float(PERIOD.tried))
FIRST, SECOND = NODE.other_names


# --- experiments: run the node and watch -------------------------------------------------------


@experiment(clock="auto")
def alone(scene: Scene) -> None:
    """The node as it is, until its rate is sure."""
    with scene.run(NODE):
        scene.watch(STATUS)


@experiment(clock="auto")
def quicker(scene: Scene) -> None:
    """The node with another value of its parameter."""
    with scene.run(NODE, start=Start(parameters={PERIOD.name: PERIOD.tried})):
        list_parameters(scene, NODE)
        scene.watch(QUICK)


@experiment
def twice(scene: Scene) -> None:
    """Two of it at once, each with a name and a namespace of its own."""
    first, second = Run(NODE, start=Start(named=FIRST)), Run(NODE, start=Start(named=SECOND))
    with scene.run_all(first, second):
        await_publishers(scene)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {NODE.executable}."""
    package.must(be_built_as(CARD.build_type), install([NODE.executable]))


# --- the node ----------------------------------------------------------------------------------


@check(needs=["builds"])
def test_runs(alone: ExperimentView) -> None:
    """The program starts and makes a node."""
    alone.process(NODE).must(come_up)


@check(needs=["runs"])
def test_stays(alone: ExperimentView) -> None:
    """The node runs until Ctrl-C."""
    alone.process(NODE).must(stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_name(alone: ExperimentView) -> None:
    """The node is called {NODE.node}."""
    alone.node(NODE).must(be_named)


@check(needs=["runs"])
def test_topic(alone: ExperimentView) -> None:
    """It publishes on {STATUS.topic}."""
    alone.publisher(NODE, STATUS).must(be_there, be_the_only_one)


@check(needs=["runs"])
def test_type(alone: ExperimentView) -> None:
    """Its messages are {STATUS.type}, for all to hear (QoS)."""
    alone.publisher(NODE, STATUS).must(carry_its_type, match_qos)


@check(needs=["stays"])
def test_rate(alone: ExperimentView) -> None:
    """It publishes at {STATUS.rate.hz:g} Hz, evenly."""
    alone.topic(STATUS).must(have_rate(STATUS))


@check(needs=["type"])
def test_text(alone: ExperimentView) -> None:
    """They say {STATUS.text!r}, with a number for {{n}}."""
    alone.topic(STATUS).must(say_its_text)


@check(needs=["type"])
def test_counting(alone: ExperimentView) -> None:
    """The number goes up by one from message to message."""
    alone.topic(STATUS).must(count_up)


@check(needs=["type"])
def test_logs(alone: ExperimentView) -> None:
    """The node writes each message that it publishes, once."""
    texts = alone.topic(STATUS).texts
    alone.process(NODE).must(log_each(NODE, texts))


# --- the same node, started in other ways ------------------------------------------------------


@check(needs=["stays"], explained_by={"rate": "FallsSilent"})
def test_parameter(quicker: ExperimentView) -> None:
    """The parameter {PERIOD.name} sets the seconds from message to message."""
    quicker.process(NODE).must(come_up, stay_up)
    quicker.must(has_parameter(NODE, PERIOD))
    quicker.topic(STATUS).must(follow_its_parameter(PERIOD, STATUS, QUICK))


@check(needs=["stays"], explained_by={"parameter": "ParameterIgnored"})
def test_other_names(twice: ExperimentView, alone: ExperimentView) -> None:
    """Run as {FIRST} and {SECOND}, each has its own topic."""
    twice.must(take_names(NODE.other_names))
    twice.must(carry_topic_along(NODE.other_names, STATUS, alone))


# --- the end -----------------------------------------------------------------------------------


@check(needs=["stays"])
def test_ends(alone: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    alone.process(NODE).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(alone: ExperimentView) -> None:
    """After Ctrl-C it ends without an error: exit code 0, no traceback."""
    alone.process(NODE).must(exit_cleanly)
