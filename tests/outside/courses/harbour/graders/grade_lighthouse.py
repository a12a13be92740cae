"""What counts as done in this lab: flashes that others can set."""

from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.parameters.obeying import beat_by_its_value, take_what_its_card_allows
from roslings.capabilities.parameters.setting import setting
from roslings.course import lab
from roslings.experiment import Scene, experiment
from roslings.experiment.timing import accounting
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_well_formed,
    check,
    come_up,
    end_within,
    install,
    list_what_it_imports,
    stay_up,
)

CARD = lab("lighthouse").card
LIGHTHOUSE = CARD.node("lighthouse")
FLASH = LIGHTHOUSE.publishes[0]
FLASHES, COLOUR = LIGHTHOUSE.of(ParameterWords).parameters
FLASHES_TO_COUNT = 12


@experiment
def flashing(scene: Scene) -> None:
    """The lighthouse, while somebody sets its parameters."""
    with scene.run(LIGHTHOUSE) as process, setting(scene, process, LIGHTHOUSE) as setter:
        list_parameters(scene, LIGHTHOUSE)
        scene.hear(FLASH)
        if setter is None:
            return
        with accounting(scene, "pace"):
            setter.set_one("pace", FLASHES.name, FLASHES.tried)
            scene.hear(FLASH, count=scene.heard(FLASH) + FLASHES_TO_COUNT)
        for value in FLASHES.beyond:
            setter.set_one("beyond", FLASHES.name, value)
        setter.set_one("colour", COLOUR.name, COLOUR.tried)


@check()
def test_well_formed(package: PackageView) -> None:
    """The package has all its files, and ROS and Python can read them."""
    package.must(be_well_formed(CARD.build_type), list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {LIGHTHOUSE.executable}."""
    package.must(be_built_as(CARD.build_type), install([LIGHTHOUSE.executable]))


@check(needs=["builds"])
def test_runs(flashing: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    flashing.process(LIGHTHOUSE).must(come_up, stay_up)


@check(needs=["runs"])
def test_parameters(flashing: ExperimentView) -> None:
    """It has the parameters of the card, with their types and defaults."""
    flashing.must(declare_its_parameters(LIGHTHOUSE))


@check(needs=["parameters"])
def test_follows(flashing: ExperimentView) -> None:
    """{FLASHES.name} acts while it runs."""
    flashing.must(take_what_its_card_allows(LIGHTHOUSE, "pace"))
    flashing.must(beat_by_its_value(FLASH, FLASHES.name, "pace"))


@check(needs=["parameters"])
def test_refuses(flashing: ExperimentView) -> None:
    """{FLASHES.name} is {FLASHES.span}; all else is refused."""
    flashing.must(take_what_its_card_allows(LIGHTHOUSE, "beyond"))


@check(needs=["parameters"])
def test_colour(flashing: ExperimentView) -> None:
    """{COLOUR.name} is chosen at the start: nobody can change it later."""
    flashing.must(take_what_its_card_allows(LIGHTHOUSE, "colour"))


@check(needs=["runs"])
def test_ends(flashing: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    flashing.process(LIGHTHOUSE).must(end_within(CARD.ends_within_s))
