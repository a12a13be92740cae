"""What counts as done in the lab "actions": a server that drives the rover to a point, a client.

The names, numbers, texts and points stand in labs/actions/card.yaml. Experiments run the
student's nodes, beside a rover of the grader's own; checks read what was seen and run nothing.
"""

import math

from graders.actions.act import Director
from graders.actions.demands import (
    accept,
    accept_again,
    arrive,
    cancel_each,
    cancel_in_time,
    hear_meanwhile,
    keep_to_the_first,
    refuse_each,
    rest_in_each_turn,
    stop_in_time,
    succeed,
    tell_at_its_rate,
    tell_the_truth,
    trip,
)
from graders.actions.floor import robot_beside, start_near
from roslings.capabilities.actions.act import (
    await_action,
    await_client,
    lead,
    taking,
    timed_feedback,
)
from roslings.capabilities.actions.contract import ActionWords
from roslings.capabilities.actions.demands import (
    end_so,
    give_up,
    perform,
    perform_its_type,
    send_goal,
    show_each,
)
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.topics.relay import leave_at_zero
from roslings.course import lab
from roslings.course.files import written
from roslings.experiment import Scene, experiment
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
    match_qos,
    outlast_the_soak,
    well_formed,
)

CARD = lab("actions").card
SERVER, CLIENT = CARD.node("drive_server"), CARD.node("drive_client")
CMD_VEL, ODOM = SERVER.publishes[0], SERVER.subscribes[0]
DRIVE_TO, ORDER = SERVER.of(ActionWords).performs[0], CLIENT.of(ActionWords).orders[0]
FEEDBACK = written(DRIVE_TO.feedback, DRIVE_TO.action)
CANCELS_WITHIN_S = written(DRIVE_TO.cancels_within_s, DRIVE_TO.action)
GIVES_UP = written(CLIENT.gives_up, CLIENT.node)
GOAL = DRIVE_TO.goal
CENTRE = {"x": 3.0, "y": 2.5, "tolerance": 0.1}
SETTINGS = CLIENT.of(ParameterWords).parameters
ASKED = {parameter.name: float(parameter.tried) for parameter in SETTINGS}
USUAL = {parameter.name: float(parameter.default) for parameter in SETTINGS}
TELLS = ("1.87", "1.71", "1.52", "1.38", "1.23", "0.95", "0.64", "0.41", "0.26", "0.12")
ELAPSED_S = 7.268
MORE_DIGITS = 0.0013
"""What the client is told has more digits than it is to write."""

WEST, EAST = SERVER.constant("west"), SERVER.constant("east")
SOUTH, NORTH = SERVER.constant("south"), SERVER.constant("north")
OUTSIDE_M = 0.02
OUTSIDE = "it lies outside of the map"
IMPOSSIBLE = {
    "too far east": ({"x": EAST + OUTSIDE_M}, OUTSIDE),
    "too far west": ({"x": WEST - OUTSIDE_M}, OUTSIDE),
    "too far north": ({"y": NORTH + OUTSIDE_M}, OUTSIDE),
    "too far south": ({"y": SOUTH - OUTSIDE_M}, OUTSIDE),
    "x is nan": ({"x": math.nan}, "x is no number"),
    "y is nan": ({"y": math.nan}, "y is no number"),
    "x is infinite": ({"x": -math.inf}, OUTSIDE),
    "y is infinite": ({"y": math.inf}, OUTSIDE),
    "tolerance is 0": ({"tolerance": 0.0}, "no robot stops at the very point"),
    "tolerance below 0": ({"tolerance": -0.1}, "a tolerance is more than 0"),
    "tolerance is nan": ({"tolerance": math.nan}, "the tolerance is no number"),
    "tolerance is infinite": ({"tolerance": math.inf}, "a robot is always so near"),
}
OF_RESULTS = {"result": ("WrongResult", "WrongEnd", "SucceedForgotten")}
"""What goes wrong at each goal is told at the first."""

