"""A node with threads of its own, and nodes with actions: nothing of them outlives a session."""

from __future__ import annotations

import pytest
from kernels import Kernel

pytestmark = pytest.mark.slow

BUSY = """
class Busy(Node):
    def __init__(self):
        super().__init__("busy")
        self.entered, self.go_on = threading.Event(), threading.Event()
        self.create_timer(0.01, self.wait)
    def wait(self):
        self.entered.set()
        while not self.go_on.is_set():
            time.sleep(0.01)
"""
COUNTER = """
from rclpy.action import ActionClient, ActionServer
from test_msgs.action import Fibonacci
class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.server = ActionServer(self, Fibonacci, "count", self.count)
    def count(self, goal):
        goal.succeed()
        return Fibonacci.Result(sequence=[goal.request.order])
"""


@pytest.mark.parametrize("threads", [1, 2])
def test_a_busy_node_with_threads_of_its_own_lets_the_others_go_on(
    cells: Kernel, threads: int
) -> None:
    """The session's other nodes spin on."""
    ran = cells.run(f"""{BUSY}
with session() as ros:
    busy = ros.start(Busy, threads={threads})
    ros.until(busy.entered.is_set, "the callback")
    ros.start(Talker)
    print(len(ros.collect("/words", String, count=3)))
    busy.go_on.set()
""")
    assert (ran.text, ran.error) == ("3\n", ""), ran


def test_a_callback_that_never_ends_is_cut_short_in_each_thread(cells: Kernel) -> None:
    """Leaving the block ends the threads of the node."""
    ran = cells.run(f"""{BUSY}
before = set(threading.enumerate())
with session() as ros:
    busy = ros.start(Busy, threads=2)
    ros.until(busy.entered.is_set, "the callback")
left = [each.name for each in threading.enumerate() if each not in before and each.is_alive()]
print([name for name in left if "Pool" in name or "roslings" in name])
""")
    assert (ran.text, ran.error) == ("[]\n", ""), ran


def test_python_warns_of_no_callback_that_no_thread_came_to(cells: Kernel) -> None:
    """All threads are busy, and more callbacks wait for one when the session ends."""
    ran = cells.run(f"""import gc
from rclpy.callback_groups import ReentrantCallbackGroup
{BUSY}
class Busier(Busy):
    def __init__(self):
        super().__init__()
        together = ReentrantCallbackGroup()
        self.ready = [self.create_timer(0.01, self.wait, together) for _ in range(8)]
    def all_wait(self):
        return all(timer.is_ready() for timer in self.ready)
with session() as ros:
    busy = ros.start(Busier, threads=2)
    ros.until(busy.entered.is_set, "the callback")
    ros.until(busy.all_wait, "the others")
del busy, ros
print(gc.collect() >= 0)
""")
    assert (ran.text, ran.error) == ("True\n", ""), ran


def test_a_node_with_an_action_leaves_the_graph_with_its_session(cells: Kernel) -> None:
    """Also where somebody still holds the node."""
    ran = cells.run(f"""{COUNTER}
with session() as ros:
    counter = ros.start(Counter)
    client = ActionClient(ros.node("asking"), Fibonacci, "count")
    ros.until(client.server_is_ready, "the server")
    goal = ros.wait(client.send_goal_async(Fibonacci.Goal(order=7)))
    print(list(ros.wait(goal.get_result_async()).result.sequence))
with session() as ros:
    print(ros.names())
""")
    assert (ran.text, ran.error) == ("[7]\n[]\n", ""), ran
