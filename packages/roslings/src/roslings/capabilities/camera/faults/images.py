"""Faults of a node that publishes what a camera sees."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault

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

    @property
    def measured(self) -> str:
        """What is there."""
        return f"step is {self.found}{_guess_of_step(self.found, self.wanted)}"


def _guess_of_step(found: int, wanted: int) -> str:
    guesses = {wanted // 3: ": the width, without the channels", 0: ": nobody filled it"}
    return guesses.get(found, "")


@dataclass(eq=False)
class NotAllBytes(Fault):
    """The bytes are fewer or more than the header says."""

    topic: str
    wanted: int
    found: int
    why = "Who reads the picture believes its header, and reads beyond the end of the bytes."
    hint = "How many bytes do you publish, and how many does such a picture have?"
    mend = "data holds step x height bytes: all rows of the picture, one behind the other."
    expected = "on {topic}, data has step x height = {wanted} bytes"
    measured = "it has {found} bytes"


@dataclass(eq=False)
class WrongPicture(Fault):
    """The picture is not the one that the camera gave."""

    topic: str
    off: float | None
    why = "Every node that looks through this camera sees only what you publish."
    hint = f"Compare it with what camera.read() gave. {OPEN_THE_PAGE} there is your picture."
    mend = "Publish what camera.read() gave: all rows, all columns, in their order."
    expected = "on {topic}, the pictures of the camera"

    @property
    def measured(self) -> str:
        """How far off it is."""
        if self.off is None:
            return "bytes that are no picture of this size"
        return f"another picture: its values are off by {self.off:.0f} of 255 on average"


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

    @property
    def measured(self) -> str:
        """What the node said."""
        return f"the node refuses: {self.reason}" if self.reason else "the node does not answer"


@dataclass(eq=False)
class ParameterAccepted(Fault):
    """A value that is wrong was taken."""

    node: str
    name: str
    value: str
    span: str
    why = "A wrong value must not stop a robot that runs. Refuse it where it comes in."
    hint = (
        "Who refuses a value that is out of the card's limits? Look at what declare_parameter gets."
    )
    mend = (
        "Give limits to declare_parameter: ParameterDescriptor(integer_range=[IntegerRange("
        "from_value=..., to_value=..., step=1)]). The type is that of the default."
    )
    expected = "{node} refuses {name} = {value} ({span})"
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

    @property
    def expected(self) -> str:
        """How much lighter."""
        return (
            f"when {self.name} goes from {self.before} to {self.after}, each value of the picture"
            f" becomes {_change(self.wanted)}, {'up to 255' if self.wanted > 0 else 'down to 0'}"
        )

    @property
    def measured(self) -> str:
        """How much lighter they became."""
        return f"on average, the values became {_change(self.found)}"


def _change(levels: float) -> str:
    return f"{abs(levels):.0f} {'higher' if levels >= 0 else 'lower'}"


@dataclass(eq=False)
class LightAtStartIgnored(WrongBrightness):
    """The node was started with a value, and its pictures have another light."""

    why = "Who starts the robot chooses its settings then: nobody is there to set them later."
    hint = "When does your code read the parameter for the first time?"
    mend = (
        "Read the parameter for each picture: self.get_parameter(NAME).value. A variable that only"
        " a change sets does not know the value of the start."
    )

    @property
    def expected(self) -> str:
        """The light from the first picture on."""
        return (
            f"started with `-p {self.name}:={self.after}`, each value of each picture is"
            f" {_change(self.wanted)} than the camera's"
        )

    @property
    def measured(self) -> str:
        """The light that it had."""
        return f"there were pictures that are {_change(self.found)}"


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

    @property
    def measured(self) -> str:
        """What it wrote."""
        return f"it wrote {self.similar!r}" if self.similar else "it wrote no such line"


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
