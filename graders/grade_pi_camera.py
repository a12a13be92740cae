"""What counts as done in the lab "pi-camera": a node that films, and one that finds a ball.

The numbers, names and points stand in labs/pi-camera/card.yaml. Experiments run the student's
nodes beside a camera, or show them pictures, and watch; checks read what was seen.
"""

from dataclasses import replace

from graders.pi_camera.demands import (
    Screen,
    answer_nothing,
    answer_once,
    begin_with_the_hue,
    call_none_bad,
    carry_the_header,
    cut_its_rows,
    draw_on_each,
    find_nothing,
    find_the_ball,
    follow_the_hue,
    survive,
    tell_once,
)
from graders.pi_camera.projector import Projector, Shot, place_ball
from roslings.capabilities.camera.act import (
    BUSY,
    FORBIDDEN,
    GONE,
    MISSING,
    PICTURES,
    camera_beside,
    change_parameter,
)
from roslings.capabilities.camera.demands import (
    begin_so_light,
    come_after,
    follow_brightness,
    hold_whole_rows,
    refuse,
    show_each_once,
    show_what_the_camera_saw,
    tell_of_trouble,
)
from roslings.capabilities.parameters.act import list_parameters
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.parameters.demands import declare_its_parameters
from roslings.capabilities.topics.demands import have_rate
from roslings.capabilities.topics.relay import carry_its_time, hold_its_fields
from roslings.course import lab
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
    during,
    end_within,
    exit_cleanly,
    have_just_this_qos,
    install,
    list_what_it_imports,
    match_qos,
    outlast_the_soak,
    stay_up,
    well_formed,
)
from roslings_rover.camera import Encoding, Light
from roslings_rover.rover import Disc

CARD = lab("pi-camera").card
CAMERA, FINDER = CARD.node("camera"), CARD.node("ball_finder")
IMAGE, SEEN = CAMERA.publishes[0], FINDER.subscribes[0]
BALL, DRAWN = FINDER.publishes
BRIGHTNESS = CAMERA.of(ParameterWords).parameter("brightness")
HUE = FINDER.of(ParameterWords).parameter("ball_hue")
NEUTRAL, LEVELS = CAMERA.constant("neutral_brightness"), CAMERA.constant("levels")
SMALLEST, WITHIN = FINDER.constant("smallest_ball"), FINDER.constant("within")
WINDOW = FINDER.constant("hue_window")
BESIDE = 1
"""A colour that lies so many hues inside of the window is found, and one so far outside is not."""

RETRIES_WITHIN_S = 2.0
SCREEN = Screen(FINDER, BALL, DRAWN, WITHIN)
RED, GREEN, BLUE = int(HUE.default), int(HUE.tried), 115
LIGHT = int(BRIGHTNESS.tried)
LIT = (51, LIGHT, *BRIGHTNESS.ends)
"""The brightnesses that are tried, one after the other."""

FIRST_HUE, LAST_HUE = HUE.ends
SMALL, LARGE, ODD = (160, 120), (640, 480), (147, 101)
SIZES = [LARGE, SMALL, SMALL, SMALL]
"""Of the first pictures. A piece of a large one is lost more easily, and after a silence each is
shown once only: so the large one comes first."""

PARTS = ["ball", "none", "rgb8", "rows", "mono8"]
PLAIN_PARTS = ["ball", "none"]
"""Where a picture needs no conversion: what goes wrong in others is told by other checks."""

SPOILED_PARTS = ["short", "empty", "flat", "unknown"]

WRONG_BRIGHTNESS, WRONG_HUE = (*BRIGHTNESS.beyond, "light"), (*HUE.beyond, "red")
BAD_PICTURE = str(FINDER.log).partition("{")[0]


# --- pictures ----------------------------------------------------------------------------------


Size = tuple[int, int]


def shot(
    scene: Scene,
    size: Size = SMALL,
    hue: int = RED,
    encoding: Encoding = "bgr8",
    idle_bytes: int = 0,
) -> Shot:
    """A picture with a ball, in a light and with a noise that nobody can know."""
    return Shot(*size, encoding, idle_bytes, some_light(scene), ball(scene, size, hue))


