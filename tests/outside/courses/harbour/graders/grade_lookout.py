"""What counts as done in this lab: pictures of the sea, as light as others want them."""

from roslings.capabilities.camera.act import GONE, MISSING, camera_beside, change_parameter
from roslings.capabilities.camera.demands import (
    come_after,
    follow_brightness,
    hold_whole_rows,
    refuse,
    show_what_the_camera_saw,
    tell_of_trouble,
)
from roslings.capabilities.parameters.contract import ParameterWords
from roslings.capabilities.topics.relay import hold_its_fields
from roslings.course import lab
from roslings.experiment import Scene, experiment
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

CARD = lab("lookout").card
LOOKOUT = CARD.node("lookout")
SEA, (LENS, LIGHT) = LOOKOUT.publishes[0], LOOKOUT.of(ParameterWords).parameters
AS_IT_IS, LEVELS = LOOKOUT.constant("as_it_is"), LOOKOUT.constant("levels")
LIT = (LIGHT.tried, *LIGHT.ends)
PICTURES, LOOKS_AGAIN_WITHIN_S = 6, 2.0


@experiment
def filming(scene: Scene) -> None:
    """The lookout alone."""
    with (
        camera_beside(scene, SEA, parameter=LENS.name) as camera,
        scene.run(LOOKOUT, start=camera.start()),
    ):
        camera.await_pictures(PICTURES)


@experiment
def lighting(scene: Scene) -> None:
    """The lookout, while its light is changed."""
    with (
        camera_beside(scene, SEA, parameter=LENS.name) as camera,
        scene.run(LOOKOUT, start=camera.start()),
    ):
        for value in LIT:
            camera.expect_lighter((value - AS_IT_IS) * LEVELS)
        camera.await_pictures(PICTURES)
        for value in LIT:
            if change_parameter(scene, LOOKOUT, LIGHT.name, value):
                camera.await_pictures(PICTURES)
        for wrong in LIGHT.beyond:
            change_parameter(scene, LOOKOUT, LIGHT.name, wrong)


@experiment
def blinded(scene: Scene) -> None:
    """A lens that is missing, there, gone, and there again."""
    with camera_beside(scene, SEA, plugged_in=False, parameter=LENS.name) as camera:
        camera.begin("missing")
        with scene.run(LOOKOUT, start=camera.start()) as process:
            camera.await_trouble(process, *MISSING)
            camera.begin("there")
            camera.refuse(0)
            camera.await_return(2)
            camera.begin("gone")
            camera.camera.unplug()
            camera.await_trouble(process, *GONE)
            camera.begin("there again")
            camera.camera.plug_in()
            camera.await_return(2)


@check()
def test_well_formed(package: PackageView) -> None:
    """The package has all its files, and ROS and Python can read them."""
    package.must(be_well_formed(CARD.build_type), list_what_it_imports)


@check(needs=["well_formed"])
def test_builds(package: PackageView) -> None:
    """colcon builds it, and `ros2 run` finds {LOOKOUT.executable}."""
    package.must(be_built_as(CARD.build_type), install([LOOKOUT.executable]))


@check(needs=["builds"])
def test_runs(filming: ExperimentView) -> None:
    """The node starts and runs until Ctrl-C."""
    filming.process(LOOKOUT).must(come_up, stay_up)


@check(needs=["runs"])
def test_rows(filming: ExperimentView) -> None:
    """Each message says how its bytes are to be read, and has all of them."""
    filming.topic(SEA).must(hold_whole_rows, hold_its_fields)


@check(needs=["rows"])
def test_picture(filming: ExperimentView) -> None:
    """The pictures are those of the camera, in the right colours."""
    filming.topic(SEA).must(show_what_the_camera_saw)


@check(needs=["picture"])
def test_light(lighting: ExperimentView) -> None:
    """The parameter {LIGHT.name} acts while the node runs."""
    lighting.must(follow_brightness(LOOKOUT, SEA, LIGHT, AS_IT_IS, LEVELS))


@check(needs=["light"])
def test_refuses(lighting: ExperimentView) -> None:
    """{LIGHT.name} is {LIGHT.span}; all else is refused."""
    lighting.must(refuse(LOOKOUT, LIGHT))


@check(needs=["runs"])
def test_troubles(blinded: ExperimentView) -> None:
    """Without a lens the node says why, and goes on when there is one."""
    blinded.must(
        tell_of_trouble(LOOKOUT, "missing", "no lens at the start", MISSING),
        come_after("there", "when the lens is there", SEA, LOOKS_AGAIN_WITHIN_S),
        tell_of_trouble(LOOKOUT, "gone", "a lens that was taken away", GONE),
        come_after("there again", "when the lens is back", SEA, LOOKS_AGAIN_WITHIN_S),
    )


@check(needs=["runs"])
def test_ends(filming: ExperimentView) -> None:
    """The node ends within {CARD.ends_within_s:g} s of Ctrl-C."""
    filming.process(LOOKOUT).must(end_within(CARD.ends_within_s))
