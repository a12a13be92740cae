"""What counts as done in the lab "bring-up": two nodes with parameters, launched for two rovers.

The numbers, names and points stand in labs/bring-up/card.yaml. Experiments run the student's nodes
alone and by the launch file, set parameters, kill, and watch; checks read what was seen.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from roslings.capabilities.launch.act import (
    ask_for_arguments,
    kill_and_await,
    launched,
    values_file,
)
from roslings.capabilities.launch.contract import LaunchWords, NamespaceContract
from roslings.capabilities.launch.demands import (
    be_alike,
    come_back,
    end_as_a_whole,
    follow_the_argument,
    follow_the_file,
    give_its_values,
    leave_out,
    show_its_arguments,
    start_in_each_namespace,
    win_over_its_section,
)
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.parameters.obeying import (
    FIRST,
    act_by_its_values,
    beat_by_its_value,
    take_what_its_card_allows,
)
from roslings.capabilities.parameters.record import Values
from roslings.capabilities.parameters.setting import Setter, read_all, setting
from roslings.capabilities.topics.act import Teller
from roslings.capabilities.topics.demands import have_rate
from roslings.capabilities.topics.full import full_values
from roslings.capabilities.topics.relay import RelayedValue, answer_each_once, hold_its_fields
from roslings.course import lab
from roslings.course.contract import Plain
from roslings.course.files import written
from roslings.experiment import Scene, experiment
from roslings.experiment.timing import accounting
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
from roslings.judge.values import Fields, as_number, field_of, number_of

CARD = lab("bring-up").card
LIMITER, BEACON = CARD.node("speed_limiter"), CARD.node("beacon")
WANTED, ALLOWED = LIMITER.subscribes[0], LIMITER.publishes[0]
BEAT = BEACON.publishes[0]
MAX, SLOW, CAREFUL = LIMITER.of(ParameterWords).named("max_speed", "slow_speed", "careful")
NAME, RATE = BEACON.of(ParameterWords).named("rover_name", "beat_rate")
LAUNCH = written(CARD.of(LaunchWords).launch, "the package")
FILE, CAREFULLY, SECOND = LAUNCH.arguments
FORWARD_X = "linear.x"
OTHERS = ("linear.y", "linear.z", "angular.x", "angular.y", "angular.z")
FORWARD, BACKWARD, SLOWLY, SLOWLY_BACK = 2.0, -2.0, 0.07, -0.06
"""Metres a second: faster than any limit, both ways, and slower than the usual one."""

NO_NUMBER, ENDLESS = math.nan, math.inf
AT_FIRST = (FORWARD, BACKWARD, SLOWLY, SLOWLY_BACK, 0.0, ENDLESS, -ENDLESS, NO_NUMBER, SLOWLY)

SAID = [
    BEAT.model_copy(
        update={
            "topic": each.namespace + BEAT.topic,
            "fields": {"data": each.values[f"{BEACON.executable}.{NAME.name}"]},
        }
    )
    for each in LAUNCH.namespaces
]
"""What the beacons of the rovers say."""

LAUNCH_ENDS_S = 2 * CARD.ends_within_s
"""It ends after its last node, and has to see that."""

BEATS = 13
"""Messages to wait for at a new rate: enough to see that an old timer goes on beside it."""

FINE, MUCH = 0.01, 4.0
"""So far beside a limit is a value that is just refused, and one that is refused beyond doubt."""


# --- what is set, and what is right ------------------------------------------------------------


@dataclass(frozen=True)
class ParameterRequest:
    """One request to set parameters, and the check that it is for."""

    part: str
    values: dict[str, Plain]

    def carry_out(self, setter: Setter) -> None:
        """One parameter by itself, several at once."""
        if len(self.values) > 1:
            setter.set_together(self.part, self.values)
        for name, value in self.values.items() if len(self.values) == 1 else ():
            setter.set_one(self.part, name, value)


def steps() -> list[ParameterRequest]:
    """All requests to the limiter; each begins where the one before has ended.

    A value of the other parameter is chosen so that only one rule of the card speaks.
    """
    m, s, c = MAX.name, SLOW.name, CAREFUL.name
    least, most = float(MAX.least or 0), float(MAX.most or 0)
    slowest, top = float(SLOW.least or 0), float(SLOW.most or 0)
    return [
        ParameterRequest("live", {m: MAX.tried}),
        ParameterRequest("live", {c: CAREFUL.tried}),
        ParameterRequest("live", {s: SLOW.tried}),
        ParameterRequest("live", {c: CAREFUL.default}),
        ParameterRequest("ranges", {s: top}),
        ParameterRequest("ranges", {s: round(top + FINE, 3)}),
        ParameterRequest("ranges", {m: most}),
        ParameterRequest("ranges", {m: round(most + FINE, 3)}),
        ParameterRequest("ranges", {s: slowest}),
        ParameterRequest("ranges", {s: round(slowest - FINE, 3)}),
        ParameterRequest("ranges", {m: least}),
        ParameterRequest("ranges", {m: round(least - FINE, 3)}),
        ParameterRequest("ranges", {m: ENDLESS}),
        ParameterRequest("ranges", {s: NO_NUMBER}),
        ParameterRequest("ranges", {m: NO_NUMBER}),
        ParameterRequest("ranges", {m: most}),
        ParameterRequest("types", {m: 1}),
        ParameterRequest("types", {m: "fast"}),
        ParameterRequest("types", {c: "yes"}),
        ParameterRequest("rule", {m: 0.6}),
        ParameterRequest("rule", {s: 0.4}),
        ParameterRequest("rule", {m: 0.3}),
        ParameterRequest("rule", {m: 0.4}),
        ParameterRequest("rule", {s: 0.45}),
        ParameterRequest("together", {s: 0.45, m: 0.9}),
        ParameterRequest("together", {m: 0.15, s: 0.12}),
        ParameterRequest("together", {c: False, m: 0.2}),
        ParameterRequest("atomic", {c: True, m: most + MUCH}),
        ParameterRequest("atomic", {m: 0.7, s: top + MUCH}),
        ParameterRequest("atomic", {c: True, s: 0.3}),
        ParameterRequest("atomic", {m: 0.3, s: 0.4}),
    ]


def limited(values: Values, command: Fields) -> float | None:
    """The speed that the limiter's parameters allow, as it says them itself."""
    limit = values.get(SLOW.name if values.get(CAREFUL.name) else MAX.name)
    if isinstance(limit, bool | str) or limit is None or not math.isfinite(limit):
        return None
    speed = number_of(command, FORWARD_X)
    return 0.0 if math.isnan(speed) else float(max(-limit, min(speed, limit)))


