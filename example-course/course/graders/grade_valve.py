"""What counts as done in this lab: a valve that is led from state to state.

The numbers, names, texts and points stand in the lab's card.yaml. Experiments run the student's
nodes and watch; checks read what was seen and run nothing.
"""

from graders.valve.act import walk
from graders.valve.demands import be_managed, go_through

from roslings.course import lab
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_named,
    be_well_formed,
    check,
    come_up,
    end_within,
    install,
    list_what_it_imports,
    outlast_the_soak,
    stay_up,
)

CARD = lab("valve").card
VALVE = CARD.node("valve")


@experiment
def leading(scene: Scene) -> None:
    """Your node is led from state to state."""
    with scene.run(VALVE):
        walk(scene, VALVE)


@check()
def test_well_formed(package: PackageView) -> None:
    """The package has all its files, and ROS and Python can read them."""
    package.must(be_well_formed(CARD.build_type), list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {VALVE.executable}."""
    package.must(be_built_as(CARD.build_type), install([VALVE.executable]))


@check(needs=["builds"])
def test_runs(leading: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    leading.process(VALVE).must(come_up, stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_named(leading: ExperimentView) -> None:
    """The node is called {VALVE.node}."""
    leading.node(VALVE).must(be_named)


@check(needs=["runs"])
def test_managed(leading: ExperimentView) -> None:
    """It is a managed node: others can change its state."""
    leading.must(be_managed(VALVE))


@check(needs=["managed"])
def test_states(leading: ExperimentView) -> None:
    """Each transition leads to the state on the card."""
    leading.must(go_through(VALVE))


@check(needs=["runs"])
def test_ends(leading: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    leading.process(VALVE).must(end_within(CARD.ends_within_s))
