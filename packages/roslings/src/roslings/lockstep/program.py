"""Script: the world, a process beside the nodes. `beside.py` begins it as a companion.

    python program.py '{"lockstep": {...}, "file": "drive.json"}'
    python program.py '{"real_time": {...}, "file": "drive.json"}'

It must see the nodes in /proc, so it stands beside their sandbox and not in one of its own, as the
probe does. It writes its record at the end of the drive, whatever ended it.
"""

from __future__ import annotations

import json
import sys
import traceback
from pathlib import Path
from typing import Any

from roslings.lockstep.quiet import Gone, NeverQuiet, NoAccount, ThreadAccount
from roslings.lockstep.real_time import RealTime, RealTimePlan
from roslings.lockstep.record import End, LockstepDrive
from roslings.lockstep.stepping import Lockstep, LockstepPlan, OverBudget
from roslings.lockstep.world_node import NobodyFollows, WorldNode

ENDS: dict[type[Exception], End] = {
    NeverQuiet: "never quiet",
    OverBudget: "over budget",
    Gone: "a node ended",
    NobodyFollows: "nobody follows",
    NoAccount: "no account",
}


def drive(plan: LockstepPlan) -> LockstepDrive:
    """In this process, beside nodes that run."""
    with ThreadAccount(plan.pids) as account, WorldNode() as world_node:
        world = Lockstep(plan, world_node, account)
        try:
            account.check()
            world_node.meet(plan, account)
            world.begin()
            world.run()
        except tuple(ENDS) as error:
            return world.drive(ENDS[type(error)], str(error))
        return world.drive("done")


def drive_in_real_time(plan: RealTimePlan) -> LockstepDrive:
    """In this process, beside nodes that run, whoever they are."""
    with WorldNode() as world_node:
        return RealTime(plan, world_node).run()


def _driven(order: dict[str, Any]) -> LockstepDrive:
    if "real_time" in order:
        return drive_in_real_time(RealTimePlan.model_validate(order["real_time"]))
    return drive(LockstepPlan.model_validate(order["lockstep"]))


def main(words: str) -> None:
    """Drive as these words say, and tell when the record is there."""
    order = json.loads(words)
    _tell(ready=True)
    try:
        _driven(order).write(Path(order["file"]))
    except Exception:
        _tell(failed=traceback.format_exc())
        raise
    _tell(driven=True)


def _tell(**words: object) -> None:
    print(json.dumps(words), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