def with_decoy(scene: Scene, hue: int, decoy_hue: int, encoding: Encoding = "bgr8") -> Shot:
    """A picture with two balls of different colours."""
    decoy = ball(scene, SMALL, decoy_hue)
    mine = ball(scene, SMALL, hue, decoy)
    return Shot(*SMALL, encoding, light=some_light(scene), ball=mine, decoy=decoy)


def without_ball(scene: Scene, decoy: Disc | None) -> Shot:
    """A picture with nothing in it, or with a ball of another colour."""
    return Shot(*SMALL, light=some_light(scene), decoy=decoy)


def ball(scene: Scene, size: Size, hue: int, away_from: Disc | None = None) -> Disc:
    """A ball of nearly this hue, large enough to be asked for."""
    shade = round(scene.between(0, 4))
    return place_ball(scene, size, hue + shade, SMALLEST, away_from)


def smallest(scene: Scene) -> Shot:
    """A picture with a ball that is as small as one may be."""
    shown = shot(scene)
    return replace(shown, ball=replace(ball(scene, SMALL, RED), radius_px=SMALLEST))


def at_the_window(scene: Scene, hues: float) -> Shot:
    """A picture with a ball whose colour is so far from the one that is looked for.

    It has no noise: that would move the colours of its points.
    """
    shown, light = shot(scene), some_light(scene)
    edge = replace(ball(scene, SMALL, GREEN), hue=round(GREEN + hues))
    return replace(shown, light=replace(light, noise=0.0), ball=edge)


def some_light(scene: Scene) -> Light:
    """Lighter or darker, with more or less noise."""
    return Light(brightness=round(scene.between(42, 68)), noise=scene.between(1.0, 8.0))


# --- experiments: run the nodes, beside a camera or before a screen ----------------------------


@experiment
def filming(scene: Scene) -> None:
    """The camera node alone; a ball jumps about before its camera."""
    with camera_beside(scene, IMAGE) as camera, scene.run(CAMERA, start=camera.start()):
        camera.await_pictures(1)  # a node may open its camera by a timer
        scene.watch(IMAGE)
        camera.await_pictures(PICTURES)


@experiment
def untold(scene: Scene) -> None:
    """The camera node, and nobody tells it where its camera is."""
    with scene.run(CAMERA):
        list_parameters(scene, CAMERA)


@experiment
def lighting(scene: Scene) -> None:
    """The camera node, while its brightness is changed."""
    with camera_beside(scene, IMAGE) as camera, scene.run(CAMERA, start=camera.start()):
        for value in LIT:
            camera.expect_lighter((value - NEUTRAL) * LEVELS)
        camera.await_pictures(2)
        for value in LIT:
            if change_parameter(scene, CAMERA, BRIGHTNESS.name, value):
                camera.await_pictures(8)
        for wrong in WRONG_BRIGHTNESS:
            change_parameter(scene, CAMERA, BRIGHTNESS.name, wrong)


@experiment
def unplugged(scene: Scene) -> None:
    """A camera that is missing, forbidden, busy, there, gone, and there again."""
    with camera_beside(scene, IMAGE, plugged_in=False) as beside:
        beside.expect_lighter((LIGHT - NEUTRAL) * LEVELS)
        beside.begin("missing")
        with scene.run(CAMERA, start=beside.start({BRIGHTNESS.name: LIGHT})) as process:
            beside.await_trouble(process, *MISSING)
            for part, numbers in (("forbidden", FORBIDDEN), ("busy", BUSY)):
                beside.begin(part)
                beside.refuse(numbers[0])
                beside.await_trouble(process, *numbers)
            beside.refuse(0)
            beside.begin("there")
            beside.await_return(3)
            beside.begin("gone")
            beside.camera.unplug()
            beside.await_trouble(process, *GONE)
            beside.begin("there again")
            beside.camera.plug_in()
            beside.await_return(3)


