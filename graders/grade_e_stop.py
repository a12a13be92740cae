"""What counts as done in the lab "e-stop": a latched button, and a guard before the motors.

The names, texts, times and points stand in labs/e-stop/card.yaml. Experiments run the student's
nodes between an operator, a button and motors of ours; checks read what was seen and run nothing.
"""

from graders.e_stop.act import (
    FAR_WITHIN_S,
    DrawnCommands,
    Far,
    Pressing,
    Roads,
    beside,
    button_plan,
    client_plan,
    joiner_plan,
    motors_plan,
    operator_plan,
    running_on,
    two_computers,
    watching,
)
from graders.e_stop.contract import GuardWords, HostsWords
from graders.e_stop.demands import (
    be_reached,
    drive,
    hear_from_afar,
    on_two_computers,
    stand,
    stop_for,
    tell_at_once,
    tell_each_press,
    tell_why,
)
from graders.e_stop.orders import ALWAYS
from graders.e_stop.walked import keep_all_reasons
from graders.e_stop.walking import walk_along, with_drawn
from roslings.capabilities.qos.contract import QosWords
from roslings.capabilities.qos.demands import (
    ask_for,
    keep_for_late_joiners,
    offer,
    tell_late_joiners_the_truth,
)
from roslings.capabilities.services.act import Asker
from roslings.capabilities.services.contract import ServiceWords
from roslings.capabilities.services.demands import (
    answer_each,
    answer_in_time,
    serve,
    serve_once,
    serve_their_types,
)
from roslings.capabilities.topics.demands import have_rate
from roslings.course import lab, written
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
    have_just_this_qos,
    install,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)

CARD = lab("e-stop").card
BUTTON, GUARD = CARD.node("e_stop_button"), CARD.node("guard")
E_STOP, PRESS = BUTTON.publishes[0], BUTTON.of(ServiceWords).serves[0]
LATCHED = BUTTON.of(QosWords).offers[0]
RELEASED, PRESSED = PRESS.answers
HEARD, COMMANDS = GUARD.subscribes
CMD_VEL, STEADY = GUARD.publishes[0], GUARD.of(QosWords).offers[0]
ALIVE, IN_TIME = GUARD.of(QosWords).asks
STOPS = GUARD.of(GuardWords).stops
DRAWN = GUARD.of(GuardWords).walks - len(ALWAYS)
HOSTS = written(CARD.of(HostsWords).hosts, "the package")
ROADS = Roads(commands=COMMANDS, button=HEARD, motors=CMD_VEL, alive=ALIVE)
DEADLINE_S = written(IN_TIME.deadline_s, IN_TIME.topic)
IN_A_ROW = 20
IN_ALL_ORDERS = (RELEASED, PRESSED, PRESSED, RELEASED, RELEASED)
"""Each answer after the other one, and after itself."""
TWICE = 2
"""Silences: the second one brings events of which there were two before."""

FAR_S = HOSTS.stops_within_s
FAR, CUT = "pressed far away", "the cable is cut"


# --- experiments: run the nodes between ours, and watch ----------------------------------------


@experiment
def pressing(scene: Scene) -> None:
    """The button alone, while somebody presses it, and others come late."""
    with scene.run(BUTTON) as process:
        asker = Asker(scene, process, BUTTON)
        presses = Pressing(scene, PRESS, E_STOP)
        presses.join("the start", True)
        presses.press_each(IN_ALL_ORDERS)
        asker.ask_in_a_row(PRESS, PRESS.answers, IN_A_ROW)


@experiment(clock="auto")
def idling(scene: Scene) -> None:
    """The guard alone, until its rate is sure."""
    with scene.run(GUARD):
        scene.watch(CMD_VEL)