def relayed(field: str) -> RelayedValue:
    """A field of the command, on its way through the limiter."""
    return RelayedValue(LIMITER, field, ALLOWED, field)


SPEED = relayed(FORWARD_X)


def unchanged(place: RelayedValue) -> Callable[[Values, Fields], float]:
    """What the limiter only passes on; a field that nobody filled is 0."""
    return lambda values, command: as_number(field_of(command, place.heard)) or 0.0


def command(scene: Scene, speed: float) -> dict[str, float]:
    """A command with a number in each other field that nobody can know."""
    others = full_values(WANTED.type, scene.between, begins_below_zero=speed < 0)
    return {**others, FORWARD_X: speed}


def other_values(scene: Scene) -> dict[str, Plain]:
    """Values that no file of the student's can have."""
    return {
        f"{LIMITER.executable}.{MAX.name}": scene.between(0.6, 0.9),
        f"{LIMITER.executable}.{SLOW.name}": scene.between(0.2, 0.4),
        f"{BEACON.executable}.{NAME.name}": scene.sentence().partition(" ")[0],
        f"{BEACON.executable}.{RATE.name}": round(scene.between(11, 40)),
    }


def launch_against_a_file(
    scene: Scene, careful: str, named: NamespaceContract, values: dict[str, Plain]
) -> None:
    """Launch both rovers with a file that says the opposite of the argument, and read what holds.

    The file says so to all nodes, and then once more to one of them by its full name. So one rover
    shows whether the argument wins over the first, and the other one whether over both.
    """
    opposite = CAREFUL.default if careful == CAREFULLY.tried else CAREFUL.tried
    for_all = {**values, f"{LIMITER.executable}.{CAREFUL.name}": opposite}
    by_name = {named.namespace + LIMITER.node: {CAREFUL.name: opposite}}
    given = {FILE.name: str(values_file(scene, for_all, by_name)), CAREFULLY.name: careful}
    with launched(scene, CARD.package, LAUNCH, given):
        read_all(scene)


