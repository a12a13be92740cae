"""What counts as done in the lab "serial-bridge": a node between ROS and the rover's board.

The numbers, names and points stand in labs/serial-bridge/card.yaml. Experiments run the student's
node beside a board and watch both; checks read what was seen and run nothing.
"""

from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.serial.act import board_beside, unasked
from roslings.capabilities.serial.demands import (
    come_back,
    come_so_far,
    drive_again,
    drive_as_told,
    drive_at_most,
    drive_by_its_settings,
    hold_its_fields,
    keep_still,
    know_the_way,
    open_its_port,
    outlast_silence,
    reckon_by_its_settings,
    send_good_lines,
    set_its_speed,
    stand_until_told,
    stop_by_itself,
    tell_every_line,
    tell_nothing_else,
    tell_the_motion,
    tell_the_speeds,
)
from roslings.capabilities.topics.relay import leave_at_zero
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
    during,
    end_within,
    exit_cleanly,
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)
from roslings_rover.rover import Body

CARD = lab("serial-bridge").card
BRIDGE = CARD.node("serial_bridge")
PORT, BAUD, FASTEST = BRIDGE.of(ParameterWords).named("port", "baud", "max_wheel_speed")
MEASURES = BRIDGE.of(ParameterWords).named("wheel_radius", "wheel_separation")
WHEELS, ODOM = BRIDGE.publishes
ON_THE_FLOOR = (
    "pose.pose.position.x",
    "pose.pose.position.y",
    "pose.pose.orientation",
    "twist.twist.linear.x",
    "twist.twist.angular.z",
)
"""A rover neither rises nor tilts, and its wheels do not go sideways."""

CMD_VEL = BRIDGE.subscribes[0]
STRAIGHT, TURN, ARC = (0.3, 0.0), (0.0, 1.2), (0.25, -0.4)
"""The motions of the test drive: metres a second forward, radians a second to the left."""

DRIVE = {"straight": STRAIGHT, "turn": TURN, "arc": ARC}
LASTS_S = {"straight": 1.5, "turn": 0.5, "arc": 1.5}
"""The arc begins 65 degrees to the left and ends 20: as far along x as along y.

Who reckons wrongly with either of the two is found far from where the rover is.
"""
TOO_FAST = {"backward": (-2.0, 0.0), "round": (0.0, 12.0)}
"""Motions for which both wheels would have to turn faster than they can."""

SILENCE_S = 30.0
LOOKS_WITHIN_S = 3.0
"""Seconds of its own until a node works that waits for nothing; one that waits gets no more."""

PULLED = {"came back": "the cable was pulled and put back"} | {
    f"came back {n}": f"the cable was pulled and put back {n} times" for n in range(2, 6)
}
"""What is marked when the board came back, and after what."""


def rover(**given: object) -> Body:
    """The rover that the parameters describe: those given, and the defaults of the others."""
    radius, separation, fastest = (
        float(str(given.get(each.name, each.default))) for each in (*MEASURES, FASTEST)
    )
    return Body(radius, separation, fastest_wheel_rad_s=fastest)


SETTINGS = {each.name: each.tried for each in (BAUD, *MEASURES, FASTEST)}
USUAL, OTHER = rover(), rover(**SETTINGS)
WITHOUT = {
    each.name: rover(**{**SETTINGS, each.name: each.default}) for each in (*MEASURES, FASTEST)
}
"""Parameter's name to the rover that a node has in mind which does not read this parameter."""


# --- experiments: run the node beside a board --------------------------------------------------


@experiment
def driving(scene: Scene) -> None:
    """A drive: straight on, a turn on the spot, an arc."""
    with board_beside(scene, body=USUAL) as cable, scene.run(BRIDGE, start=cable.start()):
        cable.begin(ODOM)
        list_parameters(scene, BRIDGE)
        for part, motion in DRIVE.items():
            cable.drive(f"{part}, driving", CMD_VEL, *motion, for_s=LASTS_S[part])
            cable.rest(part, ODOM)
        cable.flood(CMD_VEL, [(n / 200 - 0.3, 0.0) for n in range(100)])
        cable.drive("after many", CMD_VEL, *STRAIGHT, for_s=0.4)


@experiment
def noisy(scene: Scene) -> None:
    """A bad cable: noise, half lines, wrong checksums."""
    with board_beside(scene) as cable, scene.run(BRIDGE, start=cable.start()):
        cable.await_messages(WHEELS, 10)
        spoiler = cable.board.to_host
        spoiler.noise, spoiler.half_lines, spoiler.wrong_checksums = 0.01, 0.2, 0.2
        cable.drive("noise", CMD_VEL, *ARC, for_s=3.0)
        spoiler.noise = spoiler.half_lines = spoiler.wrong_checksums = 0.0
        cable.mark("good again")
        cable.await_messages(WHEELS, 20)


@experiment
def silent(scene: Scene) -> None:
    """Half a minute in which the board says nothing."""
    with board_beside(scene) as cable, scene.run(BRIDGE, start=cable.start()):
        if not cable.await_messages(WHEELS, 10):
            return
        cable.board.to_host.silent = True
        cable.live(for_s=SILENCE_S)
        cable.board.to_host.silent = False
        cable.mark("speaks again")
        cable.await_messages(WHEELS, 20)