NODES = [SERVER.executable, CLIENT.executable]
IN_A_ROW = [f"{n} in a row" for n in range(1, 11)]
"""Goals that are cancelled at once, one after the other."""


# --- experiments: the server, with a rover -----------------------------------------------------


def goal_near(scene: Scene, x: float, y: float, nearest_m: float) -> dict[str, float]:
    """A goal that nobody can know before, with a tolerance of its own."""
    pose = start_near(scene, x, y, nearest_m, nearest_m + 0.2)
    return {"x": round(pose.x_m, 2), "y": round(pose.y_m, 2), "tolerance": scene.between(0.08, 0.2)}


@experiment
def driving(scene: Scene) -> None:
    """The server drives a rover to one goal, and to the next."""
    start = start_near(scene, GOAL["x"], GOAL["y"], 1.0, 1.3)
    with scene.run(SERVER) as process, robot_beside(scene, start, CMD_VEL, ODOM) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        with timed_feedback(scene, DRIVE_TO):
            director.drive("first", GOAL)
        director.drive("next", goal_near(scene, GOAL["x"], GOAL["y"], 0.6))


@experiment
def cancelling(scene: Scene) -> None:
    """The server's goal is cancelled on the way; then it gets another one."""
    start = start_near(scene, CENTRE["x"], CENTRE["y"], 3.2, 3.6)
    with scene.run(SERVER) as process, robot_beside(scene, start, CMD_VEL, ODOM) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        director.cancel("cancelled", CENTRE, after_m=0.25)
        director.drive("after", goal_near(scene, robot.pose.x_m, robot.pose.y_m, 0.5))


@experiment
def refusing(scene: Scene) -> None:
    """The server gets goals that it cannot reach, and two at once."""
    start = start_near(scene, CENTRE["x"], CENTRE["y"], 0.9, 1.1)
    with scene.run(SERVER) as process, robot_beside(scene, start, CMD_VEL, ODOM) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        for part, (wrong, _) in IMPOSSIBLE.items():
            director.give_and_cancel(part, {**CENTRE, **wrong})
        director.disturb("kept", CENTRE, GOAL, after_m=0.2)


@experiment
def north_east(scene: Scene) -> None:
    """The server gets a goal at one corner of the map."""
    _give_alone(scene, "north east", EAST, NORTH)


@experiment
def south_west(scene: Scene) -> None:
    """The server gets a goal at the other corner."""
    _give_alone(scene, "south west", WEST, SOUTH)


def _give_alone(scene: Scene, part: str, x: float, y: float) -> None:
    start = start_near(scene, CENTRE["x"], CENTRE["y"], 0.9, 1.1)
    with scene.run(SERVER) as process, robot_beside(scene, start, CMD_VEL, ODOM) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        director.give_and_cancel(part, {"x": x, "y": y, "tolerance": 0.1})


@experiment
def hurried(scene: Scene) -> None:
    """The server's goals are cancelled at once, again and again."""
    start = start_near(scene, CENTRE["x"], CENTRE["y"], 3.2, 3.6)
    with scene.run(SERVER) as process, robot_beside(scene, start, CMD_VEL, ODOM) as robot:
        director = Director(scene, process, SERVER, DRIVE_TO, robot)
        director.give_and_cancel_each(IN_A_ROW, CENTRE)


@experiment
def resting(scene: Scene) -> None:
    """The server with nothing to do, until Ctrl-C."""
    with scene.run(SERVER):
        await_action(scene)


# --- experiments: the client, with a server ----------------------------------------------------


@experiment
def sending(scene: Scene) -> None:
    """The client alone, with a server that lets it arrive."""
    feedback = [{**CENTRE, "distance": float(text) + MORE_DIGITS} for text in TELLS]
    for each in feedback:
        each.pop("tolerance")
    result = {"reached": True, "elapsed": ELAPSED_S}
    with taking(scene, ORDER) as taker, scene.run(CLIENT, start=Start(parameters=ASKED)) as process:
        lead(scene, process, taker, feedback, TELLS, "succeed", result)
        await_client(scene, process, CLIENT)


