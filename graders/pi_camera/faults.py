"""Faults of a node that looks for something in the pictures that it is shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.capabilities.camera.faults.images import OPEN_THE_PAGE
from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural

# --- parts of sentences ------------------------------------------------------------------------


@dataclass(frozen=True)
class Picture(SentencePart):
    """A picture that was shown to the node."""

    has_ball: bool
    encoding: str
    size_px: tuple[int, int]
    idle: int
    """Bytes at the end of each row that are no pixels."""
    text = one_of(
        ball="a picture with a ball ({encoding}, {size_px[0]} x {size_px[1]})",
        no_ball="a picture with no ball ({encoding}, {size_px[0]} x {size_px[1]})",
        ball_idle=plural(
            "idle",
            one="a picture with a ball ({encoding}, {size_px[0]} x {size_px[1]}, {idle} idle byte a"
            " row)",
            other="a picture with a ball ({encoding}, {size_px[0]} x {size_px[1]}, {idle} idle"
            " bytes a row)",
        ),
        no_ball_idle=plural(
            "idle",
            one="a picture with no ball ({encoding}, {size_px[0]} x {size_px[1]}, {idle} idle byte"
            " a row)",
            other="a picture with no ball ({encoding}, {size_px[0]} x {size_px[1]}, {idle} idle"
            " bytes a row)",
        ),
    )

    @property
    def which_text(self) -> str:
        """What is in it, and whether its rows have idle bytes."""
        ball = "ball" if self.has_ball else "no_ball"
        return f"{ball}_idle" if self.idle else ball


@dataclass(frozen=True)
class OtherStamp(SentencePart):
    """A stamp that is not its picture's."""

    found_s: float
    later_s: float
    """Than the picture's; below 0 it is earlier."""
    text = one_of(
        empty="it is 0: nobody filled it",
        later="it is {found_s:.3f} s: {off_s:.3f} s later",
        earlier="it is {found_s:.3f} s: {off_s:.3f} s earlier",
    )

    @property
    def which_text(self) -> str:
        """What is wrong with it."""
        return "empty" if not self.found_s else "later" if self.later_s > 0 else "earlier"

    @property
    def off_s(self) -> float:
        """By how much."""
        return abs(self.later_s)


@dataclass(frozen=True)
class Empty(SentencePart):
    """A text that nobody filled."""

    text = "it is empty"


DrawingKind = Literal["size", "bytes", "swapped", "no_ring", "another"]


