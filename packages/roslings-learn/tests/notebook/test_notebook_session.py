"""Sessions: nodes start as in a program, callbacks' errors reach the cell, nothing stays behind."""

from __future__ import annotations

import os
import re
import signal
from pathlib import Path

import pytest
from kernels import Kernel, kernel

LEFT = """
print(sorted(t.name for t in threading.enumerate() if t.name.startswith("roslings")))
"""
HEARD = """
with session() as ros:
    ros.start(Talker)
    print([m.data for m in ros.collect("/words", String, count=3)])
"""


def test_a_node_that_names_no_context_is_heard(cells: Kernel) -> None:
    """`super().__init__("talker")` is all that a student writes."""
    ran = cells.run(HEARD)
    assert ran.error == "" and ran.text.count("hi ") == 3, ran


def test_a_cell_may_run_twice(cells: Kernel) -> None:
    """The second run begins anew."""
    first, second = cells.run(HEARD), cells.run(HEARD)
    assert first.error == second.error == ""
    assert second.text.count("hi ") == 3


def test_the_type_may_be_left_out(cells: Kernel) -> None:
    """It is on the graph."""
    ran = cells.run(
        "with session() as ros:\n"
        "    ros.start(Talker)\n"
        "    heard = ros.collect('words', count=3, stamps=True)\n"
        "print(type(heard[0].message).__name__, heard[0].sent_s < heard[2].sent_s)"
    )
    assert "String True" in ran.text, ran


def test_words_of_a_command_line_reach_a_node(cells: Kernel) -> None:
    """Names and parameters, for this node alone."""
    ran = cells.run("""
with session() as ros:
    left = ros.start(Talker, "ho", ros_args=["-r", "__node:=left", "-p", "period:=0.01"])
    ros.start(Talker)
    print(left.get_parameter("period").value, isinstance(left, Talker), ros.names())
""")
    assert "0.01 True ['/left', '/talker']" in ran.text, ran


def test_a_node_belongs_to_the_session_that_starts_it(cells: Kernel) -> None:
    """Also where another session was opened after it: for ROS, each of them is a program."""
    ran = cells.run("""
with session() as first, session() as second:
    ours, theirs = first.start(Talker), second.start(Talker)
    print(f"{ours.context is first.context} {theirs.context is second.context}")
""")
    assert "True True" in ran.text, ran


def test_names_are_full_and_hidden_nodes_are_left_out(cells: Kernel) -> None:
    """Our own nodes are nobody's business."""
    ran = cells.run("""
with session() as ros:
    ros.node("probe", namespace="/lab")
    print(ros.names())
""")
    assert "['/lab/probe']" in ran.text, ran


def test_what_is_no_class_of_nodes_is_told(cells: Kernel) -> None:
    """A node that is already made, or one whose __init__ goes another way."""
    ran = cells.run("with session() as ros:\n    ros.start(Talker(), 1)")
    assert ran.error == "NotANode" and "ros.start(Talker)" in ran.said
    ran = cells.run("""
class Odd(Node):
    def __init__(self):
        Node.__init__(self, "odd")
with session() as ros:
    ros.start(Odd, ros_args=["-r", "__node:=even"])
""")
    assert ran.error == "NoInit" and "super().__init__" in ran.said, ran


def test_a_node_that_the_cell_made_itself_ends_too(cells: Kernel) -> None:
    """It was never given to the session, and is still in a variable."""
    ran = cells.run("""
with session() as ros:
    mine = Talker()
    print(ros.names())
with session() as ros:
    print(ros.names())
""")
    assert "['/talker']\n[]" in ran.text, ran


def test_a_callbacks_error_comes_at_the_next_wait(cells: Kernel) -> None:
    """It says which line of the node raised it."""
    ran = cells.run("""
class Slip(Node):
    def __init__(self):
        super().__init__("slip")
        self.create_timer(0.01, self.tick)
    def tick(self):
        self.publsher.publish(String())
with session() as ros:
    ros.start(Slip)
    ros.collect("/never", String)
""")
    assert ran.error == "AttributeError"
    assert "self.publsher.publish(String())" in ran.told, ran.told
    assert "executors.py" not in ran.told


