"""What is said where there is no grade: it is never a zero."""

from ros2_on_pip.language import Text

INCONCLUSIVE = Text(
    "export.inconclusive",
    "Not everything could be told: mostly the computer was too busy. This is no grade:"
    " submit again, or tell your instructor.",
)
NO_GRADE = Text(
    "export.no_grade",
    "This submission was not graded, and that is no fault of yours: tell your instructor.",
)
