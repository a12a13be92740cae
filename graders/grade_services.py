"""What counts as done in the lab "services": a server of two services, and a client.

The names, texts, times and points stand in labs/services/card.yaml. Experiments run the
student's nodes and watch; checks read what was seen and run nothing.
"""

from roslings.capabilities.services.act import Asker, answering, await_end
from roslings.capabilities.services.contract import ServiceWords
from roslings.capabilities.services.demands import (
    answer_each,
    answer_in_time,
    ask,
    before_the_calls,
    end_by_itself,
    give_up,
    say_at_first,
    serve,
    serve_once,
    serve_their_types,
    show_each,
    tell_the_answer,
)
from roslings.capabilities.topics.demands import have_rate
from roslings.course import lab
from roslings.course.files import written
from roslings.experiment import Scene, experiment
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_built_as,
    be_named,
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

CARD = lab("services").card
SERVER, CLIENT = CARD.node("motor_controller"), CARD.node("motor_client")
STATE = SERVER.publishes[0]
SET_MAX_SPEED, RESET = SERVER.of(ServiceWords).serves
ASKED = CLIENT.of(ServiceWords).calls[0]
RESET_AGAIN = RESET.model_copy(update={"answers": RESET.answers[-1:]})
"""Asked when the limit is off already: each time the same is to come."""

IN_A_ROW, CLIENTS, TIMES, RESETS = 100, 4, 25, 20
FREE = RESET.answers[-1].state
"""What the state says while there is no limit."""
GIVES_UP = written(CLIENT.gives_up, CLIENT.node)


# --- experiments: run the nodes, ask and watch -------------------------------------------------


@experiment
def serving(scene: Scene) -> None:
    """The server alone, while others call its services: one by one, in a row, at once."""
    with scene.run(SERVER) as process:
        scene.watch(STATE)
        asker = Asker(scene, process, SERVER)
        asker.ask_each(SET_MAX_SPEED, SET_MAX_SPEED.answers, STATE)
        asker.ask_in_a_row(SET_MAX_SPEED, SET_MAX_SPEED.answers, IN_A_ROW)
        asker.ask_at_once(SET_MAX_SPEED, SET_MAX_SPEED.answers, TIMES, CLIENTS)
        asker.ask_once(SET_MAX_SPEED, SET_MAX_SPEED.answers[0])
        asker.ask_each(RESET, RESET.answers, STATE)
        asker.ask_in_a_row(RESET_AGAIN, RESET_AGAIN.answers, RESETS, part="resets")


@experiment
def asking(scene: Scene) -> None:
    """The client alone, with a server whose answer it cannot know."""
    answer = {"success": True, "message": scene.sentence()}
    with answering(scene, ASKED, answer), scene.run(CLIENT) as process:
        await_end(scene, process, CLIENT)


@experiment
def nobody(scene: Scene) -> None:
    """The client alone, and no server anywhere."""
    with scene.run(CLIENT) as process:
        await_end(scene, process, CLIENT)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it: {SERVER.executable} and {CLIENT.executable} are there."""
    package.must(be_built_as(CARD.build_type), install([SERVER.executable, CLIENT.executable]))


# --- the server --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_server_runs(serving: ExperimentView) -> None:
    """The server starts, makes a node and runs on."""
    serving.process(SERVER).must(come_up, outlast_the_soak)


@check(needs=["server_runs"])
def test_server_name(serving: ExperimentView) -> None:
    """The server's node is called {SERVER.node}."""
    serving.node(SERVER).must(be_named)


@check(needs=["server_runs"])
def test_state_topic(serving: ExperimentView) -> None:
    """It publishes {STATE.type} on {STATE.topic}, {STATE.rate.hz:g} Hz."""
    serving.publisher(SERVER, STATE).must(be_there, carry_its_type, match_qos)
    before_the_calls(serving, STATE).must(have_rate(STATE))


@check(needs=["server_runs"])
def test_services(serving: ExperimentView) -> None:
    """It serves {SET_MAX_SPEED.service} and {RESET.service}."""
    serving.must(serve(SET_MAX_SPEED), serve(RESET))
    serving.must(serve_once(SET_MAX_SPEED), serve_once(RESET))


@check(needs=["server_runs"])
def test_service_types(serving: ExperimentView) -> None:
    """Both services have the types of the card."""
    serving.must(serve_their_types(SET_MAX_SPEED, RESET))


@check(needs=["server_runs"])
def test_set_max_speed(serving: ExperimentView) -> None:
    """{SET_MAX_SPEED.service} answers with success and message."""
    serving.must(answer_each(SERVER, SET_MAX_SPEED))


@check(needs=["server_runs"])
def test_reset(serving: ExperimentView) -> None:
    """{RESET.service} answers within {RESET.within_s:g} s, in both cases with what is asked."""
    serving.must(
        answer_each(SERVER, RESET),
        answer_in_time(SERVER, RESET_AGAIN, "resets", "resets in a row", RESETS),
    )


@check(needs=["server_runs"], explained_by={"set_max_speed": "WrongAnswer", "reset": "WrongAnswer"})
def test_state(serving: ExperimentView) -> None:
    """The state is kept: {STATE.topic} says what was set, and {FREE} before that."""
    before_the_calls(serving, STATE).must(say_at_first(FREE))
    serving.must(show_each([SET_MAX_SPEED, RESET], STATE))


@check(needs=["set_max_speed"])
def test_quick(serving: ExperimentView) -> None:
    """{IN_A_ROW} calls in a row: each is answered within {SET_MAX_SPEED.within_s:g} s."""
    serving.must(answer_in_time(SERVER, SET_MAX_SPEED, "row", "calls in a row", IN_A_ROW))


@check(needs=["quick"])
def test_at_once(serving: ExperimentView) -> None:
    """{CLIENTS} clients at once: each gets its answer within {SET_MAX_SPEED.within_s:g} s."""
    who, asked = f"{CLIENTS} clients at once", CLIENTS * TIMES
    serving.must(answer_in_time(SERVER, SET_MAX_SPEED, "crowd", who, asked))


# --- the client --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_client_asks(asking: ExperimentView) -> None:
    """The client calls {ASKED.service}, with data: true."""
    asking.must(ask(CLIENT, ASKED))


@check(needs=["client_asks"])
def test_client_name(nobody: ExperimentView) -> None:
    """The client's node is called {CLIENT.node}."""
    nobody.node(CLIENT).must(be_named)


@check(needs=["client_asks"])
def test_client_ends(asking: ExperimentView) -> None:
    """After the answer the client ends by itself, with exit code 0."""
    asking.must(end_by_itself(CLIENT))


@check(needs=["client_asks"])
def test_client_tells(asking: ExperimentView) -> None:
    """The client writes the message of the answer."""
    asking.must(tell_the_answer(CLIENT))


@check(needs=["builds"])
def test_no_server(nobody: ExperimentView) -> None:
    """Without a server the client says so and ends, with exit code {GIVES_UP.exit_code}."""
    nobody.must(give_up(CLIENT))


# --- the end -----------------------------------------------------------------------------------


@check(needs=["server_runs"])
def test_ends(serving: ExperimentView) -> None:
    """The server ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    serving.process(SERVER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(serving: ExperimentView) -> None:
    """After Ctrl-C the server ends without an error."""
    serving.process(SERVER).must(exit_cleanly)