@experiment
def unplugged(scene: Scene) -> None:
    """The board comes late, its cable is pulled, and comes back, again and again."""
    with (
        board_beside(scene, plugged_in=False) as cable,
        scene.run(BRIDGE, start=cable.start()),
    ):
        scene.turned(BRIDGE.node, LOOKS_WITHIN_S)  # so it has looked for its board, and found none
        cable.live(for_s=0.5)
        cable.board.plug_in()
        if not cable.await_return("came late", WHEELS, 10):
            return
        for part in PULLED:
            cable.board.unplug()
            cable.live(for_s=1.0)
            cable.board.plug_in()
            if not cable.await_return(part, WHEELS, 10):
                return


@experiment
def otherwise(scene: Scene) -> None:
    """Another rover on a slower cable, as the parameters say; too fast; and no numbers at all."""
    with (
        board_beside(scene, body=OTHER, bits_s=int(BAUD.tried)) as cable,
        scene.run(BRIDGE, start=cable.start(SETTINGS)),
    ):
        cable.begin(ODOM)
        for part in ("straight", "turn"):
            cable.drive(f"{part}, driving", CMD_VEL, *DRIVE[part], for_s=0.8)
            cable.rest(part, ODOM)
        for part, motion in TOO_FAST.items():
            cable.drive(part, CMD_VEL, *motion, for_s=0.5)
        cable.rest("too fast", ODOM)
        cable.say_nonsense("nonsense", CMD_VEL)
        cable.drive("after nonsense", CMD_VEL, *STRAIGHT, for_s=0.5)


@experiment
def unset(scene: Scene) -> None:
    """The node with no word about its parameters."""
    with scene.run(BRIDGE, start=unasked(scene, PORT)):
        list_parameters(scene, BRIDGE)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {BRIDGE.executable}."""
    package.must(be_built_as(CARD.build_type), install([BRIDGE.executable]))


# --- the node ----------------------------------------------------------------------------------


@check(needs=["builds"])
def test_runs(driving: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    driving.process(BRIDGE).must(come_up, stay_up, outlast_the_soak)


@check(needs=["runs"])
def test_name(driving: ExperimentView) -> None:
    """The node is called {BRIDGE.node}."""
    driving.node(BRIDGE).must(be_named)


@check(needs=["runs"])
def test_parameters(driving: ExperimentView) -> None:
    """It has the parameters of the card, with their types and defaults."""
    driving.must(declare_its_parameters(BRIDGE))


@check(needs=["parameters"])
def test_default_port(unset: ExperimentView) -> None:
    """With no word about it, the port is {PORT.default}."""
    unset.must(declare_its_parameters(BRIDGE))


@check(needs=["runs"], explained_by={"parameters": "NoParameter"})
def test_port(driving: ExperimentView) -> None:
    """It opens the port that its parameter {PORT.name} names."""
    driving.must(open_its_port(PORT.name, WHEELS))


@check(needs=["port", "parameters"])
def test_baud(driving: ExperimentView, otherwise: ExperimentView) -> None:
    """It opens the port with the speed that its parameter {BAUD.name} says."""
    driving.must(set_its_speed(BAUD.name, int(BAUD.default)))
    otherwise.must(set_its_speed(BAUD.name, int(BAUD.tried)))


@check(needs=["runs"])
def test_wheel_topic(driving: ExperimentView) -> None:
    """It publishes {WHEELS.type} on {WHEELS.topic}."""
    driving.publisher(BRIDGE, WHEELS).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["runs"])
def test_odom_topic(driving: ExperimentView) -> None:
    """It publishes {ODOM.type} on {ODOM.topic}."""
    driving.publisher(BRIDGE, ODOM).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["runs"])
def test_cmd_topic(driving: ExperimentView) -> None:
    """It subscribes to {CMD_VEL.topic} ({CMD_VEL.type})."""
    driving.subscription(BRIDGE, CMD_VEL).must(be_there, carry_its_type, match_qos)


# --- from ROS to the board ---------------------------------------------------------------------


@check(needs=["cmd_topic", "port"])
def test_checksums(driving: ExperimentView) -> None:
    """The board can use every line of the node."""
    driving.must(send_good_lines)


@check(needs=["cmd_topic", "checksums"])
def test_drives(driving: ExperimentView) -> None:
    """The motors do what {CMD_VEL.topic} says."""
    driving.must(
        *(drive_as_told(f"{part}, driving", *motion, USUAL) for part, motion in DRIVE.items()),
        drive_as_told("after many", *STRAIGHT, USUAL),
    )


@check(needs=["cmd_topic", "checksums"])
def test_stops(driving: ExperimentView) -> None:
    """The motors stop when no command comes any more, and do not run before the first one."""
    driving.must(stand_until_told("start"), stop_by_itself("straight, driving"))


# --- from the board to ROS ---------------------------------------------------------------------


@check(needs=["wheel_topic", "port"])
def test_every_line(driving: ExperimentView) -> None:
    """Each line of wheel speeds becomes one message on {WHEELS.topic}."""
    driving.topic(WHEELS).must(tell_every_line(driving))


@check(needs=["odom_topic", "port"], explained_by={"every_line": "LinesAndMessagesDiffer"})
def test_every_place(driving: ExperimentView) -> None:
    """Each line of wheel speeds becomes one message on {ODOM.topic}, too."""
    driving.topic(ODOM).must(tell_every_line(driving))


@check(needs=["every_line", "parameters"])
def test_pieces(otherwise: ExperimentView) -> None:
    """On a slow cable lines come in pieces: none is lost."""
    otherwise.process(BRIDGE).must(during("with other values of its parameters", come_up))
    otherwise.topic(WHEELS).must(tell_every_line(otherwise))


@check(needs=["wheel_topic", "port"])
def test_wheel_speeds(driving: ExperimentView) -> None:
    """The messages carry the board's wheel speeds, left and right, in rad/s."""
    driving.topic(WHEELS).must(tell_the_speeds(driving))