# --- experiments: run the nodes, alone and by the launch file ----------------------------------


@experiment
def limiting(scene: Scene) -> None:
    """The limiter alone, while somebody drives, and sets its parameters."""
    with scene.run(LIMITER) as process, setting(scene, process, LIMITER) as setter:
        list_parameters(scene, LIMITER)
        teller = Teller(scene, process, WANTED, ALLOWED)
        for speed in AT_FIRST:
            teller.tell(command(scene, speed))
        if setter is None:
            return
        for number, step in enumerate(steps()):
            step.carry_out(setter)
            teller.tell(command(scene, BACKWARD if number % 2 else FORWARD))


@experiment(clock="auto")
def beating(scene: Scene) -> None:
    """The beacon alone, until its rate is sure."""
    with scene.run(BEACON):
        scene.watch(BEAT)


@experiment
def retuning(scene: Scene) -> None:
    """The beacon alone, while somebody sets its parameters."""
    with scene.run(BEACON) as process, setting(scene, process, BEACON) as setter:
        list_parameters(scene, BEACON)
        scene.hear(BEAT)
        if setter is None:
            return
        _change_pace(scene, setter)
        least, most = RATE.ends
        for value in (most, most + 1, least, least - 1, 7.5, RATE.default):
            setter.set_one("beat", RATE.name, value)
        _change_pace(scene, setter)  # a later one is obeyed as the first one
        setter.set_one("name", NAME.name, NAME.tried)
        scene.hear(BEAT, count=scene.heard(BEAT) + 2)


def _change_pace(scene: Scene, setter: Setter) -> None:
    with accounting(scene, "pace"):
        setter.set_one("pace", RATE.name, RATE.tried)
        scene.hear(BEAT, count=scene.heard(BEAT) + BEATS)


@experiment
def brought_up(scene: Scene) -> None:
    """Both rovers, by the launch file alone."""
    with launched(scene, CARD.package, LAUNCH):
        read_all(scene)
        for beat in SAID:
            scene.hear(beat)


@experiment
def otherwise(scene: Scene) -> None:
    """Both rovers, with another file, and carefully."""
    launch_against_a_file(scene, CAREFULLY.tried, LAUNCH.namespaces[-1], other_values(scene))


@experiment
def carelessly(scene: Scene) -> None:
    """Both rovers, with a file that tells them to be careful, and an argument that does not."""
    launch_against_a_file(scene, CAREFULLY.default, LAUNCH.namespaces[0], {})


@experiment
def one_rover(scene: Scene) -> None:
    """One rover alone; its limiter is killed."""
    left = [each.namespace for each in LAUNCH.namespaces if each.only_with != SECOND.name]
    with launched(scene, CARD.package, LAUNCH, {SECOND.name: SECOND.tried}, left) as process:
        respawned = [CARD.node(each) for each in LAUNCH.respawns]
        kill_and_await(scene, process, CARD.package, respawned)


@experiment
def asked(scene: Scene) -> None:
    """The launch file, asked for its arguments."""
    ask_for_arguments(scene, CARD.package, LAUNCH)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, with {LIMITER.executable} and {BEACON.executable}."""
    package.must(be_built_as(CARD.build_type), install([LIMITER.executable, BEACON.executable]))


# --- the limiter -------------------------------------------------------------------------------

NO_PARAMETER = ("NoParameter", "WrongParameterType")


@check(needs=["builds"])
def test_limiter_runs(limiting: ExperimentView) -> None:
    """The limiter starts, makes a node and runs on."""
    limiting.process(LIMITER).must(come_up, outlast_the_soak)


@check(needs=["limiter_runs"])
def test_limiter_name(limiting: ExperimentView) -> None:
    """The limiter's node is called {LIMITER.node}."""
    limiting.node(LIMITER).must(be_named)


@check(needs=["limiter_runs"])
def test_limiter_topics(limiting: ExperimentView) -> None:
    """It hears {WANTED.topic}, and publishes {ALLOWED.topic}."""
    limiting.subscription(LIMITER, WANTED).must(be_there, carry_its_type, match_qos)
    publisher = limiting.publisher(LIMITER, ALLOWED)
    publisher.must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["limiter_runs"])
def test_limiter_parameters(limiting: ExperimentView) -> None:
    """The limiter has the parameters of the card: names, types, defaults."""
    limiting.must(declare_its_parameters(LIMITER))


