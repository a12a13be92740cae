"""A world in lockstep with nodes that follow /clock: time goes on when all that they do is done.

nodes, started with use_sim_time
drive_beside(plan, around, folder)  ->  program.py, a process beside them
    world_node.py says /odom, /scan and /clock, one message at a time
    quiet.py     waits after each until the kernel says that nothing runs any more
    asleep.py    names who sleeps on the wall clock meanwhile
    driven_rover.py  the rover, and the record of its drive, which a grader reads (record.py)
drive_twice(...)                    believes what half the speed does not change
real_time.py                        the same room by the wall clock, for who is not believed
"""

from roslings.lockstep.asleep import Sleeper
from roslings.lockstep.beside import LateDrive, NoDrive, drive_beside
from roslings.lockstep.quiet import Gone, NeverQuiet, NoAccount, ThreadAccount
from roslings.lockstep.real_time import RealTimePlan
from roslings.lockstep.record import DriveTick, LockstepDrive
from roslings.lockstep.stepping import DriveBudget, LockstepPlan, OverBudget
from roslings.lockstep.twice import Believed, drive_twice

__all__ = [
    "Believed",
    "DriveBudget",
    "DriveTick",
    "Gone",
    "LateDrive",
    "LockstepDrive",
    "LockstepPlan",
    "NeverQuiet",
    "NoAccount",
    "NoDrive",
    "OverBudget",
    "RealTimePlan",
    "Sleeper",
    "ThreadAccount",
    "drive_beside",
    "drive_twice",
]
