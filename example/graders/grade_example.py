"""What counts as done in this lab: a beacon that tells that it is alive.

The numbers, names, texts and points stand in the lab's card.yaml. Experiments run the student's
nodes and watch; checks read what was seen and run nothing.
"""

from roslings.capabilities.topics.demands import count_up, have_rate, say_its_text
from roslings.course import lab
from roslings.experiment import Scene, experiment
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
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)

CARD = lab("example").card
BEACON = CARD.node("beacon")
ALIVE = BEACON.publishes[0]


# --- experiments: run the nodes and watch ------------------------------------------------------


@experiment(clock="auto")
def telling(scene: Scene) -> None:
    """The node alone, until its rate is sure."""
    with scene.run(BEACON):
        scene.watch(ALIVE)


# --- checks: look at what was seen -------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {BEACON.executable}."""
    package.must(be_built_as(CARD.build_type), install([BEACON.executable]))


@check(needs=["builds"])
def test_runs(telling: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    telling.process(BEACON).must(come_up, stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_named(telling: ExperimentView) -> None:
    """The node is called {BEACON.node}."""
    telling.node(BEACON).must(be_named)


@check(needs=["runs"])
def test_topic(telling: ExperimentView) -> None:
    """It publishes {ALIVE.type} on {ALIVE.topic}."""
    telling.publisher(BEACON, ALIVE).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["runs"])
def test_rate(telling: ExperimentView) -> None:
    """{ALIVE.topic} comes at {ALIVE.rate.hz:g} Hz, evenly."""
    telling.topic(ALIVE).must(have_rate(ALIVE))


@check(needs=["runs"])
def test_text(telling: ExperimentView) -> None:
    """The messages say {ALIVE.text!r}, with a number for {{n}} that counts up by one."""
    telling.topic(ALIVE).must(say_its_text, count_up)


@check(needs=["runs"])
def test_ends(telling: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    telling.process(BEACON).must(end_within(CARD.ends_within_s))
