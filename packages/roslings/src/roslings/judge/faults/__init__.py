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
from roslings.judge.faults.ends import End, Went
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
    CALLS,
    EndOfTopic,
    EndpointKind,
    NodeTwice,
    NoTopic,
    NotTheAskedGraph,
    TwoPublishers,
    WrongNodeName,
    WrongTopic,
    WrongType,
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
    EndedInTheSoak,
    EndedWithError,
    LeavesProcesses,
    PrintsWithoutEnd,
    StoppedByItself,
    UncleanExit,
)
from roslings.judge.faults.qos import (
    MatchedPolicies,
    NotThisQos,
    QosCannotMatch,
    matched,
    qos_conflicts,
)
from roslings.judge.faults.writing import (
    AlmostRepeats,
    DoesNotRepeat,
    FixedText,
    LoggedAgain,
    NotLogged,
)

__all__ = [
    "CALLS",
    "AlmostRepeats",
    "BadPicture",
    "BuildFailed",
    "DidNotComeUp",
    "DoesNotEnd",
    "DoesNotRepeat",
    "End",
    "EndOfTopic",
    "EndedInTheSoak",
    "EndedWithError",
    "EndpointKind",
    "Fault",
    "FixedText",
    "Inconclusive",
    "InvalidPackageXml",
    "LeavesProcesses",
    "LoggedAgain",
    "MatchedPolicies",
    "MissingFile",
    "NoExecutable",
    "NoPicture",
    "NoTopic",
    "NodeTwice",
    "NotAPicture",
    "NotAnAmentPackage",
    "NotLogged",
    "NotTheAskedGraph",
    "NotThisQos",
    "NothingToJudge",
    "OneColour",
    "PictureTooSmall",
    "PrintsWithoutEnd",
    "QosCannotMatch",
    "StoppedByItself",
    "SyntaxErrorInCode",
    "TwoPublishers",
    "UncleanExit",
    "UnlistedDependency",
    "Unmet",
    "Went",
    "WrongBuildType",
    "WrongNodeName",
    "WrongTopic",
    "WrongType",
    "matched",
    "qos_conflicts",
]
