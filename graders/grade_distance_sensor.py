"""What counts as done in the lab "distance-sensor": a sensor, a node that warns, a launch file.

The numbers, names and points stand in labs/distance-sensor/card.yaml. Experiments run the
student's nodes, let echoes come back from obstacles, and watch; checks read what was seen.
"""

import math

from roslings.capabilities.launch.act import launched
from roslings.capabilities.launch.contract import LaunchWords
from roslings.capabilities.launch.demands import start_all
from roslings.capabilities.topics.act import Teller
from roslings.capabilities.topics.demands import have_rate
from roslings.capabilities.topics.relay import (
    RelayedValue,
    answer_each_once,
    carry_its_time,
    hold_its_fields,
    leave_at_zero,
    show,
    show_at_first,
    write_each,
)
from roslings.course import lab
from roslings.course.files import written
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
    exit_cleanly,
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)
from roslings.judge.values import Fields, number_of

CARD = lab("distance-sensor").card
SENSOR, SUBSCRIBER = CARD.node("distance_sensor"), CARD.node("distance_subscriber")
ECHO, DISTANCE = SENSOR.subscribes[0], SENSOR.publishes[0]
HEARD, OBSTACLE = SUBSCRIBER.subscribes[0], SUBSCRIBER.publishes[0]
LAUNCH = written(CARD.of(LaunchWords).launch, "the package")
SPEED = SENSOR.constant("speed_of_sound")
NEAREST, FARTHEST = (float(DISTANCE.fields[name]) for name in ("min_range", "max_range"))
NEAR, CLEAR = SUBSCRIBER.constant("near"), SUBSCRIBER.constant("clear")
NAN, INFINITY = math.nan, math.inf
BESIDE = (0.005, 0.03)
"""So many metres beside a limit: just beyond it, and beyond doubt."""

SILENCE_S = 0.6
MEASURED = RelayedValue(SENSOR, "data", DISTANCE, "range")
WARNED = RelayedValue(SUBSCRIBER, "range", OBSTACLE, "data", remembers=True)


# --- what is told, and what is right -----------------------------------------------------------


def echoes(scene: Scene) -> list[float]:
    """Seconds until the echo: in range, just beyond each end, not understood, just in again."""
    metres = [
        scene.between(0.5, 1.5),
        scene.between(FARTHEST - 0.1, FARTHEST - 0.02),
        scene.between(NEAREST * 0.6, NEAREST * 0.9),
        scene.between(FARTHEST + 0.02, FARTHEST + 0.1),
        NAN,
        INFINITY,
        scene.between(NEAREST * 1.1, NEAREST * 1.5),
    ]
    return [2 * each / SPEED for each in metres]


def range_after(echo: Fields) -> float:
    """What the sensor then measures: metres, or an infinity where that is out of range."""
    metres = number_of(echo, "data") * SPEED / 2
    if metres < NEAREST:
        return -INFINITY
    return INFINITY if metres > FARTHEST else metres


def usual_range(number: int, echo: Fields) -> float | None:
    """The range after an echo, where it is a distance."""
    return range_after(echo) if math.isfinite(range_after(echo)) else None


def odd_range(number: int, echo: Fields) -> float | None:
    """The range after an echo, where it is none."""
    return None if math.isfinite(range_after(echo)) else range_after(echo)


def distances(scene: Scene) -> list[float]:
    """Metres, for the steps of `STEPS`; on both sides of each limit, some are just beside it."""
    far, near = scene.between(1.0, 2.0), scene.between(NEAREST, NEAR - 0.05)
    below, above = beside(scene, NEAR)
    within, clear = beside(scene, CLEAR)
    between = scene.between(NEAR + BESIDE[1], CLEAR - BESIDE[1])
    return [between, far, above, below, within, clear, near, NAN, INFINITY, -INFINITY]


def beside(scene: Scene, limit: float) -> tuple[float, float]:
    """A number just below the limit, and one just above."""
    return limit - scene.between(*BESIDE), limit + scene.between(*BESIDE)


STEPS: list[tuple[str, bool]] = [
    ("hysteresis", False),
    ("obstacle", False),
    ("hysteresis", False),
    ("obstacle", True),
    ("hysteresis", True),
    ("obstacle", False),
    ("obstacle", True),
    ("odd", True),
    ("odd", False),
    ("odd", True),
]
"""For each distance: which check asks for it, and whether it is an obstacle then."""


def warning(kind: str, number: int) -> bool | None:
    """Whether something is in the way after the n-th distance; None for the other checks."""
    step, obstacle = STEPS[number]
    return obstacle if step == kind else None


def millimetres(distance: Fields) -> list[str]:
    """The numbers that may be written for a distance: rounded, or cut off."""
    metres = number_of(distance, "range")
    whole = round(metres * 1000) if math.isfinite(metres) else None
    return [] if whole is None else [str(whole), str(whole - 1), str(whole + 1)]


# --- experiments: run the nodes, tell them values, and watch -----------------------------------


@experiment
def sensing(scene: Scene) -> None:
    """The sensor alone; the echoes of an obstacle that moves come back to it."""
    with scene.run(SENSOR) as process:
        scene.watch(DISTANCE)
        teller = Teller(scene, process, ECHO, DISTANCE)
        for seconds in echoes(scene):
            teller.tell_and_await_timer({"data": seconds})


@experiment
def hearing(scene: Scene) -> None:
    """The subscriber alone, while distances come that it cannot know."""
    with scene.run(SUBSCRIBER) as process:
        teller = Teller(scene, process, HEARD, OBSTACLE)
        teller.rest(SILENCE_S)
        for metres in distances(scene):
            teller.tell({**DISTANCE.fields, "range": metres})
        teller.rest(SILENCE_S)


