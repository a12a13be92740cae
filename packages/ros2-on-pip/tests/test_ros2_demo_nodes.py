"""The demo talker and listener: what is wrong is told, and Ctrl-C ends them without a word."""

from __future__ import annotations

import sys

import pytest
from terminal import Shell

pytestmark = pytest.mark.slow

NODES = ("talker", "listener")
MIDDLEWARE = "rmw_fastrtps_ccp"

# Run in place of the node's program: Ctrl-C comes at the moment that the first word names.
INTERRUPTED = """
import os, signal, sys
import rclpy
from importlib import import_module

def interrupt():
    os.kill(os.getpid(), signal.SIGINT)
    while rclpy.ok():  # until the signal's own thread has ended the context
        pass

def and_interrupted(call):
    def both(*words, **named):
        made = call(*words, **named)
        interrupt()
        return made
    return both

module = import_module(f"ros2_on_pip.demo_nodes_py.{sys.argv[2]}")
node = getattr(module, sys.argv[2].title())
if sys.argv[1] == "init":
    rclpy.init = and_interrupted(rclpy.init)
elif sys.argv[1] == "node":
    module.Node.__init__ = and_interrupted(module.Node.__init__)
elif sys.argv[1] == "made":
    node.__init__ = and_interrupted(node.__init__)
module.main()
"""


@pytest.mark.parametrize("node", NODES)
def test_a_domain_that_is_no_number_is_told(empty: Shell, node: str) -> None:
    """The last line names the variable, and the exit code is not 0: day 1 and `break 8` say so."""
    ran = empty("run", "demo_nodes_py", node, ROS_DOMAIN_ID="seven")
    assert ran.code == 1
    last = ran.err.splitlines()[-1]
    assert "RCLError" in last
    assert "ROS_DOMAIN_ID is not an integral number" in last


@pytest.mark.parametrize("node", NODES)
def test_a_middleware_that_is_not_there_is_told(empty: Shell, node: str) -> None:
    """The error gives the wrong name: `break 10` asks to compare it letter by letter."""
    ran = empty("run", "demo_nodes_py", node, RMW_IMPLEMENTATION=MIDDLEWARE)
    assert ran.code != 0
    assert MIDDLEWARE in ran.err


@pytest.mark.parametrize("node", NODES)
@pytest.mark.parametrize("moment", ["init", "node", "made"])
def test_ctrl_c_at_any_moment_is_no_error(empty: Shell, node: str, moment: str) -> None:
    """Before the node is made, while it is made, and before it spins."""
    with empty.program([sys.executable, "-c", INTERRUPTED, moment, node]) as running:
        assert running.wait() == 0, running.text
        assert "Traceback" not in running.text
