"""What counts as done in the lab "topics": a talker and a listener on /chatter.

The numbers, names, texts and points stand in labs/topics/card.yaml. Experiments run the
student's nodes and watch; checks read what was seen and run nothing.
"""

from roslings.capabilities.topics.demands import count_up, have_rate, say_its_text
from roslings.course import lab
from roslings.evidence import ExperimentSeen
from roslings.experiment import Run, Scene, Unobserved, experiment, mending
from roslings.judge import (
    ExperimentView,
    PackageView,
    be_a_picture,
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
    hold_just,
    install,
    log_each,
    match_qos,
    outlast_the_soak,
    repeat,
    speak_unobserved,
    stay_up,
    well_formed,
)

CARD = lab("topics").card
TALKER, LISTENER = CARD.node("talker"), CARD.node("listener")
CHATTER, HEARD = TALKER.publishes[0], LISTENER.subscribes[0]
FIGURE = CARD.pictures[0]


# --- experiments: run the nodes and watch ------------------------------------------------------


@experiment(clock="auto")
def talking(scene: Scene) -> None:
    """The talker alone, until its rate is sure."""
    with scene.run(TALKER):
        scene.watch(CHATTER)


@experiment
def hearing(scene: Scene) -> None:
    """The listener alone, while somebody says sentences that it cannot know."""
    with scene.run(LISTENER) as listener:
        scene.say_sentences(listener, HEARD, count=12)


@experiment
def together(scene: Scene, talking: ExperimentSeen, hearing: ExperimentSeen) -> None:
    """Both at once; slips in names, judged above, are put right by remapping."""
    with scene.run_all(
        Run(TALKER, mending(TALKER, talking)), Run(LISTENER, mending(LISTENER, hearing))
    ):
        scene.joined(CHATTER)


@experiment(unobserved=True)
def unobserved(scene: Unobserved, talking: ExperimentSeen, hearing: ExperimentSeen) -> None:
    """Both at once, and nobody else: only the listener tells what it hears."""
    with (
        scene.run(TALKER, mending(TALKER, talking)),
        scene.run(LISTENER, mending(LISTENER, hearing)) as listener,
    ):
        scene.read_along(listener, LISTENER, CHATTER)


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)
test_depends = depends


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {TALKER.executable} and {LISTENER.executable}."""
    package.must(be_built_as(CARD.build_type), install([TALKER.executable, LISTENER.executable]))


# --- the talker --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_talker_runs(talking: ExperimentView) -> None:
    """The talker starts and makes a node."""
    talking.process(TALKER).must(come_up)


@check(needs=["talker_runs"])
def test_talker_stays(talking: ExperimentView) -> None:
    """The talker runs until Ctrl-C."""
    talking.process(TALKER).must(stay_up, outlast_the_soak)


@check(needs=["talker_runs"])
def test_talker_name(talking: ExperimentView) -> None:
    """The talker's node is called {TALKER.node}."""
    talking.node(TALKER).must(be_named)


@check(needs=["talker_runs"])
def test_talker_topic(talking: ExperimentView) -> None:
    """The talker publishes on {CHATTER.topic}."""
    talking.publisher(TALKER, CHATTER).must(be_there, be_the_only_one)


@check(needs=["talker_runs"])
def test_talker_type(talking: ExperimentView) -> None:
    """Its messages are of type {CHATTER.type}."""
    talking.publisher(TALKER, CHATTER).must(carry_its_type)


@check(needs=["talker_runs"])
def test_talker_qos(talking: ExperimentView) -> None:
    """Every usual subscription can hear the talker (QoS)."""
    talking.publisher(TALKER, CHATTER).must(match_qos)


@check(needs=["talker_stays"])
def test_rate(talking: ExperimentView, hearing: ExperimentView, unobserved: ExperimentView) -> None:
    """{CHATTER.topic} carries {CHATTER.rate.hz:g} messages a second, evenly."""
    talking.topic(CHATTER).must(have_rate(CHATTER))
    unobserved.must(speak_unobserved(talking, hearing, (TALKER, LISTENER), (CHATTER, HEARD)))


@check(needs=["talker_type"])
def test_text(talking: ExperimentView) -> None:
    """The messages say {CHATTER.text!r}, with a number for {{n}}."""
    talking.topic(CHATTER).must(say_its_text)


@check(needs=["talker_type"])
def test_counting(talking: ExperimentView) -> None:
    """The number goes up by one from message to message."""
    talking.topic(CHATTER).must(count_up)


@check(needs=["talker_type"])
def test_talker_logs(talking: ExperimentView) -> None:
    """The talker writes each message that it publishes, once."""
    texts = talking.topic(CHATTER).texts
    talking.process(TALKER).must(log_each(TALKER, texts))


# --- the listener ------------------------------------------------------------------------------


@check(needs=["builds"])
def test_listener_runs(hearing: ExperimentView) -> None:
    """The listener starts, makes a node and runs until Ctrl-C."""
    hearing.process(LISTENER).must(come_up, stay_up, outlast_the_soak)


@check(needs=["listener_runs"])
def test_listener_name(hearing: ExperimentView) -> None:
    """The listener's node is called {LISTENER.node}."""
    hearing.node(LISTENER).must(be_named)


@check(needs=["listener_runs"])
def test_listener_topic(hearing: ExperimentView) -> None:
    """The listener subscribes to {HEARD.topic} (name, type, QoS)."""
    hearing.subscription(LISTENER, HEARD).must(be_there, carry_its_type, match_qos)


@check(needs=["listener_runs"])
def test_hears(hearing: ExperimentView) -> None:
    """The listener writes every sentence said on {HEARD.topic}, once."""
    hearing.process(LISTENER).must(repeat(LISTENER, hearing.seen.spoken))


# --- both --------------------------------------------------------------------------------------


@check(needs=["talker_stays", "talker_type", "talker_qos", "listener_runs"])
def test_together(together: ExperimentView) -> None:
    """Together: two nodes, joined by {CHATTER.topic}, nothing else."""
    together.must(hold_just([TALKER, LISTENER], CHATTER))


@check(needs=["talker_stays", "listener_runs"])
def test_ends(talking: ExperimentView, hearing: ExperimentView) -> None:
    """Both nodes end within {CARD.ends_within_s:g} s of Ctrl-C."""
    talking.process(TALKER).must(end_within(CARD.ends_within_s))
    hearing.process(LISTENER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(talking: ExperimentView, hearing: ExperimentView) -> None:
    """After Ctrl-C both nodes end without an error."""
    talking.process(TALKER).must(exit_cleanly)
    hearing.process(LISTENER).must(exit_cleanly)


@check()
def test_figure(package: PackageView) -> None:
    """A picture of the graph lies in {FIGURE.path}."""
    package.picture(FIGURE).must(be_a_picture)