@dataclass(frozen=True)
class Drawing(SentencePart):
    """What is the matter with a picture that came back."""

    kind: DrawingKind
    width: int
    height: int
    encoding: str
    bytes: int
    step: int
    text = one_of(
        size="it says {width} x {height} in {encoding}",
        bytes=plural(
            "bytes",
            one="it has {bytes} byte, and a step of {step}",
            other="it has {bytes} bytes, and a step of {step}",
        ),
        swapped="its red and its blue are exchanged",
        no_ring="there is no ring around the ball",
        another="it is another picture than the one that was shown",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.kind


# --- the faults --------------------------------------------------------------------------------


@dataclass(eq=False)
class WrongPlace(Fault):
    """The ball is elsewhere."""

    topic: str
    picture: Text
    wanted: tuple[float, float]
    found: tuple[float, float]
    within: float
    why = "The robot drives to where you say the ball is."
    hint = (
        f"{OPEN_THE_PAGE} the ring is the ball, the cross is your answer. x is the column, y the"
        " row, from the upper left corner."
    )

    expected = (
        "{picture}: on {topic} x {wanted[0]:.1f}, y {wanted[1]:.1f}, within {within:g} pixels"
    )
    measured = "x {found[0]:.1f}, y {found[1]:.1f}"


@dataclass(eq=False)
class XAndYSwapped(WrongPlace):
    """Column and row are exchanged."""

    hint = (
        "Which of your two numbers is the column, and which the row? Follow both from the "
        "mask to the message."
    )
    mend = (
        "numpy counts rows first: picture[row, column]. OpenCV's functions give x first: (column,"
        " row). x is the column."
    )
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: x and y are exchanged"


@dataclass(eq=False)
class CornerNotCentre(WrongPlace):
    """The corner of the box around the ball."""

    hint = "Which point of the ball's box do you publish?"
    mend = "cv2.boundingRect gives the upper left corner. Add half of the width and the height."
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: the corner of the box around the ball"


@dataclass(eq=False)
class FromTheMiddle(WrongPlace):
    """Counted from the centre of the picture."""

    hint = "From where does your code count?"
    mend = "Count from the upper left corner of the picture, to the right and down."
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: counted from the middle of the picture"


@dataclass(eq=False)
class NotAFloat(WrongPlace):
    """A number that is no Python float came out as nonsense."""

    hint = "Of which kind is the value that goes into the point? Print its type."
    mend = (
        "The fields of a Point are floats. A whole number, or one of numpy's own kinds, comes out"
        " as nonsense: write float(VALUE)."
    )

    measured = "x {found[0]:g}, y {found[1]:g}: that is no number of yours"


@dataclass(eq=False)
class FoundTheDecoy(WrongPlace):
    """The ball of another colour."""

    hint = "Which of the two balls is asked for? Look at how your code compares their hues."
    mend = (
        "There are two balls: take the one whose hue is nearest to ball_hue. Hues are 0 to 179 in"
        " OpenCV, half of the degrees that others count."
    )
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: there is a ball of another colour"


@dataclass(eq=False)
class RedAndBlueExchanged(FoundTheDecoy):
    """In rgb8, a blue ball was taken for the red one."""

    hint = "In which order are the colours of this picture? Look at image.encoding."
    mend = (
        "Look at image.encoding: rgb8 has red first. Turn it into bgr8 with cv2.cvtColor, before"
        " you make hues of it."
    )
    measured = (
        "x {found[0]:.1f}, y {found[1]:.1f}: the other ball, which is yours when red and blue are"
        " exchanged"
    )


@dataclass(eq=False)
class HueIgnored(FoundTheDecoy):
    """The parameter was set, and the ball of the old colour is found."""

    hint = "When does your code read the parameter?"
    mend = (
        "Read the parameter for each picture: self.get_parameter('ball_hue').value. What __init__"
        " read stays as it was then."
    )
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: the ball of the colour before"
    expected = (
        "after ball_hue was set, {picture}: on {topic} x {wanted[0]:.1f}, y {wanted[1]:.1f}, within"
        " {within:g} pixels"
    )


@dataclass(eq=False)
class HueAtStartIgnored(FoundTheDecoy):
    """The node was started with another hue, and looks for that of the card."""

    hint = "When does your code read the parameter for the first time?"
    mend = (
        "Read the parameter for each picture: self.get_parameter('ball_hue').value. A variable that"
        " only a change sets does not know the value of the start."
    )
    measured = "x {found[0]:.1f}, y {found[1]:.1f}: the ball of the default colour"
    expected = (
        "started with another ball_hue, {picture}: on {topic} x {wanted[0]:.1f}, y {wanted[1]:.1f},"
        " within {within:g} pixels"
    )


@dataclass(eq=False)
class NotFound(Fault):
    """There is a ball, and the node says nothing."""

    topic: str
    picture: Text
    why = "A ball that is not seen is a ball that is run over."
    hint = (
        "Save the mask of this picture (cv2.imwrite) and look at it. Is the ball white in it?"
        " If not: which limit is too narrow, hue (0 to 179 in OpenCV), saturation or value?"
    )
    expected = "{picture}: the ball, on {topic}"
    measured = "the node looked at the picture and found nothing"


@dataclass(eq=False)
class NotFoundAcrossTheEnd(NotFound):
    """The hue of the ball lies beyond the end of the wheel."""

    why = "Red lies at both ends of OpenCV's hues. Half of all red things have a hue above 170."
    hint = "Which hues does your code search? Look at both ends of the scale, 0 and 179."
    mend = (
        "The wheel of hues is round: 179 and 0 are neighbours. Measure both ways round, and take"
        " the shorter one: min(away, 180 - away). Or use two ranges."
    )


@dataclass(eq=False)
class Unanswered(Fault):
    """The node does nothing with a picture."""

    topic: str
    picture: Text
    why = "Who waits for an answer waits for ever."
    hint = "Is the function of your subscription reached? Log a line in it, and see."
    expected = "{picture}: a message on {topic}"
    measured = "the node published nothing"


@dataclass(eq=False)
class TooSlowForPictures(Unanswered):
    """It works on one picture for seconds."""

    hint = "How often does Python run through a loop for one picture?"
    mend = "Do not go through the pixels in a Python loop: numpy and cv2 do all of them at once."
    measured = "the node still worked on it after many seconds"


@dataclass(eq=False)
class EndedByPicture(Unanswered):
    """The node ended when the picture came."""

    hint = "Read the last lines below: the last one says what went wrong, the one above where."
    measured = "the node ended with an error"


@dataclass(eq=False)
class RowsNotCut(EndedByPicture):
    """A picture whose rows have idle bytes."""

    why = "Many cameras fill up their rows, for example to a multiple of 64 bytes."
    hint = "How many bytes has one row of this picture? Compare image.step with the width."
    mend = (
        "One row has `step` bytes, which can be more than width x channels. Make rows first:"
        " reshape(height, step). Then cut: [:, :width * channels]. Then make columns."
    )

    measured = one_of(
        ended="the node ended with an error: the idle bytes at the end of each row were taken for"
        " pixels",
        wrong="the idle bytes at the end of each row were taken for pixels",
    )

    @property
    def which_measured(self) -> str:
        """What it did with them."""
        return "ended" if self.log else "wrong"


@dataclass(eq=False)
class FoundWhereNothingIs(Fault):
    """A ball was found in a picture without one."""

    topic: str
    picture: Text
    found: tuple[float, float]
    why = "The robot drives to a ball that is not there."
    expected = "{picture}: nothing on {topic}"

    hint = "What does your code do where the mask is empty? And what does noise leave in the mask?"

    mend = one_of(
        origin="Where your search finds nothing, publish no message: 0, 0 is a place, too.",
        noise="Noise has every hue, but grey has little saturation: ask for more of it. Take single"
        " dots away (MORPH_OPEN), and ask for a least size.",
    )
    measured = "a ball at x {found[0]:.1f}, y {found[1]:.1f}"

    @property
    def which_mend(self) -> str:
        """The place that stands for none, or what noise looks like."""
        return "origin" if self.found == (0.0, 0.0) else "noise"


@dataclass(eq=False)
class StampNotCarried(Fault):
    """The answer does not have the header of its picture."""

    topic: str
    what: str
    wanted: str
    found: Text
    why = (
        "An answer comes later than its picture. Only by the stamp does anyone know where the"
        " robot was when the picture was made."
    )
    hint = "Where does the header of your answer come from?"
    mend = "Copy the whole header: ANSWER.header = image.header"
    expected = "on {topic}, {what} of the picture: {wanted}"

    measured = "{found}"


@dataclass(eq=False)
class WrongDrawing(Fault):
    """The picture that comes back is not the one that was shown."""

    topic: str
    picture: Text
    what: Drawing
    why = "This picture is what a person looks at, to see what the robot thinks."
    hint = "Compare each field of the picture that you publish with the picture that you drew on."
    mend = (
        "Draw with cv2.circle on the picture in bgr8, and publish that: its width, its height,"
        " step = width x 3, and all its bytes."
    )
    expected = "{picture}: on {topic} the same picture, with a ring around the ball"

    measured = "{what}"


@dataclass(eq=False)
class CalledBad(Fault):
    """A good picture, and a line that it is bad."""

    picture: Text
    line: str
    why = "The size of a picture may be another one each time. Who reads this blames the camera."
    expected = "{picture}: no line in the log"
    measured = "it wrote {line!r}"
    hint = "From which message are the numbers that you compare with its bytes?"
    mend = "Read width, height, step and data of the same message, each time."


@dataclass(eq=False)
class SilentAboutPicture(Fault):
    """A bad picture, and no word about it."""

    picture: Text
    line: str
    similar: str | None
    why = "A camera with a broken driver sends such pictures. Without a word nobody finds out."
    hint = "What does your code look at before it uses the bytes of a picture?"
    mend = (
        "Compare len(image.data) with image.step * image.height before you use the bytes, and log"
        " the line of the card."
    )
    expected = "{picture}: a line {line!r}"

    measured = one_of(another="it wrote {similar!r}", none="it wrote no such line")

    @property
    def which_measured(self) -> str:
        """Whether any line is like it."""
        return "another" if self.similar else "none"


@dataclass(eq=False)
class AnsweredTwice(Fault):
    """One picture has several answers."""

    topic: str
    picture: Text
    count: int
    why = "Who hears an answer takes it for news: one ball becomes two."
    hint = "From how many places in your code is publish() called, and how often?"
    mend = "Call publish() once for each picture, in the function that hears it, and in no timer."
    expected = "{picture}: one message on {topic}"
    measured = plural("count", one="{count} message", other="{count} messages")


@dataclass(eq=False)
class AnswersBadPicture(Fault):
    """Something is published after a picture that is none."""

    picture: Text
    topic: str
    why = "Who gets the answer believes it, and cannot know that the picture was broken."
    hint = "What does your function do after it has written the line?"
    mend = "After the line in the log, return: no place, and no drawing."
    expected = "{picture}: nothing on {topic}"
    measured = "a message came"


@dataclass(eq=False)
class HasDepth(Fault):
    """The place has a z."""

    topic: str
    picture: Text
    found: float
    why = "A place in a picture has a column and a row. z is free, so it stays 0."
    hint = "Which fields of the point does your code fill?"
    mend = "Fill point.x and point.y only. The radius of the ball is no part of its place."
    expected = "{picture}: on {topic} z 0"
    measured = "z {found:g}"