@experiment
def refused(scene: Scene) -> None:
    """The client alone, with a server that refuses its goal."""
    with taking(scene, ORDER, accepts=False), scene.run(CLIENT) as process:
        await_client(scene, process, CLIENT)


@experiment
def failing(scene: Scene) -> None:
    """The client alone, with a server that does not get there."""
    with taking(scene, ORDER) as taker, scene.run(CLIENT) as process:
        lead(scene, process, taker, [], [], "abort", {"reached": False, "elapsed": ELAPSED_S})
        await_client(scene, process, CLIENT)


@experiment
def nobody(scene: Scene) -> None:
    """The client alone, and no server anywhere."""
    with scene.run(CLIENT) as process:
        await_client(scene, process, CLIENT)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it: {SERVER.executable} and {CLIENT.executable} are there."""
    package.must(be_built_as(CARD.build_type), install(NODES))


# --- the server --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_server_runs(driving: ExperimentView) -> None:
    """The server starts, makes a node and runs on."""
    driving.process(SERVER).must(come_up, outlast_the_soak)


@check(needs=["server_runs"])
def test_server_name(driving: ExperimentView) -> None:
    """The server's node is called {SERVER.node}."""
    driving.node(SERVER).must(be_named)


@check(needs=["server_runs"])
def test_topics(driving: ExperimentView) -> None:
    """It publishes on {CMD_VEL.topic} and subscribes to {ODOM.topic}."""
    driving.publisher(SERVER, CMD_VEL).must(be_there, be_the_only_one, carry_its_type, match_qos)
    driving.subscription(SERVER, ODOM).must(be_there, carry_its_type, match_qos)
    driving.topic(CMD_VEL).must(leave_at_zero("linear.x", "angular.z"))


@check(needs=["server_runs"])
def test_action(driving: ExperimentView) -> None:
    """It performs {DRIVE_TO.action}."""
    driving.must(perform(DRIVE_TO))


@check(needs=["server_runs"])
def test_action_type(driving: ExperimentView) -> None:
    """The action is a {DRIVE_TO.type}."""
    driving.must(perform_its_type(DRIVE_TO))


@check(needs=["action_type"])
def test_accepts(
    driving: ExperimentView, north_east: ExperimentView, south_west: ExperimentView
) -> None:
    """It accepts a goal on the map, also at its corners."""
    driving.must(accept(SERVER, "first", "when the rover has nothing to do"))
    north_east.must(accept(SERVER, "north east", "just inside of the map"))
    south_west.must(accept(SERVER, "south west", "just inside of the map"))


@check(needs=["accepts"])
def test_feedback(driving: ExperimentView) -> None:
    """Feedback comes at {FEEDBACK.hz:g} Hz while it drives."""
    driving.must(rest_in_each_turn(SERVER, DRIVE_TO, "first"))
    driving.must(tell_at_its_rate(SERVER, DRIVE_TO, "first"))


@check(needs=["accepts"], explained_by={"feedback": "NeverRests"})
def test_not_blocked(driving: ExperimentView) -> None:
    """While it drives, the node still hears."""
    driving.must(rest_in_each_turn(SERVER, DRIVE_TO, "first"), hear_meanwhile)


@check(needs=["not_blocked", "feedback"])
def test_position(driving: ExperimentView) -> None:
    """Feedback tells where the rover is, and how far it still is."""
    driving.must(tell_the_truth(SERVER, "first"))


@check(needs=["not_blocked"])
def test_arrives(driving: ExperimentView) -> None:
    """The rover gets there, within the tolerance, and is told to stop."""
    driving.must(arrive(SERVER, "first"))


@check(needs=["arrives"])
def test_result(driving: ExperimentView) -> None:
    """The goal succeeds; the result says reached and elapsed."""
    driving.must(succeed(SERVER, "first"))