@experiment
def looking(scene: Scene) -> None:
    """The ball finder alone, while pictures are shown to it."""
    with scene.run(FINDER) as process:
        screen = Projector(scene, process, SEEN, BALL, DRAWN)
        screen.begin()
        for size in SIZES:
            screen.show("ball", shot(scene, size))
        screen.show("ball", smallest(scene))
        screen.show("ball", with_decoy(scene, RED, GREEN))
        for decoy in (None, ball(scene, SMALL, GREEN), ball(scene, SMALL, BLUE)):
            screen.show("none", without_ball(scene, decoy))
        screen.show("rgb8", with_decoy(scene, RED, BLUE, encoding="rgb8"))
        screen.show("rgb8", shot(scene, encoding="rgb8"))
        for idle in (0, 5, 64):
            screen.show("rows", shot(scene, ODD, idle_bytes=idle))
        screen.show("mono8", shot(scene, encoding="mono8"))
        screen.keep_worst()


@experiment
def retuning(scene: Scene) -> None:
    """The ball finder, while its hue is changed."""
    with scene.run(FINDER) as process:
        screen = Projector(scene, process, SEEN, BALL, DRAWN)
        screen.begin()
        list_parameters(scene, FINDER)
        screen.show("before", shot(scene))
        change_parameter(scene, FINDER, HUE.name, GREEN)
        screen.show("hue", with_decoy(scene, GREEN, RED))
        screen.show("hue", shot(scene, hue=GREEN))
        screen.show("hue", at_the_window(scene, WINDOW - BESIDE))
        screen.show("other hue", at_the_window(scene, WINDOW + BESIDE))
        change_parameter(scene, FINDER, HUE.name, LAST_HUE)
        screen.show("across", shot(scene, hue=0))
        change_parameter(scene, FINDER, HUE.name, FIRST_HUE)
        screen.show("across", shot(scene, hue=175))
        for wrong in WRONG_HUE:
            change_parameter(scene, FINDER, HUE.name, wrong)


@experiment
def spoiled(scene: Scene) -> None:
    """The ball finder, while pictures come that are none."""
    with scene.run(FINDER, start=Start(parameters={HUE.name: GREEN})) as process:
        screen = Projector(scene, process, SEEN, BALL, DRAWN)
        screen.begin()
        screen.show("before", with_decoy(scene, GREEN, RED))
        screen.show_spoiled("short", "bgr8", missing=160 * 3 * 20, words=BAD_PICTURE)
        screen.show_spoiled("empty", "bgr8", missing=0, words=BAD_PICTURE, width=0)
        screen.show_spoiled("flat", "bgr8", missing=0, words=BAD_PICTURE, height=0)
        screen.show_spoiled("unknown", "16UC1", missing=0, words=BAD_PICTURE)
        screen.show("after", shot(scene, hue=GREEN))


# --- the package -------------------------------------------------------------------------------


test_well_formed = well_formed(CARD.build_type)


