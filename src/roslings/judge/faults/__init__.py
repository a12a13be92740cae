"""The kinds of fault that a check can find, each with its own sentences.

A fault says what was expected, what was measured, why it matters and what to try. The words are
for somebody on the third day of ROS. The class name is the `fault` of the verdict.
"""

from roslings.judge.faults.base import (
    Fault,
    Inconclusive,
    NothingToJudge,
    Unmet,
)
from roslings.judge.faults.files import (
    BuildFailed,
    InvalidPackageXml,
    MissingFile,
    NoExecutable,
    NotAnAmentPackage,
    SyntaxErrorInCode,
    UnlistedDependency,
    WrongBuildType,
)
from roslings.judge.faults.graph import (
    NodeTwice,
    NoTopic,
    NotTheAskedGraph,
    QosCannotMatch,
    TwoPublishers,
    WrongNodeName,
    WrongTopic,
    WrongType,
    qos_conflict,
)
from roslings.judge.faults.messages import (
    CountRepeats,
    CountRestarts,
    CountSkips,
    NoMessages,
    WrongCount,
    WrongText,
)
from roslings.judge.faults.pictures import (
    BadPicture,
    NoPicture,
    NotAPicture,
    OneColour,
    PictureTooSmall,
)
from roslings.judge.faults.processes import (
    DidNotComeUp,
    DoesNotEnd,
    EndedWithError,
    LeavesProcesses,
    StoppedByItself,
    UncleanExit,
)
from roslings.judge.faults.rhythm import (
    Bursts,
    Drifts,
    SleepsAfterWorking,
    StallsNowAndThen,
    StartsLate,
    TooFast,
    TooSlow,
    WrongRate,
    rate_fault,
)
from roslings.judge.faults.writing import (
    AlmostRepeats,
    DoesNotRepeat,
    FixedText,
    NotLogged,
)

__all__ = [
    "AlmostRepeats",
    "BadPicture",
    "BuildFailed",
    "Bursts",
    "CountRepeats",
    "CountRestarts",
    "CountSkips",
    "DidNotComeUp",
    "DoesNotEnd",
    "DoesNotRepeat",
    "Drifts",
    "EndedWithError",
    "Fault",
    "FixedText",
    "Inconclusive",
    "InvalidPackageXml",
    "LeavesProcesses",
    "MissingFile",
    "NoExecutable",
    "NoMessages",
    "NoPicture",
    "NoTopic",
    "NodeTwice",
    "NotAPicture",
    "NotAnAmentPackage",
    "NotLogged",
    "NotTheAskedGraph",
    "NothingToJudge",
    "OneColour",
    "PictureTooSmall",
    "QosCannotMatch",
    "SleepsAfterWorking",
    "StallsNowAndThen",
    "StartsLate",
    "StoppedByItself",
    "SyntaxErrorInCode",
    "TooFast",
    "TooSlow",
    "TwoPublishers",
    "UncleanExit",
    "UnlistedDependency",
    "Unmet",
    "WrongBuildType",
    "WrongCount",
    "WrongNodeName",
    "WrongRate",
    "WrongText",
    "WrongTopic",
    "WrongType",
    "qos_conflict",
    "rate_fault",
]