@experiment
def together(scene: Scene) -> None:
    """Both, started by the launch file."""
    with launched(scene, CARD.package, LAUNCH):
        pass


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, with {SENSOR.executable} and {SUBSCRIBER.executable}."""
    package.must(be_built_as(CARD.build_type), install([SENSOR.executable, SUBSCRIBER.executable]))


# --- the sensor --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_sensor_runs(sensing: ExperimentView) -> None:
    """The sensor starts, makes a node and runs on."""
    sensing.process(SENSOR).must(come_up, outlast_the_soak)


@check(needs=["sensor_runs"])
def test_sensor_name(sensing: ExperimentView) -> None:
    """The sensor's node is called {SENSOR.node}."""
    sensing.node(SENSOR).must(be_named)


@check(needs=["sensor_runs"])
def test_sensor_hears(sensing: ExperimentView) -> None:
    """It subscribes to {ECHO.topic}, {ECHO.type}."""
    sensing.subscription(SENSOR, ECHO).must(be_there, carry_its_type, match_qos)


@check(needs=["sensor_runs"])
def test_sensor_topic(sensing: ExperimentView) -> None:
    """It publishes {DISTANCE.type} on {DISTANCE.topic}."""
    publisher = sensing.publisher(SENSOR, DISTANCE)
    publisher.must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["sensor_runs"])
def test_rate(sensing: ExperimentView) -> None:
    """It publishes at {DISTANCE.rate.hz:g} Hz, with and without echoes."""
    sensing.topic(DISTANCE).must(have_rate(DISTANCE))


@check(needs=["sensor_runs"])
def test_fields(sensing: ExperimentView) -> None:
    """Each message says whose it is, and what the sensor can measure."""
    sensing.topic(DISTANCE).must(hold_its_fields, leave_at_zero(MEASURED.name, *DISTANCE.fields))


@check(needs=["sensor_runs"])
def test_stamp(sensing: ExperimentView) -> None:
    """Each message says when it was made."""
    sensing.topic(DISTANCE).must(carry_its_time)


@check(needs=["sensor_runs"])
def test_distance(sensing: ExperimentView) -> None:
    """The range is right: it follows from the time of the echo."""
    sensing.must(show(MEASURED, usual_range))


@check(needs=["sensor_runs"], explained_by={"distance": "WrongReaction"})
def test_out_of_range(sensing: ExperimentView) -> None:
    """Too near is -infinity, too far +infinity, NaN is NaN (REP 117)."""
    sensing.must(show_at_first(MEASURED, NAN), show(MEASURED, odd_range))


# --- the subscriber ----------------------------------------------------------------------------


@check(needs=["builds"])
def test_subscriber_runs(hearing: ExperimentView) -> None:
    """The subscriber starts, makes a node and runs on."""
    hearing.process(SUBSCRIBER).must(come_up, outlast_the_soak)


@check(needs=["subscriber_runs"])
def test_subscriber_name(hearing: ExperimentView) -> None:
    """The subscriber's node is called {SUBSCRIBER.node}."""
    hearing.node(SUBSCRIBER).must(be_named)


@check(needs=["subscriber_runs"])
def test_subscriber_topics(hearing: ExperimentView) -> None:
    """It hears {HEARD.topic}, and publishes {OBSTACLE.topic}."""
    hearing.subscription(SUBSCRIBER, HEARD).must(be_there, carry_its_type, match_qos)
    publisher = hearing.publisher(SUBSCRIBER, OBSTACLE)
    publisher.must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["subscriber_runs"])
def test_millimetres(hearing: ExperimentView) -> None:
    """It writes every distance in whole millimetres."""
    hearing.must(write_each(SUBSCRIBER, millimetres))


@check(needs=["subscriber_runs"])
def test_one_each(hearing: ExperimentView) -> None:
    """It publishes once for each distance, and at no other time."""
    hearing.must(answer_each_once(WARNED))


@check(needs=["subscriber_runs"], explained_by={"one_each": "MoreThanAsked"})
def test_obstacle(hearing: ExperimentView) -> None:
    """Nearer than {NEAR:g} m is an obstacle, farther than {CLEAR:g} m is none."""
    hearing.must(show(WARNED, lambda number, _: warning("obstacle", number)))


@check(needs=["obstacle"])
def test_hysteresis(hearing: ExperimentView) -> None:
    """Between {NEAR:g} m and {CLEAR:g} m the warning stays as it was."""
    hearing.must(show(WARNED, lambda number, _: warning("hysteresis", number)))


@check(needs=["obstacle"])
def test_odd_distances(hearing: ExperimentView) -> None:
    """NaN changes nothing; +infinity is free, -infinity an obstacle."""
    hearing.must(show(WARNED, lambda number, _: warning("odd", number)))


# --- both --------------------------------------------------------------------------------------


@check(needs=["sensor_runs", "subscriber_runs"])
def test_launch(together: ExperimentView, sensing: ExperimentView, hearing: ExperimentView) -> None:
    """`ros2 launch` with {LAUNCH.name} starts both nodes."""
    names = [sensing.node(SENSOR).near.found, hearing.node(SUBSCRIBER).near.found]
    together.must(start_all(names))


@check(needs=["sensor_runs", "subscriber_runs"])
def test_ends(sensing: ExperimentView, hearing: ExperimentView) -> None:
    """Both nodes end within {CARD.ends_within_s:g} s of Ctrl-C."""
    sensing.process(SENSOR).must(end_within(CARD.ends_within_s))
    hearing.process(SUBSCRIBER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(sensing: ExperimentView, hearing: ExperimentView) -> None:
    """After Ctrl-C both nodes end without an error."""
    sensing.process(SENSOR).must(stay_up, exit_cleanly)
    hearing.process(SUBSCRIBER).must(stay_up, exit_cleanly)