@check()
def test_depends(package: PackageView) -> None:
    """package.xml names every package that the code imports."""
    package.must(list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, with {CAMERA.executable} and {FINDER.executable}."""
    package.must(be_built_as(CARD.build_type), install([CAMERA.executable, FINDER.executable]))


# --- the camera --------------------------------------------------------------------------------


@check(needs=["builds"])
def test_camera_runs(filming: ExperimentView) -> None:
    """The camera node starts and runs until Ctrl-C."""
    filming.process(CAMERA).must(come_up, stay_up, outlast_the_soak)


@check(needs=["camera_runs"])
def test_camera_name(filming: ExperimentView) -> None:
    """Its node is called {CAMERA.node}."""
    filming.node(CAMERA).must(be_named)


@check(needs=["camera_runs"])
def test_camera_topic(filming: ExperimentView) -> None:
    """It publishes {IMAGE.type} on {IMAGE.topic}, as sensors do."""
    publisher = filming.publisher(CAMERA, IMAGE)
    publisher.must(be_there, be_the_only_one, carry_its_type, have_just_this_qos)


@check(needs=["camera_runs"])
def test_rate(filming: ExperimentView) -> None:
    """It publishes {IMAGE.rate.hz:g} pictures a second."""
    filming.topic(IMAGE).must(have_rate(IMAGE))


@check(needs=["camera_runs"])
def test_fields(filming: ExperimentView) -> None:
    """Each message says how its bytes are to be read, and has all of them."""
    filming.topic(IMAGE).must(hold_whole_rows, hold_its_fields)


@check(needs=["camera_runs"])
def test_stamp(filming: ExperimentView) -> None:
    """Each message says when it was made."""
    filming.topic(IMAGE).must(carry_its_time)


@check(needs=["fields"])
def test_picture(filming: ExperimentView) -> None:
    """The pictures are those of the camera, in the right colours."""
    filming.topic(IMAGE).must(show_what_the_camera_saw)


@check(needs=["picture"], explained_by={"rate": ("SentAgain", "Bursts")})
def test_every_picture(filming: ExperimentView) -> None:
    """Each picture that is read is published, once."""
    filming.topic(IMAGE).must(show_each_once(PICTURES))


@check(needs=["picture"])
def test_brightness(lighting: ExperimentView) -> None:
    """The parameter {BRIGHTNESS.name} acts while the node runs."""
    lighting.must(follow_brightness(CAMERA, IMAGE, BRIGHTNESS, NEUTRAL, LEVELS))


@check(needs=["camera_topic"])
def test_no_camera(unplugged: ExperimentView) -> None:
    """Without a camera the node says why, and goes on when there is one."""
    unplugged.process(CAMERA).must(during("when no camera is there", come_up))
    unplugged.must(
        tell_of_trouble(CAMERA, "missing", "no camera at the start", MISSING),
        tell_of_trouble(CAMERA, "forbidden", "a camera that you may not use", FORBIDDEN),
        tell_of_trouble(CAMERA, "busy", "a camera that another program uses", BUSY),
        come_after("there", "when the camera is free", IMAGE, RETRIES_WITHIN_S),
        tell_of_trouble(CAMERA, "gone", "a camera that was pulled out", GONE),
        come_after("there again", "when the camera is plugged in again", IMAGE, RETRIES_WITHIN_S),
    )


@check(needs=["brightness", "no_camera"])
def test_light_at_start(unplugged: ExperimentView) -> None:
    """A {BRIGHTNESS.name} that is given at the start counts from the first picture."""
    unplugged.topic(IMAGE).must(begin_so_light(BRIGHTNESS.name, LIGHT, NEUTRAL, LEVELS))


# --- the ball finder ---------------------------------------------------------------------------


@check(needs=["builds"])
def test_finder_runs(looking: ExperimentView) -> None:
    """The ball finder starts, makes a node and runs on."""
    looking.process(FINDER).must(come_up, outlast_the_soak)


@check(needs=["finder_runs"])
def test_finder_name(looking: ExperimentView) -> None:
    """Its node is called {FINDER.node}."""
    looking.node(FINDER).must(be_named)


@check(needs=["finder_runs"])
def test_finder_topics(looking: ExperimentView) -> None:
    """It hears {SEEN.topic}, and publishes {BALL.topic} and {DRAWN.topic}."""
    looking.subscription(FINDER, SEEN).must(be_there, carry_its_type, match_qos)
    for topic in (BALL, DRAWN):
        looking.publisher(FINDER, topic).must(be_there, be_the_only_one, carry_its_type, match_qos)


@check(needs=["finder_runs"])
def test_ball(looking: ExperimentView) -> None:
    """It finds the ball, within {WITHIN:g} pixels."""
    looking.must(find_the_ball(SCREEN, "ball"))


@check(needs=["ball"])
def test_no_ball(looking: ExperimentView, retuning: ExperimentView) -> None:
    """Where there is no ball of its colour, it finds none."""
    looking.must(find_nothing(SCREEN, "none"))
    retuning.must(find_nothing(SCREEN, "other hue"))


@check(needs=["ball"])
def test_encodings(looking: ExperimentView) -> None:
    """It reads rgb8 and mono8 as well."""
    looking.must(find_the_ball(SCREEN, "rgb8"), find_nothing(SCREEN, "mono8"))


@check(needs=["ball"])
def test_rows(looking: ExperimentView) -> None:
    """It reads pictures of any size, also with idle bytes in their rows."""
    looking.must(cut_its_rows(SCREEN, "rows"), call_none_bad(SCREEN, "ball", "rows"))


@check(needs=["finder_runs"])
def test_carries(looking: ExperimentView) -> None:
    """Each answer has the header of its picture."""
    looking.must(carry_the_header(SCREEN, PARTS))


@check(needs=["finder_runs"])
def test_one_answer(looking: ExperimentView) -> None:
    """Each picture is answered once on each topic."""
    looking.must(answer_once(SCREEN, PARTS))


@check(needs=["ball"])
def test_ball_image(looking: ExperimentView) -> None:
    """Each picture comes back, with a ring around the ball."""
    looking.must(draw_on_each(SCREEN, PLAIN_PARTS))


@check(needs=["ball"])
def test_hue(retuning: ExperimentView) -> None:
    """The parameter {HUE.name} acts while the node runs."""
    retuning.must(follow_the_hue(SCREEN, "hue", "across"))


@check(needs=["hue"])
def test_hue_at_start(spoiled: ExperimentView) -> None:
    """A {HUE.name} that is given at the start counts from the first picture."""
    spoiled.must(begin_with_the_hue(SCREEN, "before"))


@check(needs=["ball", "hue_at_start"])
def test_bad_pictures(spoiled: ExperimentView) -> None:
    """A picture with too few bytes is told in the log, once, and the node goes on."""
    spoiled.must(
        survive(SCREEN, "short", "a picture with fewer bytes than its header says", must_say=True),
        answer_nothing(SCREEN, "short", "a picture with fewer bytes than its header says"),
        survive(SCREEN, "empty", "a picture without a single column", must_say=False),
        survive(SCREEN, "flat", "a picture without a single row", must_say=False),
        survive(SCREEN, "unknown", "a picture in an unknown encoding (16UC1)", must_say=False),
        tell_once(SCREEN, SPOILED_PARTS),
        find_the_ball(SCREEN, "after"),
    )


# --- both --------------------------------------------------------------------------------------


@check(needs=["camera_runs", "finder_runs"], explained_by={"no_camera": "DidNotComeUp"})
def test_parameters(untold: ExperimentView, retuning: ExperimentView) -> None:
    """Both nodes have the parameters of the card, with their types and defaults."""
    untold.process(CAMERA).must(during("when nobody sets a parameter", come_up))
    untold.must(declare_its_parameters(CAMERA))
    retuning.must(declare_its_parameters(FINDER))


@check(needs=["brightness", "hue"])
def test_refuses(lighting: ExperimentView, retuning: ExperimentView) -> None:
    """Both nodes refuse values that a parameter cannot have."""
    lighting.must(refuse(CAMERA, BRIGHTNESS))
    retuning.must(refuse(FINDER, HUE))


@check(needs=["camera_runs", "finder_runs"])
def test_ends(filming: ExperimentView, retuning: ExperimentView) -> None:
    """Both nodes end within {CARD.ends_within_s:g} s of Ctrl-C."""
    filming.process(CAMERA).must(end_within(CARD.ends_within_s))
    retuning.process(FINDER).must(end_within(CARD.ends_within_s))


@check(needs=["ends"])
def test_clean_exit(filming: ExperimentView, retuning: ExperimentView) -> None:
    """After Ctrl-C both nodes end without an error."""
    filming.process(CAMERA).must(stay_up, exit_cleanly)
    retuning.process(FINDER).must(stay_up, exit_cleanly)
