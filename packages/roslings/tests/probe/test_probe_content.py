"""Message classes, asked for by several experiments at once."""

from __future__ import annotations

import subprocess
import sys

RACE = """
import sys, threading
sys.setswitchinterval(1e-6)
from roslings.probe.content import message_class

halves, start = [], threading.Barrier(8)

def load(name):
    start.wait()
    found = message_class(name)
    parts = (found.Request, found.Response)
    halves.extend(part for part in parts if part.__class__._CREATE_ROS_MESSAGE is None)

for name in sys.argv[1:]:
    threads = [threading.Thread(target=load, args=(name,)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
print(halves)
"""
SERVICES = [
    *(
        f"rcl_interfaces/srv/{name}"
        for name in (
            "ListParameters",
            "GetParameters",
            "SetParameters",
            "DescribeParameters",
            "GetParameterTypes",
            "SetParametersAtomically",
        )
    ),
    "std_srvs/srv/Trigger",
    "std_srvs/srv/SetBool",
    "std_srvs/srv/Empty",
    "action_msgs/srv/CancelGoal",
]


def test_who_gets_a_service_gets_it_whole() -> None:
    """Also where others ask for it at the same moment: its request can be converted, too."""
    done = subprocess.run(
        [sys.executable, "-c", RACE, *SERVICES], capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("[]\n", "")