def test_a_callbacks_error_comes_at_the_end_of_the_block(cells: Kernel) -> None:
    """A cell that waits for nothing hears of it too."""
    ran = cells.run("""
failed = threading.Event()
class Late(Node):
    def __init__(self):
        super().__init__("late")
        self.create_timer(0.01, self.tick)
    def tick(self):
        failed.set()
        raise ZeroDivisionError("a robot divides by zero")
with session() as ros:
    ros.start(Late)
    failed.wait(30)
""")
    assert (ran.error, ran.said) == ("ZeroDivisionError", "a robot divides by zero")


def test_too_few_messages_say_why(cells: Kernel) -> None:
    """Nobody publishes; a near name; another type; too slow."""
    ran = cells.run("with session() as ros:\n    ros.collect('/words', String, timeout_s=0.2)")
    assert ran.error == "NothingHeard" and "Nobody publishes on /words" in ran.said
    begin = "with session() as ros:\n    ros.start(Talker)\n    "
    ran = cells.run(begin + "ros.collect('/wodrs', String, timeout_s=0.5)")
    assert "Did you mean /words?" in ran.said, ran
    ran = cells.run(begin + "ros.collect('/words', Int32, timeout_s=0.5)")
    assert "has the type std_msgs/msg/String here" in ran.said, ran
    ran = cells.run(begin + "ros.collect('/words', String, count=99999, timeout_s=0.5)")
    assert "99999 messages" in ran.said and "longer timeout_s" in ran.said, ran


def test_a_message_waits_for_its_subscription(cells: Kernel) -> None:
    """And without one it says so."""
    ran = cells.run("""
with session() as ros:
    heard = []
    node = ros.node("ears")
    node.create_subscription(String, "/orders", lambda m: heard.append(m.data), 10)
    ros.say("/orders", String(data="go"), count=2, every_s=0.01)
    ros.until(lambda: len(heard) == 2, "two orders")
    print(heard)
    ros.say("/orders", Int32())
""")
    assert "['go', 'go']" in ran.text, ran
    assert ran.error == "OtherType" and "has the type std_msgs/msg/String here" in ran.said
    ran = cells.run("with session() as ros:\n    ros.say('/orders', Int32(), timeout_s=0.2)")
    assert ran.error == "NobodyListens" and "std_msgs/msg/Int32" in ran.said


SERVER = """
class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.create_service(Trigger, "again", self.answer)
    def answer(self, request, response):
        response.message = "done"
        return response
"""


def test_an_answer_is_waited_for(cells: Kernel) -> None:
    """A future of a client that spins in the session."""
    ran = cells.run(
        SERVER
        + """
with session() as ros:
    ros.start(Server)
    client = ros.node("asker").create_client(Trigger, "again")
    ros.until(client.service_is_ready, "the service")
    print(ros.wait(client.call_async(Trigger.Request())).message)
"""
    )
    assert "done" in ran.text, ran


def test_a_deadlock_can_be_shown_and_left(cells: Kernel) -> None:
    """A callback that waits for an answer blocks its executor; the block ends it all the same."""
    ran = cells.run(
        SERVER
        + """
class Stuck(Node):
    def __init__(self):
        super().__init__("stuck")
        self.client = self.create_client(Trigger, "again")
        self.create_timer(0.01, self.ask)
    def ask(self):
        self.client.call(Trigger.Request())
with session() as ros:
    ros.start(Server)
    ros.start(Stuck)
    ros.until(lambda: False, "an answer", timeout_s=0.5)
"""
    )
    assert ran.error == "StillWaiting" and "0.5 s" in ran.said
    assert "[]" in cells.run(LEFT).text
    assert cells.run(HEARD).error == ""


