"""What counts as done in this lab: tides for who comes late, and warnings of gales."""

from graders.almanac.act import blow
from graders.almanac.contract import GaleWords
from graders.almanac.demands import warn_of_gales

from roslings.capabilities.qos.act import come_late
from roslings.capabilities.qos.contract import QosWords
from roslings.capabilities.qos.demands import (
    ask_for,
    keep_for_late_joiners,
    offer,
    tell_late_joiners_the_truth,
)
from roslings.course import lab, written
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_there,
    be_well_formed,
    carry_its_type,
    check,
    come_up,
    end_within,
    install,
    list_what_it_imports,
    match_qos,
    stay_up,
)

CARD = lab("almanac").card
ALMANAC = CARD.node("almanac")
TIDES, WIND = ALMANAC.publishes[0], ALMANAC.subscribes[0]
KEPT, ASKED = ALMANAC.of(QosWords).offers[0], ALMANAC.of(QosWords).asks[0]
LAST_CM, SAID = 180, 5
EDGE_M_S = written(ALMANAC.of(GaleWords).warns_above_m_s, ALMANAC.node)
WINDS_M_S = (EDGE_M_S + 3.5, EDGE_M_S - 0.5, EDGE_M_S + 0.5)


@experiment
def telling(scene: Scene) -> None:
    """The almanac, and somebody who comes late."""
    with scene.run(ALMANAC):
        come_late(scene, TIDES, "all tides were told", wanted=LAST_CM, said=SAID)
        blow(scene, ALMANAC, ASKED, WINDS_M_S)


@check()
def test_well_formed(package: PackageView) -> None:
    """The package has all its files, and ROS and Python can read them."""
    package.must(be_well_formed(CARD.build_type), list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {ALMANAC.executable}."""
    package.must(be_built_as(CARD.build_type), install([ALMANAC.executable]))


@check(needs=["builds"])
def test_runs(telling: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    telling.process(ALMANAC).must(come_up, stay_up)


@check(needs=["runs"])
def test_topics(telling: ExperimentView) -> None:
    """Both topics have names, types, reliability and durability of the card."""
    telling.publisher(ALMANAC, TIDES).must(be_there, carry_its_type, match_qos)
    telling.subscription(ALMANAC, WIND).must(be_there, carry_its_type, match_qos)


@check(needs=["topics"])
def test_offers(telling: ExperimentView) -> None:
    """It gives signs of life, with a lease of {KEPT.lease_s:g} s."""
    telling.must(offer(KEPT))


@check(needs=["topics"])
def test_kept(telling: ExperimentView) -> None:
    """Who comes late gets the last {KEPT.keeps} tides, the newest one last."""
    telling.must(keep_for_late_joiners(KEPT), tell_late_joiners_the_truth(TIDES))


@check(needs=["topics"])
def test_asks(telling: ExperimentView) -> None:
    """It asks for a deadline and for signs of life on {WIND.topic}."""
    telling.must(ask_for(ASKED))


@check(needs=["topics"])
def test_warns(telling: ExperimentView) -> None:
    """It warns of wind above {EDGE_M_S:g} m/s."""
    telling.must(warn_of_gales(ALMANAC))


@check(needs=["runs"])
def test_ends(telling: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    telling.process(ALMANAC).must(end_within(CARD.ends_within_s))