@experiment
def guarding(scene: Scene) -> None:
    """The guard, which comes late: it drives, is pressed, and gets no commands for a while."""
    plans = operator_plan(ROADS), button_plan(ROADS), motors_plan(ROADS)
    with beside(scene, "operator", *plans) as operator:
        operator.tell(say={"data": RELEASED.state})
        commands = DrawnCommands(scene, ROADS.commands)
        with scene.run(GUARD), watching(scene, operator, operator, commands) as guard:
            if not guard.drives("late", "when the guard starts after the stop was released"):
                return
            press = {"data": PRESSED.state}
            guard.stops("pressed", STOPS["pressed"], "a press", lambda: operator.tell(say=press))
            operator.tell(say={"data": RELEASED.state})
            guard.drives("pressed, again", "when the stop is released")
            for _ in range(TWICE):
                guard.stops(
                    "silent", STOPS["silent"], "the last command", lambda: operator.tell(drive=None)
                )
                if not guard.drives("silent, again", "when commands come again"):
                    return


@experiment
def losing(scene: Scene) -> None:
    """The guard without a button, with one, with one that hangs, and with one that ended."""
    commands = DrawnCommands(scene, ROADS.commands)
    with (
        beside(scene, "operator", operator_plan(ROADS), motors_plan(ROADS)) as operator,
        scene.run(GUARD),
        watching(scene, operator, operator, commands) as guard,
    ):
        operator.tell(drive=commands.another())
        guard.rests("still", "while no button was ever there")
        with beside(scene, "button", button_plan(ROADS)) as button:
            guard.hears(button)
            # Its sign of life comes once in the lease, and only then it counts as there.
            guard.rests("still", "while the button has said nothing yet", ALIVE.lease_s or 0.0)
            button.tell(say={"data": PRESSED.state})
            guard.rests("still", "while the stop was never released")
            button.tell(say={"data": RELEASED.state})
            if not guard.drives("released", "when the stop is released for the first time"):
                return
            guard.stops("lost", STOPS["lost"], "the button's program hangs", button.freeze)
            button.thaw()
            guard.drives("lost, again", "when the button's program runs on")
            guard.stops("lost", STOPS["lost"], "the button's program ended", button.leave)
        with beside(scene, "button", button_plan(ROADS)) as button:
            button.tell(say={"data": RELEASED.state})
            guard.drives("lost, again", "when the button's program is there again")


@experiment
def in_any_order(scene: Scene) -> None:
    """The guard: pressed and without commands at once, then as nobody knows before."""
    walk_along(scene, GUARD, ROADS, STOPS, *with_drawn(ALWAYS[0], scene.seed, DRAWN))


@experiment
def button_by_button(scene: Scene) -> None:
    """The guard: a press outlasts other reasons."""
    walk_along(scene, GUARD, ROADS, STOPS, ALWAYS[1])


@experiment
def two_buttons(scene: Scene) -> None:
    """The guard with a second button, which comes and goes."""
    walk_along(scene, GUARD, ROADS, STOPS, ALWAYS[2])


@experiment
def apart(scene: Scene) -> None:
    """The button on one computer, the guard on another."""
    with two_computers(scene, HOSTS, ("laptop", "rover")) as hosts:
        if hosts is None:
            return
        with (
            beside(
                scene, "operator", operator_plan(ROADS), client_plan(PRESS), host=hosts.first
            ) as operator,
            beside(
                scene, "rover", motors_plan(ROADS), joiner_plan(E_STOP), host=hosts.second
            ) as rover,
            running_on(scene, hosts.first, BUTTON),
        ):
            far = Far(scene, operator, rover)
            if not far.finds_the_button(E_STOP):
                return
            far.call(RELEASED)
            with (
                running_on(scene, hosts.second, GUARD),
                watching(scene, operator, rover, DrawnCommands(scene, ROADS.commands)) as guard,
            ):
                if not far.finds_the_guard(COMMANDS):
                    return
                if not guard.drives("far", "on two computers", within_s=FAR_WITHIN_S):
                    return
                guard.stands(FAR, "a press on the other computer", lambda: far.call(PRESSED), FAR_S)
                far.call(RELEASED)
                guard.drives("far, again", "after a release there", within_s=FAR_WITHIN_S)
                guard.stands(CUT, "the cable was pulled", hosts.link.cut, FAR_S)
                hosts.link.mend()
                guard.drives("far, again", "with the cable back", within_s=FAR_WITHIN_S)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it: {BUTTON.executable} and {GUARD.executable} are there."""
    package.must(be_built_as(CARD.build_type), install([BUTTON.executable, GUARD.executable]))


# --- the button --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_button_runs(pressing: ExperimentView) -> None:
    """The button starts, makes a node and runs on."""
    pressing.process(BUTTON).must(come_up, outlast_the_soak)


@check(needs=["button_runs"])
def test_button_name(pressing: ExperimentView) -> None:
    """The button's node is called {BUTTON.node}."""
    pressing.node(BUTTON).must(be_named)


