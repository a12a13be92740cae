"""Two hosts: each has a network of its own, and the link between them is a bad one."""

from __future__ import annotations

import errno
import os
import socket
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from roslings.arena import hosts, kernel
from roslings.arena.hosts import NoHosts, two_hosts
from roslings.arena.isolation import BARE, ENTER
from roslings.arena.link import EmulatedLink
from skips import skip_without

ROOT = Path(hosts.__file__).parents[2]
BEHIND_THE_WALL = """
import os, socket, subprocess, sys, threading
from roslings.arena.hosts import two_hosts
names = ("laptop", "rover")
PORT = 9999


def ear(host):
    with host.entered():
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.bind(("", PORT))
        made.settimeout(10.0)
        return made


def say(host, to, words):
    with host.entered(), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as mouth:
        for word in words:
            mouth.sendto(word, (to, PORT))
"""


def behind_the_wall(source: str) -> str:
    """What a script prints that runs where the measuring process does."""
    skip_without("namespaces", "/dev/net/tun")
    script = BEHIND_THE_WALL + textwrap.dedent(source)
    command = [*BARE, str(ENTER), sys.executable, "-c", script]
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_what_is_said_on_one_host_is_heard_on_the_other() -> None:
    """By the address that each is told as its peer's."""
    heard = behind_the_wall(
        """
        with two_hosts(names, delay_s=0.0, loss=0.0) as two:
            heard = ear(two.second)
            say(two.first, two.first.peer, [b"hello"])
            print(heard.recvfrom(99)[0].decode(), heard.getsockname()[1] == PORT)
            print(two.first.environment["ROS_STATIC_PEERS"] == two.second.address)
        """
    )
    assert heard.split() == ["hello", "True", "True"]


def test_the_link_loses_some_packets_and_passes_no_multicast() -> None:
    """Of 60 packets, about a quarter is lost; a multicast never arrives."""
    counts = behind_the_wall(
        """
        with two_hosts(names, delay_s=0.001, loss=0.25, seed=1) as two:
            heard = ear(two.second)
            with two.first.entered():
                mouth = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
                here = socket.inet_aton(two.first.address)
                mouth.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, here)
            mouth.sendto(b"to all", ("239.255.0.1", PORT))
            for n in range(60):
                mouth.sendto(b"%d" % n, (two.second.address, PORT))
                while sum(two.link.counts().values()) < n + 2:
                    pass
            counts = two.link.counts()
            arrived = {heard.recv(99) for _ in range(counts["passed"])}
            print(counts["passed"], counts["lost"], counts["multicast"], b"to all" in arrived)
        """
    )
    passed, lost, multicast, arrived = counts.split()
    assert int(passed) + int(lost) == 60
    assert 5 < int(lost) < 30
    assert int(multicast) >= 1
    assert arrived == "False"


def test_a_cut_link_passes_nothing_until_it_is_mended() -> None:
    """As a cable that is pulled, and put back."""
    heard = behind_the_wall(
        """
        with two_hosts(names, delay_s=0.0, loss=0.0) as two:
            heard = ear(two.second)
            two.link.cut()
            say(two.first, two.second.address, [b"lost"])
            while not two.link.counts()["cut"]:
                pass
            two.link.mend()
            say(two.first, two.second.address, [b"came"])
            print(heard.recv(99).decode())
        """
    )
    assert heard.strip() == "came"


def test_only_the_thread_that_enters_is_on_the_host() -> None:
    """The others, and the thread itself afterwards, are where they were."""
    seen = behind_the_wall(
        """
        def network():
            return os.stat("/proc/thread-self/ns/net").st_ino

        with two_hosts(names, delay_s=0.0, loss=0.0) as two:
            home, there = network(), []
            entered, looked = threading.Event(), threading.Event()

            def visit():
                with two.second.entered():
                    there.append(network())
                    child = subprocess.run(["readlink", "/proc/self/ns/net"], capture_output=True)
                    there.append(str(there[0]) in child.stdout.decode())
                    entered.set()
                    looked.wait()
                there.append(network())

            thread = threading.Thread(target=visit)
            thread.start()
            entered.wait()
            here = network()
            looked.set()
            thread.join()
            print(there[0] != home, there[1], here == home, there[2] == home)
        """
    )
    assert seen.split() == ["True"] * 4


def test_nothing_of_the_hosts_stays() -> None:
    """The descriptors and the link's process are gone with the block."""
    left = behind_the_wall(
        """
        before = len(os.listdir("/proc/self/fd"))
        with two_hosts(names, delay_s=0.0, loss=0.0) as two:
            link = two.link._process
        print(len(os.listdir("/proc/self/fd")) == before, link.poll() is not None)
        """
    )
    assert left.split() == ["True", "True"]


def test_a_kernel_that_refuses_is_told_with_its_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    """A real refusal of the system: there is no such device."""
    monkeypatch.setattr(hosts, "TUN", Path("/dev/net/no_such_tun"))
    with pytest.raises(NoHosts) as refusal, two_hosts(("a", "b"), 0.0, 0.0):
        pass
    assert "cannot play two computers" in str(refusal.value)


def test_who_has_no_rights_is_told_so() -> None:
    """Without a user namespace of one's own, an ordinary user may make no network."""
    refused = subprocess.run(
        [sys.executable, "-c", REFUSED],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert refused.stdout.startswith("this computer cannot play two computers"), refused.stderr
    assert os.strerror(errno.EPERM) in refused.stdout


REFUSED = """
import os
from roslings.arena.hosts import NoHosts, two_hosts
if os.geteuid() == 0:
    os.setresuid(65534, 65534, 65534)
try:
    with two_hosts(("a", "b"), 0.0, 0.0):
        print("made")
except NoHosts as refusal:
    print(refusal)
"""


def test_a_packet_waits_for_its_time() -> None:
    """The link's own clock, without a second of ours."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
    other, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
    with ours, theirs, other, far:
        theirs.setblocking(False)
        link = EmulatedLink((theirs.fileno(), other.fileno()), delay_s=0.5, loss=0.0, seed=0)
        far.setblocking(False)
        packet = bytes([0x45, *[0] * 8, 17, *[0] * 6, 10, 20, 30, 2, *[0] * 8])
        ours.send(packet)
        link.take(theirs.fileno(), now_s=100.0)
        link.deliver(now_s=100.4)
        with pytest.raises(BlockingIOError):
            far.recv(99)
        assert link.rests_s(100.4) == pytest.approx(0.1)
        link.deliver(now_s=100.5)
        assert far.recv(99) == packet
        assert link.rests_s(100.5) is None


def test_the_kernel_call_tells_what_was_refused() -> None:
    """A descriptor that is no network."""
    with Path("/dev/null").open() as nothing, pytest.raises(OSError, match="setns"):
        kernel.enter_network(nothing.fileno())
