"""Faults of a node that publishes what a camera sees."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import one_of, plural

OPEN_THE_PAGE = "Check again with `--html page.html` behind the command, and open page.html:"
"""The page shows the pictures that a verdict is about."""


@dataclass(eq=False)
class WrongStep(Fault):
    """The step is not the length of a row."""

    topic: str
    wanted: int
    found: int
    why = "Who reads the picture goes on by `step` bytes to find the next row."
    hint = "What does step count? Take one row of your picture."
    mend = "step is the bytes of one row: width x channels. bgr8 has 3 channels, each one byte."
    expected = "on {topic}, step is {wanted}"

    measured = one_of(
        width="step is {found}: the width, without the channels",
        empty="step is {found}: nobody filled it",
        other="step is {found}",
    )

    @property
    def which_measured(self) -> str:
        """What it probably is."""
        return {self.wanted // 3: "width", 0: "empty"}.get(self.found, "other")


@dataclass(eq=False)
class NotAllBytes(Fault):
    """The bytes are fewer or more than the header says."""

    topic: str
    wanted: int
    found: int
    why = "Who reads the picture believes its header, and reads beyond the end of the bytes."
    hint = "How many bytes do you publish, and how many does such a picture have?"
    mend = "data holds step x height bytes: all rows of the picture, one behind the other."
    expected = plural(
        "wanted",
        one="on {topic}, data has step x height = {wanted} byte",
        other="on {topic}, data has step x height = {wanted} bytes",
    )
    measured = plural("found", one="it has {found} byte", other="it has {found} bytes")


@dataclass(eq=False)
class WrongPicture(Fault):
    """The picture is not the one that the camera gave."""

    topic: str
    off: float | None
    why = "Every node that looks through this camera sees only what you publish."
    hint = f"Compare it with what camera.read() gave. {OPEN_THE_PAGE} there is your picture."
    mend = "Publish what camera.read() gave: all rows, all columns, in their order."
    expected = "on {topic}, the pictures of the camera"

    measured = one_of(
        no_picture="bytes that are no picture of this size",
        another="another picture: its values are off by {off:.0f} of 255 on average",
    )

    @property
    def which_measured(self) -> str:
        """Whether it is a picture at all."""
        return "no_picture" if self.off is None else "another"


@dataclass(eq=False)
class RedAndBlueSwapped(WrongPicture):
    """Red looks blue and blue looks red."""

    hint = "In which order does the camera give the colours, and what does your encoding say?"
    mend = (
        "OpenCV has blue first, and so has the camera: that is bgr8. Take cv2.cvtColor away, or"
        " let the encoding say what the bytes are."
    )
    measured = "the right picture, with red and blue exchanged"


@dataclass(eq=False)
class PictureTwice(Fault):
    """One picture of the camera is published again."""

    topic: str
    share: float
    why = "A robot that sees the past believes that the way is free."
    hint = "How often is the camera read, and how often do you publish?"
    mend = (
        "Call camera.read() each time before you publish. Keep no old picture and no old message."
    )
    expected = "on {topic}, a new picture each time"
    measured = "{share:.0%} of the messages show the same picture as the one before"


@dataclass(eq=False)
class PicturesLost(Fault):
    """Pictures that were read are not published."""

    topic: str
    share: float
    why = "Each picture that is read costs time. A lost one may be the one with the ball."
    hint = "How often is the camera read, and how often do you publish?"
    mend = "Call camera.read() once for each message, and publish what it gave."
    expected = "on {topic}, each picture that the node reads from the camera"
    measured = "{share:.0%} of the pictures that the node read were not published"


@dataclass(eq=False)
class ParameterNotSet(Fault):
    """A parameter could not be set while the node ran."""

    node: str
    name: str
    value: str
    reason: str
    why = "Who tunes a robot does so while it runs, and watches what happens."
    hint = "Which parameters does your node declare? `ros2 param list` tells, while the node runs."
    mend = "Call self.declare_parameter(NAME, DEFAULT) in __init__, with the name of the card."
    expected = "`ros2 param set {node} {name} {value}` works"

    measured = one_of(refused="the node refuses: {reason}", unanswered="the node does not answer")

    @property
    def which_measured(self) -> str:
        """Whether the node said anything."""
        return "refused" if self.reason else "unanswered"


@dataclass(eq=False)
class ParameterAccepted(Fault):
    """A value that is wrong was taken."""

    node: str
    name: str
    value: str
    type: str
    least: float
    most: float
    why = "A wrong value must not stop a robot that runs. Refuse it where it comes in."
    hint = (
        "Who refuses a value that is out of the card's limits? Look at what declare_parameter gets."
    )
    mend = (
        "Give limits to declare_parameter: ParameterDescriptor(integer_range=[IntegerRange("
        "from_value=..., to_value=..., step=1)]). The type is that of the default."
    )
    expected = "{node} refuses {name} = {value} ({type}, {least:g} to {most:g})"
    measured = "the value was taken"


@dataclass(eq=False)
class EndedByParameter(ParameterAccepted):
    """The node ended when a wrong value came."""

    hint = "Read the last lines below. Raise nothing for a wrong value: let ROS refuse it."
    measured = "the node ended"


@dataclass(eq=False)
class WrongBrightness(Fault):
    """The brightness does not do what the card says."""

    name: str
    before: int
    after: int
    wanted: float
    found: float
    why = "A program that finds things by their colour fails in a light that it does not know."
    hint = "Take one value of the picture, and go through your code with it by hand."
    mend = (
        "For each point above the neutral value, add the levels of the card to every value of the"
        " picture. cv2.add stops at 0 and at 255."
    )

    expected = one_of(
        higher="when {name} goes from {before} to {after}, each value of the picture becomes"
        " {wanted_levels:.0f} higher, up to 255",
        same="when {name} goes from {before} to {after}, each value of the picture becomes"
        " {wanted_levels:.0f} higher, down to 0",
        lower="when {name} goes from {before} to {after}, each value of the picture becomes"
        " {wanted_levels:.0f} lower, down to 0",
    )
    measured = one_of(
        higher="on average, the values became {found_levels:.0f} higher",
        lower="on average, the values became {found_levels:.0f} lower",
    )

    @property
    def which_expected(self) -> str:
        """Lighter or darker."""
        return "same" if self.wanted == 0 else "higher" if self.wanted > 0 else "lower"

    @property
    def which_measured(self) -> str:
        """Lighter or darker."""
        return "higher" if self.found >= 0 else "lower"

    @property
    def wanted_levels(self) -> float:
        """By how much they should change."""
        return abs(self.wanted)

    @property
    def found_levels(self) -> float:
        """By how much they changed."""
        return abs(self.found)


@dataclass(eq=False)
class LightAtStartIgnored(WrongBrightness):
    """The node was started with a value, and its pictures have another light."""

    why = "Who starts the robot chooses its settings then: nobody is there to set them later."
    hint = "When does your code read the parameter for the first time?"
    mend = (
        "Read the parameter for each picture: self.get_parameter(NAME).value. A variable that only"
        " a change sets does not know the value of the start."
    )

    expected = one_of(
        higher="started with `-p {name}:={after}`, each value of each picture is"
        " {wanted_levels:.0f} higher than the camera's",
        lower="started with `-p {name}:={after}`, each value of each picture is"
        " {wanted_levels:.0f} lower than the camera's",
    )
    measured = one_of(
        higher="there were pictures that are {found_levels:.0f} higher",
        lower="there were pictures that are {found_levels:.0f} lower",
    )

    @property
    def which_expected(self) -> str:
        """Lighter or darker."""
        return "higher" if self.wanted >= 0 else "lower"


@dataclass(eq=False)
class BrightnessIgnored(WrongBrightness):
    """Nothing happens."""

    hint = "When does your code read the parameter?"
    mend = (
        "Read the parameter for each picture: self.get_parameter(NAME).value. What __init__ read"
        " stays as it was then."
    )
    measured = "the pictures stayed as they were"


@dataclass(eq=False)
class BrightnessGoesRound(WrongBrightness):
    """Values beyond 255 begin again at 0."""

    hint = "What becomes of 250 + 10 in a number of 8 bits?"
    mend = (
        "A value of 8 bits goes round: 250 + 10 is 4. Use cv2.add(picture, (n, n, n, 0)), which"
        " stops at 0 and at 255. cv2.convertScaleAbs makes -20 to 20."
    )
    measured = "values beyond 255 began again at 0, or values below 0 at 255"


@dataclass(eq=False)
class SilentAboutCamera(Fault):
    """The camera cannot be used, and the node does not say so."""

    when: str
    line: str
    reason: str
    similar: str | None
    why = "Nobody can mend what a program does not tell. A robot has no screen: only its log."
    hint = "What does your code do when the camera cannot be opened or read?"
    mend = (
        "except OSError as error: log the line of the card with str(error) in it, each time."
        " It names the device and the reason."
    )
    expected = "{when}: a line {line!r} with the device and {reason!r} in it"

    measured = one_of(another="it wrote {similar!r}", none="it wrote no such line")

    @property
    def which_measured(self) -> str:
        """Whether any line is like it."""
        return "another" if self.similar else "none"


@dataclass(eq=False)
class EndedWithoutCamera(SilentAboutCamera):
    """The node ended."""

    hint = "Read the last lines below: the last one names the error, the one above it the place."
    mend = (
        "Read the last lines below. Catch OSError where you open the camera and where you read"
        " it. Then try again from a timer."
    )
    measured = "the node ended"


@dataclass(eq=False)
class NoPictureAfter(Fault):
    """The camera is there, and no picture comes."""

    when: str
    topic: str
    why = "Plugs come loose on a robot that drives. Nobody is there to start the node again."
    hint = "What does your node do after the camera had an error? Who opens it again?"
    mend = (
        "After an OSError, close the camera and set self.camera to None. A timer opens it again"
        " where it is None."
    )
    expected = "pictures on {topic} {when}"
    measured = "none came"


@dataclass(eq=False)
class TriesSeldom(Fault):
    """Pictures come again, and late."""

    when: str
    topic: str
    within_s: float
    took_s: float
    why = "A robot that stands for want of a picture stands in somebody's way."
    hint = "What opens the camera again, and how often?"
    mend = "Open the camera from a timer of its own, with a period below two seconds."
    expected = "{when}: a new try within {within_s:g} s, so pictures on {topic}"
    measured = "the first one came after {took_s:.1f} s"