@check(needs=["wheel_topic", "odom_topic", "port"])
def test_frames(driving: ExperimentView) -> None:
    """The messages name the wheels and the frames as the card does."""
    driving.topic(WHEELS).must(hold_its_fields(WHEELS))
    driving.topic(ODOM).must(hold_its_fields(ODOM))


@check(needs=["odom_topic", "every_line"])
def test_straight(driving: ExperimentView) -> None:
    """Straight on: {ODOM.topic} says how far the rover went."""
    driving.topic(ODOM).must(know_the_way(driving, "start", "straight"))


@check(needs=["odom_topic", "every_line"])
def test_turn(driving: ExperimentView) -> None:
    """A turn on the spot: {ODOM.topic} says how far the rover turned."""
    driving.topic(ODOM).must(know_the_way(driving, "straight", "turn"))


@check(needs=["straight", "turn"])
def test_arc(driving: ExperimentView) -> None:
    """An arc: {ODOM.topic} says where the rover is, and how fast it moves."""
    driving.topic(ODOM).must(
        know_the_way(driving, "turn", "arc"), tell_the_motion(driving, "arc, driving", USUAL)
    )
    driving.topic(ODOM).must(leave_at_zero(*ON_THE_FLOOR))


# --- another rover -----------------------------------------------------------------------------


@check(needs=["drives", "straight", "turn", "pieces"])
def test_settings(otherwise: ExperimentView) -> None:
    """With other wheels and motors, it drives and reckons by its parameters."""
    for part in ("straight", "turn"):
        otherwise.must(drive_by_its_settings(f"{part}, driving", *DRIVE[part], OTHER, WITHOUT))
    known = {each.name: each.tried for each in MEASURES}
    for before, after in (("start", "straight"), ("straight", "turn")):
        otherwise.topic(ODOM).must(reckon_by_its_settings(otherwise, before, after, known))


@check(needs=["drives", "parameters"])
def test_too_fast(otherwise: ExperimentView) -> None:
    """A command that is too fast for the wheels gets full PWM, 255, and no more."""
    otherwise.must(*(drive_at_most(part, *motion) for part, motion in TOO_FAST.items()))


# --- when something is wrong -------------------------------------------------------------------


@check(needs=["wheel_speeds"])
def test_bad_lines(noisy: ExperimentView) -> None:
    """On a noisy cable, no wrong line becomes a message."""
    noisy.process(BRIDGE).must(during("on a noisy cable", stay_up))
    noisy.topic(WHEELS).must(tell_nothing_else(noisy))


@check(needs=["wheel_topic", "port"])
def test_silence(silent: ExperimentView) -> None:
    """When the board was silent for {SILENCE_S:g} s, the node goes on with its next line."""
    silent.process(BRIDGE).must(during("beside a silent board", come_up, stay_up))
    silent.topic(WHEELS).must(outlast_silence(silent, "speaks again", SILENCE_S))


@check(needs=["wheel_topic", "port"], explained_by={"pieces": "LinesAndMessagesDiffer"})
def test_reconnects(unplugged: ExperimentView) -> None:
    """The node waits for its board, and finds it again when its cable was pulled."""
    unplugged.process(BRIDGE).must(
        during("with no board at the start", come_up),
        during("when the cable is pulled and comes back", stay_up),
    )
    unplugged.must(come_back("came late", "a start without a board", WHEELS))
    unplugged.must(*(come_back(part, after, WHEELS) for part, after in PULLED.items()))


@check(needs=["cmd_topic", "checksums"], explained_by={"drives": "DoesNotDrive"})
def test_not_a_number(otherwise: ExperimentView) -> None:
    """A command with NaN or infinity moves nothing, and the next one counts again."""
    otherwise.must(come_so_far("nonsense"))
    otherwise.process(BRIDGE).must(during("after a command with NaN or infinity", stay_up))
    otherwise.must(keep_still("nonsense"), drive_again("after nonsense", "nonsense"))


@check(needs=["runs"])
def test_ends(driving: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    driving.process(BRIDGE).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(driving: ExperimentView) -> None:
    """After Ctrl-C the node ends without an error."""
    driving.process(BRIDGE).must(exit_cleanly)