@check(needs=["button_runs"])
def test_button_topic(pressing: ExperimentView) -> None:
    """It publishes {E_STOP.type} on {E_STOP.topic}, reliable and latched."""
    pressing.publisher(BUTTON, E_STOP).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["button_topic"])
def test_button_alive(pressing: ExperimentView) -> None:
    """It offers signs of life, with a lease of {LATCHED.lease_s:g} s."""
    pressing.must(offer(LATCHED))


@check(needs=["button_runs"])
def test_press(pressing: ExperimentView) -> None:
    """{PRESS.service} answers within {PRESS.within_s:g} s, with success and message."""
    pressing.must(serve(PRESS), serve_once(PRESS), serve_their_types(PRESS))
    pressing.must(answer_each(BUTTON, PRESS))
    pressing.must(answer_in_time(BUTTON, PRESS, "row", "calls in a row", IN_A_ROW))


@check(needs=["button_topic", "press"])
def test_tells(pressing: ExperimentView) -> None:
    """Each call is told on {E_STOP.topic}, once; true is told at first."""
    pressing.must(tell_each_press(PRESS, E_STOP), tell_at_once(PRESS, E_STOP))
    pressing.must(tell_late_joiners_the_truth(E_STOP))


@check(needs=["button_topic"])
def test_late_joiner(pressing: ExperimentView) -> None:
    """Who comes late gets the last message, and no other."""
    pressing.must(keep_for_late_joiners(LATCHED))


# --- the guard ---------------------------------------------------------------------------------


@check(needs=["builds"])
def test_guard_runs(idling: ExperimentView) -> None:
    """The guard starts, makes a node and runs on."""
    idling.process(GUARD).must(come_up, stay_up, outlast_the_soak)


@check(needs=["guard_runs"])
def test_guard_name(idling: ExperimentView) -> None:
    """The guard's node is called {GUARD.node}."""
    idling.node(GUARD).must(be_named)


@check(needs=["guard_runs"])
def test_guard_topics(idling: ExperimentView) -> None:
    """Its three topics have names, types, reliability and durability of the card."""
    for heard in (HEARD, COMMANDS):
        idling.subscription(GUARD, heard).must(be_there, carry_its_type, match_qos)
    idling.subscription(GUARD, HEARD).must(have_just_this_qos)
    idling.publisher(GUARD, CMD_VEL).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["guard_topics"])
def test_guard_asks(idling: ExperimentView) -> None:
    """It asks for a deadline on {COMMANDS.topic}, and for signs of life on {HEARD.topic}."""
    idling.must(ask_for(ALIVE), ask_for(IN_TIME))


@check(needs=["guard_topics"])
def test_guard_offers(idling: ExperimentView) -> None:
    """Its commands for the motors have a deadline and a lifespan."""
    idling.must(offer(STEADY))


@check(needs=["guard_topics"])
def test_rate(idling: ExperimentView) -> None:
    """{CMD_VEL.topic} carries {CMD_VEL.rate.hz:g} messages a second, evenly."""
    idling.topic(CMD_VEL).must(have_rate(CMD_VEL))


@check(needs=["guard_topics", "guard_asks"])
def test_still_at_first(losing: ExperimentView) -> None:
    """Without a button, and before the first release, the rover stands still."""
    losing.must(stand(CMD_VEL, "still"))