@check(needs=["arrives"], explained_by=OF_RESULTS)
def test_next_goal(driving: ExperimentView) -> None:
    """After one goal it takes the next."""
    driving.must(accept_again(SERVER, "next", "after a goal that was reached"))
    driving.must(succeed(SERVER, "next"))


@check(needs=["not_blocked"])
def test_cancel(cancelling: ExperimentView, driving: ExperimentView) -> None:
    """A goal can be cancelled on the way, within {CANCELS_WITHIN_S:g} s."""
    undisturbed = trip(driving, SERVER, "first")
    cancelling.must(cancel_in_time(SERVER, DRIVE_TO, "cancelled", undisturbed))


@check(needs=["cancel"])
def test_stops(cancelling: ExperimentView) -> None:
    """After a cancel the rover stands still."""
    cancelling.must(stop_in_time(SERVER, DRIVE_TO, "cancelled"))


@check(needs=["cancel", "arrives"], explained_by={"next_goal": "StaysBusy", **OF_RESULTS})
def test_after_cancel(cancelling: ExperimentView, hurried: ExperimentView) -> None:
    """After a cancel it takes the next goal, and another one after each cancel."""
    cancelling.must(accept_again(SERVER, "after", "after a goal that was cancelled"))
    cancelling.must(succeed(SERVER, "after"))
    hurried.must(cancel_each(SERVER, IN_A_ROW, "after goals that were cancelled"))


@check(needs=["accepts"])
def test_refuses(refusing: ExperimentView) -> None:
    """It refuses: outside of the map, nan, a tolerance of 0."""
    refusing.must(refuse_each(SERVER, {part: why for part, (_, why) in IMPOSSIBLE.items()}))


@check(needs=["arrives"])
def test_at_once(refusing: ExperimentView) -> None:
    """While it drives, it refuses another goal, and goes on."""
    refusing.must(keep_to_the_first(SERVER, "kept"))


# --- the client --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_client_sends(sending: ExperimentView, refused: ExperimentView) -> None:
    """The client sends the goal that its parameters say; with no word, their defaults."""
    sending.must(send_goal(CLIENT, ORDER, ASKED))
    refused.must(send_goal(CLIENT, ORDER, USUAL))


@check(needs=["client_sends"])
def test_client_name(sending: ExperimentView) -> None:
    """The client's node is called {CLIENT.node}."""
    sending.node(CLIENT).must(be_named)


@check(needs=["client_sends"])
def test_client_tells(sending: ExperimentView) -> None:
    """The client shows the progress: each distance."""
    sending.must(show_each(CLIENT, TELLS))


@check(needs=["client_sends"])
def test_client_ends(sending: ExperimentView) -> None:
    """When the rover is there, it says so and ends, exit code 0."""
    sending.must(end_so(CLIENT, CLIENT.outcomes["reached"], f"{ELAPSED_S:.1f}"))


@check(needs=["builds"])
def test_no_server(nobody: ExperimentView) -> None:
    """Without a server it says so and ends, exit code {GIVES_UP.exit_code}."""
    nobody.must(give_up(CLIENT))


@check(needs=["client_sends"], explained_by={"no_server": "WrongExitCode"})
def test_client_refused(refused: ExperimentView, failing: ExperimentView) -> None:
    """Refused, or not reached: it says so and ends, exit code 1."""
    refused.must(end_so(CLIENT, CLIENT.outcomes["refused"]))
    failing.must(end_so(CLIENT, CLIENT.outcomes["not_reached"]))


# --- the end -----------------------------------------------------------------------------------


@check(needs=["server_runs"])
def test_ends(resting: ExperimentView) -> None:
    """With nothing to do, the server ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    resting.process(SERVER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(resting: ExperimentView) -> None:
    """After Ctrl-C the server ends without an error."""
    resting.process(SERVER).must(exit_cleanly)
