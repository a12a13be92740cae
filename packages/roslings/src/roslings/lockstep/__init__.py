"""A world in lockstep with nodes that follow /clock: time goes on when all that they do is done.

nodes, started with use_sim_time
drive_beside(plan, around, folder)  ->  program.py, a process beside them
    voice.py     says /odom, /scan and /clock, one message at a time
    quiet.py     waits after each until the kernel says that nothing runs any more
    asleep.py    names who sleeps on the wall clock meanwhile
    record.py    the drive, which a grader reads
drive_twice(...)                    believes what half the speed does not change
"""

from roslings.lockstep.asleep import Sleeper
from roslings.lockstep.beside import drive_beside
from roslings.lockstep.quiet import Account, Gone, NeverQuiet, NoAccount
from roslings.lockstep.record import Drive, DriveTick
from roslings.lockstep.stepping import Budget, OverBudget, Plan
from roslings.lockstep.twice import Believed, drive_twice

__all__ = [
    "Account",
    "Believed",
    "Budget",
    "Drive",
    "DriveTick",
    "Gone",
    "NeverQuiet",
    "NoAccount",
    "OverBudget",
    "Plan",
    "Sleeper",
    "drive_beside",
    "drive_twice",
]
