"""What several views of a verdict say, each text once."""

from __future__ import annotations

from ros2_on_pip.language import Text, said
from roslings.verdict import Verdict

NEXT, STUCK = Text("verdict.next", "Next"), Text("verdict.stuck", "Stuck")
WHY, READ = Text("verdict.why", "why"), Text("verdict.read", "read")
EXPECTED, MEASURED = Text("verdict.expected", "expected"), Text("verdict.measured", "measured")
TRY, MEND = Text("verdict.try", "try"), Text("verdict.mends", "mend")
ASK_FOR_A_HINT = Text("verdict.ask_for_a_hint", "Ask for a hint:")
SEE_ALL_CHECKS = Text("verdict.see_all", "See all checks:")
CHECK_AGAIN = Text("verdict.check_again", "Check again:")
GO_ON = Text("verdict.go_on", "Go on with the course:")
MAKE_THE_FILE = Text("verdict.make_the_file", "Make the file to hand in:")
REMARKS = Text("verdict.remarks", "Remarks that cost no points")


def mend_first(verdict: Verdict, check: str) -> str:
    """What to do about the check that failed first."""
    if len(verdict.failed()) > 1:
        several = 'Mend "{check}" first, then check again:'
        return said("verdict.mend_first", several, check=check)
    return said("verdict.mend", 'Mend "{check}", then check again:', check=check)
