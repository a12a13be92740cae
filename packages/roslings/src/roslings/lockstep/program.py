"""Script: the world, a process beside the nodes. `beside.py` begins it as a companion.

    python program.py '{"plan": {...}, "file": "drive.json"}'

It must see the nodes in /proc, so it stands beside their sandbox and not in one of its own, as the
probe does. It writes its record at the end of the drive, whatever ended it.
"""

from __future__ import annotations

import json
import sys
import traceback
from pathlib import Path

from roslings.lockstep.quiet import Account, Gone, NeverQuiet, NoAccount
from roslings.lockstep.record import Drive, End
from roslings.lockstep.stepping import Lockstep, OverBudget, Plan
from roslings.lockstep.voice import NobodyFollows, RosVoice

ENDS: dict[type[Exception], End] = {
    NeverQuiet: "never quiet",
    OverBudget: "over budget",
    Gone: "a node ended",
    NobodyFollows: "nobody follows",
    NoAccount: "no account",
}


def drive(plan: Plan) -> Drive:
    """In this process, beside nodes that run."""
    with Account(plan.pids) as account, RosVoice() as voice:
        world = Lockstep(plan, voice, account)
        try:
            account.check()
            voice.meet(plan, account)
            world.begin()
            world.run()
        except tuple(ENDS) as error:
            return world.drive(ENDS[type(error)], str(error))
        return world.drive("done")


def main(words: str) -> None:
    """Drive as these words say, and tell when the record is there."""
    order = json.loads(words)
    _tell(ready=True)
    try:
        drive(Plan.model_validate(order["plan"])).write(Path(order["file"]))
    except Exception:
        _tell(failed=traceback.format_exc())
        raise
    _tell(driven=True)


def _tell(**words: object) -> None:
    print(json.dumps(words), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