@check(needs=["guard_topics", "guard_asks"])
def test_passes(guarding: ExperimentView, losing: ExperimentView) -> None:
    """Nothing speaks against it: the motors get what the operator wants."""
    guarding.must(drive(CMD_VEL, "late", deadline_s=DEADLINE_S))
    losing.must(drive(CMD_VEL, "released", deadline_s=DEADLINE_S))


@check(needs=["passes"])
def test_pressed(guarding: ExperimentView) -> None:
    """A press stops the rover within {STOPS[pressed].within_s:g} s, a release lets it go on."""
    guarding.must(
        stop_for(CMD_VEL, "pressed", STOPS["pressed"].within_s),
        drive(CMD_VEL, "pressed, again", deadline_s=DEADLINE_S, again=True),
    )


@check(needs=["passes"])
def test_silent(guarding: ExperimentView) -> None:
    """No commands: it stops within {STOPS[silent].within_s:g} s, and goes on with the next one."""
    guarding.must(
        stop_for(CMD_VEL, "silent", STOPS["silent"].within_s),
        drive(CMD_VEL, "silent, again", deadline_s=DEADLINE_S, again=True),
    )


@check(needs=["passes"])
def test_lost(losing: ExperimentView) -> None:
    """The button hangs or ends: it stops within {STOPS[lost].within_s:g} s, until one is back."""
    losing.must(
        drive(CMD_VEL, "lost, again", deadline_s=DEADLINE_S, again=True),
        stop_for(CMD_VEL, "lost", STOPS["lost"].within_s),
    )


@check(needs=["pressed", "silent", "lost"])
def test_orders(
    in_any_order: ExperimentView, button_by_button: ExperimentView, two_buttons: ExperimentView
) -> None:
    """Reasons that hold at once, in any order: the rover drives when none is left."""
    for walks in (in_any_order, button_by_button, two_buttons):
        walks.must(keep_all_reasons(CMD_VEL, STOPS, DEADLINE_S))


@check(needs=["pressed", "silent", "lost"])
def test_reasons(guarding: ExperimentView, losing: ExperimentView) -> None:
    """The guard writes why it stops, once for each stop."""
    guarding.must(tell_why(GUARD, STOPS, DEADLINE_S))
    losing.must(tell_why(GUARD, STOPS, DEADLINE_S))


# --- two computers -----------------------------------------------------------------------------


@check(needs=["press", "late_joiner", "button_alive", "passes"])
def test_far_reach(apart: ExperimentView) -> None:
    """On two computers without multicast the nodes find each other."""
    apart.must(be_reached(PRESS, E_STOP), hear_from_afar(COMMANDS))


@check(needs=["far_reach", "tells", "pressed", "silent", "lost"])
def test_far(apart: ExperimentView) -> None:
    """On a bad link it drives, and stops within {HOSTS.stops_within_s:g} s of a press or a cut."""
    apart.must(
        on_two_computers(
            drive(CMD_VEL, "far", deadline_s=DEADLINE_S, steadily=False),
            drive(CMD_VEL, "far, again", deadline_s=DEADLINE_S, again=True, steadily=False),
            stop_for(CMD_VEL, FAR, HOSTS.stops_within_s),
            stop_for(CMD_VEL, CUT, HOSTS.stops_within_s),
        )
    )


# --- the end -----------------------------------------------------------------------------------


@check(needs=["button_runs", "guard_runs"])
def test_ends(pressing: ExperimentView, idling: ExperimentView) -> None:
    """Both nodes end within {CARD.ends_within_s:g} s of Ctrl-C."""
    pressing.process(BUTTON).must(end_within(CARD.ends_within_s))
    idling.process(GUARD).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(pressing: ExperimentView, idling: ExperimentView) -> None:
    """After Ctrl-C both nodes end without an error."""
    pressing.process(BUTTON).must(exit_cleanly)
    idling.process(GUARD).must(exit_cleanly)