def test_a_callback_without_end_is_cut_short(cells: Kernel) -> None:
    """`while True` in a callback is a mistake that people make."""
    ran = cells.run("""
turns = []
class Loop(Node):
    def __init__(self):
        super().__init__("loop")
        self.create_timer(0.01, self.tick)
    def tick(self):
        while True:
            turns.append(1)
            time.sleep(0.001)
with session() as ros:
    ros.start(Loop)
    ros.until(lambda: turns, "a turn")
""")
    assert ran.error == "", ran
    assert "[]" in cells.run(LEFT).text


def test_rclpy_speaks_of_the_session(cells: Kernel) -> None:
    """As in a program: ok() inside of it, and shutdown() ends its nodes."""
    ran = cells.run("""
import rclpy
with session() as ros:
    print(rclpy.ok())
print(rclpy.ok())
with session() as ros:
    rclpy.shutdown()
    ros.collect("/words")
""")
    assert "True\nFalse" in ran.text, ran
    assert ran.error == "SessionEnded"


@pytest.mark.slow
def test_fifty_sessions_leave_nothing(cells: Kernel) -> None:
    """No thread and no file descriptor more."""
    ran = cells.run("""
def once():
    with session() as ros:
        ros.start(Talker)
        ros.collect("/words", String, count=1)
def held():
    return len(os.listdir("/proc/self/fd")), len(os.listdir("/proc/self/task"))
for _ in range(3):
    once()
before = held()
for _ in range(50):
    once()
print("grew by", [b - a for a, b in zip(before, held())])
""")
    grew = ran.text.partition("grew by")[2].strip(" []\n").split(", ")
    assert ran.error == "" and all(int(each) <= 1 for each in grew), ran.text


def test_an_interrupt_leaves_nothing(cells: Kernel) -> None:
    """Nodes, programs and threads end with the cell; the next one works."""
    cell = cells.begin("""
with session() as ros:
    ros.start(Talker)
    program = ros.run("sleep 1000")
    print("pid", program._process.pid, flush=True)
    ros.until(lambda: False, "the end of the world", timeout_s=1000)
""")
    cells.wait_for("pid")
    cells.manager.interrupt_kernel()
    ran = cells.result_of(cell)
    assert ran.error == "KeyboardInterrupt" and "Stopped." in ran.told
    ended = cells.run(LEFT + "print(program.runs)")
    assert "[]" in ended.text and "False" in ended.text, ended
    assert cells.run(HEARD).error == ""


@pytest.mark.slow
def test_two_notebooks_do_not_hear_each_other(cells: Kernel, tmp_path: Path) -> None:
    """The second takes another domain, and says what a terminal must type."""
    usual = cells.run("import os; print(os.environ['ROS_DOMAIN_ID'])").text.strip()
    with kernel(tmp_path, ROS_DOMAIN_ID=usual) as other:
        ran = other.run("with session() as ros:\n    print(ros.names())")
        assert "export ROS_DOMAIN_ID=" in ran.text and "[]" in ran.text, ran
        assert f"export ROS_DOMAIN_ID={usual}\n" not in ran.text
        assert "export" not in other.run("with session() as ros:\n    pass").text
    assert "export" not in cells.run("with session() as ros:\n    pass").text


@pytest.mark.slow
def test_a_killed_kernel_leaves_no_program(tmp_path: Path) -> None:
    """Restart Kernel is a kill where the kernel hangs."""
    with kernel(tmp_path) as doomed:
        ran = doomed.run("""
ros = session().__enter__()
program = ros.run("sleep 1000")
program._process.poll()
print("pid", program._process.pid, "own", os.getpid())
""")
        found = re.search(r"pid (\d+) own (\d+)", ran.text)
        assert found, ran
        program, own = map(int, found.groups())
        os.kill(own, signal.SIGKILL)
        _until_gone(program)


def _until_gone(pid: int) -> None:
    """A test that fails hangs here until pytest's own end; a killed parent's child is quick."""
    for _ in range(6000):
        if not Path(f"/proc/{pid}").exists() or "Z" in _state(pid):
            return
        signal.sigtimedwait([], 0.01)
    raise AssertionError(f"process {pid} still runs")


def _state(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()[0]
    except OSError:
        return "Z"