@check(needs=["limiter_topics"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_limits(limiting: ExperimentView) -> None:
    """With the defaults, it cuts the speed to {MAX.default} m/s, both ways."""
    limiting.must(
        act_by_its_values(SPEED, FIRST, limited),
        *(act_by_its_values(each, FIRST, unchanged(each)) for each in map(relayed, OTHERS)),
        answer_each_once(SPEED),
    )


@check(needs=["limits"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_live(limiting: ExperimentView) -> None:
    """A parameter that is set while it runs acts at once."""
    limiting.must(take_what_its_card_allows(LIMITER, "live"))
    limiting.must(act_by_its_values(SPEED, "live", limited))


@check(needs=["limiter_runs"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_ranges(limiting: ExperimentView) -> None:
    """{MAX.name} is {MAX.span}, {SLOW.name} {SLOW.span}; all else is refused."""
    limiting.must(take_what_its_card_allows(LIMITER, "ranges"))


@check(needs=["limiter_runs"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_types(limiting: ExperimentView) -> None:
    """A value of another type is refused."""
    limiting.must(take_what_its_card_allows(LIMITER, "types"))


@check(needs=["limiter_runs"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_rule(limiting: ExperimentView) -> None:
    """{SLOW.name} is never above {MAX.name}, whichever of them is set."""
    limiting.must(take_what_its_card_allows(LIMITER, "rule"))


@check(needs=["rule"], explained_by={"limiter_parameters": NO_PARAMETER})
def test_together(limiting: ExperimentView) -> None:
    """Two values that only fit together can be set at once."""
    limiting.must(take_what_its_card_allows(LIMITER, "together"))


@check(needs=["live", "ranges", "together"])
def test_atomic(limiting: ExperimentView) -> None:
    """When one of two values is wrong, neither is set, and nothing changes."""
    limiting.must(take_what_its_card_allows(LIMITER, "atomic"))
    for part in ("ranges", "types", "rule", "together", "atomic"):
        limiting.must(act_by_its_values(SPEED, part, limited))


# --- the beacon --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_beacon_runs(beating: ExperimentView) -> None:
    """The beacon starts, makes a node and runs on."""
    beating.process(BEACON).must(come_up, outlast_the_soak)


@check(needs=["beacon_runs"])
def test_beacon_name(beating: ExperimentView) -> None:
    """The beacon's node is called {BEACON.node}."""
    beating.node(BEACON).must(be_named)


@check(needs=["beacon_runs"])
def test_beacon_topic(beating: ExperimentView) -> None:
    """It publishes its name on {BEAT.topic}, {BEAT.type}."""
    beating.publisher(BEACON, BEAT).must(be_there, be_the_only_one, carry_its_type, match_qos)
    beating.topic(BEAT).must(hold_its_fields)


@check(needs=["beacon_runs"])
def test_beacon_parameters(retuning: ExperimentView) -> None:
    """The beacon has the parameters of the card: names, types, defaults."""
    retuning.must(declare_its_parameters(BEACON))


@check(needs=["beacon_runs"], explained_by={"beacon_parameters": "WrongDefault"})
def test_rate(beating: ExperimentView) -> None:
    """It publishes at {BEAT.rate.hz:g} Hz."""
    beating.topic(BEAT).must(have_rate(BEAT))


@check(needs=["rate"], explained_by={"beacon_parameters": NO_PARAMETER})
def test_beat_rate(retuning: ExperimentView) -> None:
    """{RATE.name} acts while it runs; it is {RATE.span}, all else is refused."""
    retuning.must(take_what_its_card_allows(BEACON, "pace"))
    retuning.must(beat_by_its_value(BEAT, RATE.name, "pace"))
    retuning.must(take_what_its_card_allows(BEACON, "beat"))


@check(needs=["beacon_runs"], explained_by={"beacon_parameters": NO_PARAMETER})
def test_read_only(retuning: ExperimentView) -> None:
    """{NAME.name} is chosen at the start: nobody can change it later."""
    retuning.must(take_what_its_card_allows(BEACON, "name"))


# --- the launch file ---------------------------------------------------------------------------

BOTH = ["limiter_runs", "beacon_runs"]
NO_PARAMETERS = {"limiter_parameters": NO_PARAMETER, "beacon_parameters": NO_PARAMETER}
HANGS = {"limiter_topics": "NoTopic", "rate": "NoMessages"}
"""A node that hangs gives no answer in a launch, either."""


@check(needs=BOTH, explained_by=NO_PARAMETERS)
def test_launch(
    brought_up: ExperimentView, limiting: ExperimentView, beating: ExperimentView
) -> None:
    """`ros2 launch` with {LAUNCH.name} starts both nodes in each namespace."""
    limiter = LIMITER.node, limiting.node(LIMITER).near.found
    beacon = BEACON.node, beating.node(BEACON).near.found
    brought_up.must(start_in_each_namespace(LAUNCH, limiter, beacon))


@check(needs=["launch"])
def test_alike(brought_up: ExperimentView, otherwise: ExperimentView) -> None:
    """The graph is the same in each namespace, and no topic lies outside."""
    brought_up.must(be_alike(LAUNCH, otherwise))


@check(
    needs=["launch"],
    explained_by={
        **NO_PARAMETERS,
        **HANGS,
        "limiter_name": "WrongNodeName",
        "beacon_name": "WrongNodeName",
        "beacon_topic": ("WrongField", "WrongTopic"),
        "alike": ("TopicOutside", "NamespacesDiffer"),
    },
)
def test_values(brought_up: ExperimentView) -> None:
    """After the launch, each parameter is what the card says for its namespace."""
    brought_up.must(give_its_values(LAUNCH, CARD.node))
    for topic in map(brought_up.topic, SAID):
        if topic.name == topic.contract.topic:  # else another check has told so
            topic.must(hold_its_fields)


@check(needs=["builds"], explained_by={"launch": "LaunchFailed"})
def test_arguments(asked: ExperimentView) -> None:
    """`--show-args` tells the arguments of the card, with their defaults."""
    asked.must(show_its_arguments(LAUNCH))


@check(
    needs=["launch"],
    explained_by={
        **NO_PARAMETERS,
        **HANGS,
        "arguments": "WrongArguments",
        "values": "WrongValueAfterLaunch",
    },
)
def test_params_file(otherwise: ExperimentView) -> None:
    """The argument {FILE.name} chooses another file with values."""
    otherwise.must(follow_the_file(LAUNCH, CARD.node))


@check(needs=["launch"], explained_by={**NO_PARAMETERS, **HANGS, "arguments": "WrongArguments"})
def test_careful(
    brought_up: ExperimentView, otherwise: ExperimentView, carelessly: ExperimentView
) -> None:
    """The argument {CAREFULLY.name} wins over the file, in each namespace."""
    for demand in (follow_the_argument, win_over_its_section):
        for launch in (brought_up, otherwise, carelessly):
            launch.must(demand(LAUNCH, CAREFULLY, CARD.node))


@check(needs=["launch"], explained_by={"arguments": "WrongArguments"})
def test_one_rover(one_rover: ExperimentView) -> None:
    """With {SECOND.name}:={SECOND.tried}, the second rover is not started."""
    one_rover.must(leave_out(LAUNCH, SECOND.name))


@check(
    needs=["launch"],
    explained_by={**NO_PARAMETERS, **HANGS, "one_rover": ("LaunchFailed", "LaunchMissesNode")},
)
def test_respawn(one_rover: ExperimentView) -> None:
    """A limiter that was killed is back within {LAUNCH.respawns_within_s:g} s."""
    one_rover.must(come_back(LAUNCH))


# --- the end -----------------------------------------------------------------------------------


@check(needs=BOTH)
def test_ends(limiting: ExperimentView, beating: ExperimentView) -> None:
    """Both nodes end within {CARD.ends_within_s:g} s of Ctrl-C."""
    limiting.process(LIMITER).must(end_within(CARD.ends_within_s))
    beating.process(BEACON).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(limiting: ExperimentView, beating: ExperimentView) -> None:
    """After Ctrl-C both nodes end without an error."""
    limiting.process(LIMITER).must(stay_up, exit_cleanly)
    beating.process(BEACON).must(stay_up, exit_cleanly)


@check(needs=["launch", "ends"])
def test_launch_ends(brought_up: ExperimentView) -> None:
    """Ctrl-C ends a launch within {LAUNCH_ENDS_S:g} s, and nothing is left of it."""
    brought_up.must(end_as_a_whole(LAUNCH_ENDS_S))
