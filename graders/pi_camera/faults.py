"""Faults of a node that looks for something in the pictures that it is shown."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.capabilities.camera.faults.images import OPEN_THE_PAGE
from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class WrongPlace(Fault):
    """The ball is elsewhere."""

    topic: str
    picture: str
    wanted: tuple[float, float]
    found: tuple[float, float]
    within: float
    why = "The robot drives to where you say the ball is."
    hint = (
        f"{OPEN_THE_PAGE} the ring is the ball, the cross is your answer. x is the column, y the"
        " row, from the upper left corner."
    )

    @property
    def expected(self) -> str:
        """Where it is."""
        x, y = self.wanted
        return (
            f"{self.picture}: on {self.topic} x {x:.1f}, y {y:.1f}, within {self.within:g} pixels"
        )

    @property
    def measured(self) -> str:
        """Where it was said to be."""
        return self._place

    @property
    def _place(self) -> str:
        x, y = self.found
        return f"x {x:.1f}, y {y:.1f}"


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
    measured = "{_place}: x and y are exchanged"


@dataclass(eq=False)
class CornerNotCentre(WrongPlace):
    """The corner of the box around the ball."""

    hint = "Which point of the ball's box do you publish?"
    mend = "cv2.boundingRect gives the upper left corner. Add half of the width and the height."
    measured = "{_place}: the corner of the box around the ball"


@dataclass(eq=False)
class FromTheMiddle(WrongPlace):
    """Counted from the centre of the picture."""

    hint = "From where does your code count?"
    mend = "Count from the upper left corner of the picture, to the right and down."
    measured = "{_place}: counted from the middle of the picture"


@dataclass(eq=False)
class NotAFloat(WrongPlace):
    """A number that is no Python float came out as nonsense."""

    hint = "Of which kind is the value that goes into the point? Print its type."
    mend = (
        "The fields of a Point are floats. A whole number, or one of numpy's own kinds, comes out"
        " as nonsense: write float(VALUE)."
    )

    @property
    def measured(self) -> str:
        """What came."""
        return f"x {self.found[0]:g}, y {self.found[1]:g}: that is no number of yours"


@dataclass(eq=False)
class FoundTheDecoy(WrongPlace):
    """The ball of another colour."""

    hint = "Which of the two balls is asked for? Look at how your code compares their hues."
    mend = (
        "There are two balls: take the one whose hue is nearest to ball_hue. Hues are 0 to 179 in"
        " OpenCV, half of the degrees that others count."
    )
    measured = "{_place}: there is a ball of another colour"


@dataclass(eq=False)
class RedAndBlueExchanged(FoundTheDecoy):
    """In rgb8, a blue ball was taken for the red one."""

    hint = "In which order are the colours of this picture? Look at image.encoding."
    mend = (
        "Look at image.encoding: rgb8 has red first. Turn it into bgr8 with cv2.cvtColor, before"
        " you make hues of it."
    )
    measured = "{_place}: the other ball, which is yours when red and blue are exchanged"


@dataclass(eq=False)
class HueIgnored(FoundTheDecoy):
    """The parameter was set, and the ball of the old colour is found."""

    hint = "When does your code read the parameter?"
    mend = (
        "Read the parameter for each picture: self.get_parameter('ball_hue').value. What __init__"
        " read stays as it was then."
    )
    measured = "{_place}: the ball of the colour before"

    @property
    def expected(self) -> str:
        """Where the ball of the new colour is."""
        return f"after ball_hue was set, {super().expected}"


@dataclass(eq=False)
class HueAtStartIgnored(FoundTheDecoy):
    """The node was started with another hue, and looks for that of the card."""

    hint = "When does your code read the parameter for the first time?"
    mend = (
        "Read the parameter for each picture: self.get_parameter('ball_hue').value. A variable that"
        " only a change sets does not know the value of the start."
    )
    measured = "{_place}: the ball of the default colour"

    @property
    def expected(self) -> str:
        """Where the ball of that colour is."""
        return f"started with another ball_hue, {super().expected}"


@dataclass(eq=False)
class NotFound(Fault):
    """There is a ball, and the node says nothing."""

    topic: str
    picture: str
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
    picture: str
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

    @property
    def measured(self) -> str:  # type: ignore[override]
        """What it did with them."""
        ended = "the node ended with an error: " if self.log else ""
        return f"{ended}the idle bytes at the end of each row were taken for pixels"


@dataclass(eq=False)
class FoundWhereNothingIs(Fault):
    """A ball was found in a picture without one."""

    topic: str
    picture: str
    found: tuple[float, float]
    why = "The robot drives to a ball that is not there."
    expected = "{picture}: nothing on {topic}"

    hint = "What does your code do where the mask is empty? And what does noise leave in the mask?"

    @property
    def mend(self) -> str:
        """The place that stands for none, or what noise looks like."""
        if self.found == (0.0, 0.0):
            return "Where your search finds nothing, publish no message: 0, 0 is a place, too."
        return (
            "Noise has every hue, but grey has little saturation: ask for more of it. Take single"
            " dots away (MORPH_OPEN), and ask for a least size."
        )

    @property
    def measured(self) -> str:
        """What was said."""
        return f"a ball at x {self.found[0]:.1f}, y {self.found[1]:.1f}"


@dataclass(eq=False)
class StampNotCarried(Fault):
    """The answer does not have the header of its picture."""

    topic: str
    what: str
    wanted: str
    found: str
    why = (
        "An answer comes later than its picture. Only by the stamp does anyone know where the"
        " robot was when the picture was made."
    )
    hint = "Where does the header of your answer come from?"
    mend = "Copy the whole header: ANSWER.header = image.header"
    expected = "on {topic}, {what} of the picture: {wanted}"

    @property
    def measured(self) -> str:
        """Another one."""
        return self.found


@dataclass(eq=False)
class WrongDrawing(Fault):
    """The picture that comes back is not the one that was shown."""

    topic: str
    picture: str
    what: str
    why = "This picture is what a person looks at, to see what the robot thinks."
    hint = "Compare each field of the picture that you publish with the picture that you drew on."
    mend = (
        "Draw with cv2.circle on the picture in bgr8, and publish that: its width, its height,"
        " step = width x 3, and all its bytes."
    )
    expected = "{picture}: on {topic} the same picture, with a ring around the ball"

    @property
    def measured(self) -> str:
        """What is the matter."""
        return self.what


@dataclass(eq=False)
class SilentAboutPicture(Fault):
    """A bad picture, and no word about it."""

    picture: str
    line: str
    similar: str | None
    why = "A camera with a broken driver sends such pictures. Without a word nobody finds out."
    hint = "What does your code look at before it uses the bytes of a picture?"
    mend = (
        "Compare len(image.data) with image.step * image.height before you use the bytes, and log"
        " the line of the card."
    )
    expected = "{picture}: a line {line!r}"

    @property
    def measured(self) -> str:
        """What it wrote."""
        return f"it wrote {self.similar!r}" if self.similar else "it wrote no such line"


@dataclass(eq=False)
class AnsweredTwice(Fault):
    """One picture has several answers."""

    topic: str
    picture: str
    count: int
    why = "Who hears an answer takes it for news: one ball becomes two."
    hint = "From how many places in your code is publish() called, and how often?"
    mend = "Call publish() once for each picture, in the function that hears it, and in no timer."
    expected = "{picture}: one message on {topic}"
    measured = "{count} messages"


@dataclass(eq=False)
class AnswersBadPicture(Fault):
    """Something is published after a picture that is none."""

    picture: str
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
    picture: str
    found: float
    why = "A place in a picture has a column and a row. z is free, so it stays 0."
    hint = "Which fields of the point does your code fill?"
    mend = "Fill point.x and point.y only. The radius of the ball is no part of its place."
    expected = "{picture}: on {topic} z 0"
    measured = "z {found:g}"
