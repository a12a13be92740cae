"""Figures of time: how true a rate is, how often a verdict is wrong, how fast robot time runs.

    python tests/bench/rates.py [error | verdicts | speed | discovery] [N]

It prints, and asserts nothing. All sections without a word; N is the number of gradings of each
package in `verdicts`. `saturated` means twice as many busy processes as cores.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ros2_on_pip.rates import measure_rate
from roslings.arena import Arena, ArenaPlace, Wall, choose_isolation, opened, ros_environment
from roslings.course import NodeContract
from roslings.course.grader import Clock
from roslings.evidence import ExperimentSeen
from roslings.experiment import Scene
from roslings.experiment.simulated import followed_clock
from roslings.probe import Probe

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/roslings/tests/experiment"))

from test_clocks import answer
from watching import HERE as SCRIPTS
from watching import installed, watched

HERE = Path(__file__).parent
RATES_HZ = (1, 2, 10, 30, 100, 200, 500, 1000)
LOADS = {"idle": 0, "saturated": 2 * (os.cpu_count() or 1)}
WATCH_S, FEWEST_PERIODS = 6.0, 8
PACKAGES = {
    "solution": (SCRIPTS / "styles" / "timer.py", "right"),
    "2.2 Hz": (SCRIPTS / "tricky" / "too_fast.py", "TooFast"),
    "1 Hz": (SCRIPTS / "tricky" / "one_hertz.py", "TooSlow"),
    "bursts": (SCRIPTS / "tricky" / "bursts.py", "Bursts"),
}
AT_ONCE = 2
ROBOT_S, STEP_NS = 20.0, 100_000_000
DISCOVERIES = 50
BUSY = "while True: pass"


@contextmanager
def load(processes: int) -> Iterator[None]:
    """So many busy processes while the block runs."""
    with ExitStack() as stack:
        for _ in range(processes):
            busy = stack.enter_context(subprocess.Popen([sys.executable, "-S", "-c", BUSY]))
            stack.callback(busy.kill)
        yield


# --- how true a rate is ------------------------------------------------------------------------


def error() -> None:
    """Our rate, and a plain counter's, against the talker's own log."""
    print("rate error in % of the talker's own log (ours / a receive-time counter of depth 5)")
    for name, processes in LOADS.items():
        with load(processes):
            for hz in RATES_HZ:
                print(f"  {name:10} {hz:5} Hz  {error_at(hz)}", flush=True)


def error_at(hz: int) -> str:
    """One talker, watched by both."""
    with tempfile.TemporaryDirectory() as folder, stage(HERE / "logging_talker.py", folder) as room:
        _, probe, arena = room
        log, counted = Path(folder) / "log", Path(folder) / "counted"
        counter = [sys.executable, str(HERE / "receive_counter.py"), str(counted)]
        environment = {**os.environ, "ROS_DOMAIN_ID": str(arena.domain_id)}
        with (
            subprocess.Popen(counter, env=environment) as plain,
            arena.run("talker", [str(hz), str(log)]) as talker,
        ):
            probe.until(lambda: probe.count("/chatter") > 0, 20)
            probe.until(lambda: False, max(WATCH_S, FEWEST_PERIODS / hz))
            messages = probe.messages("/chatter")
            talker.interrupt(10)
            plain.terminate()
        rate = measure_rate(messages)
        sent_ns = [int(line) for line in log.read_text().split()]
        first, last = messages[0].sequence - 1, messages[-1].sequence - 1
        true_hz = (last - first) / (sent_ns[last] - sent_ns[first]) * 1e9
        plain_hz = float(counted.read_text() or "nan")
        missed = last - first + 1 - len(messages)
    ours = abs(rate.hz / true_hz - 1) * 100 if rate else float("nan")
    return (
        f"true {true_hz:9.3f}   {ours:7.4f}  (± {rate.uncertainty_hz / rate.hz * 100:.3f})"
        f"   {abs(plain_hz / true_hz - 1) * 100:7.3f}   missed {missed} of {last - first + 1}"
        if rate
        else f"true {true_hz:9.3f}, too few messages"
    )


# --- how often a verdict is wrong --------------------------------------------------------------


def verdicts(count: int) -> None:
    """Answers to `count` gradings of each package with every core saturated."""
    print(f"verdicts, cores saturated, {AT_ONCE} gradings at once")
    with load(LOADS["saturated"]):
        for clock in ("auto", "wall"):
            for name, (script, right) in PACKAGES.items():
                print(f"  {clock:5} {name:9} {tally(script, clock, count, right)}", flush=True)


def tally(script: Path, clock: Clock, count: int, right: str) -> str:
    """How many were right, wrong, or inconclusive."""
    with ThreadPoolExecutor(AT_ONCE) as pool:
        answers = Counter(pool.map(lambda _: answer(watched(script, clock)), range(count)))
    wrong = {k: n for k, n in answers.items() if k not in (right, "inconclusive")}
    return (
        f"right {answers[right]}, inconclusive {answers['inconclusive']},"
        f" wrong {sum(wrong.values())} of {count} {wrong or ''}"
    )


# --- how fast robot time runs ------------------------------------------------------------------


def speed() -> None:
    """Robot seconds in a second, and from the start of the nodes to the end of the watch."""
    print(f"{ROBOT_S:g} s of robot time: seconds from the nodes' start; factor while ticking")
    for name, processes in LOADS.items():
        with load(processes):
            for nodes in (1, 2, 8):
                runs = [speed_of(nodes) for _ in range(5)]
                total_s = statistics.median(total for total, _ in runs)
                factor = statistics.median(factor for _, factor in runs)
                print(f"  {name:10} {nodes} nodes  {total_s:.2f} s  {factor:.1f} x", flush=True)


def speed_of(count: int) -> tuple[float, float]:
    """Seconds from the start of `count` nodes, and robot seconds in a second."""
    script = SCRIPTS / "styles" / "timer.py"
    with (
        tempfile.TemporaryDirectory() as folder,
        stage(script, folder) as room,
        ExitStack() as all_,
    ):
        _, probe, arena = room
        began_s = time.monotonic()
        names = [f"/talker_{n}" for n in range(count)]
        for name in names:
            words = ["--ros-args", "-p", "use_sim_time:=true", "-r", f"__node:={name[1:]}"]
            all_.enter_context(arena.run("talker", words))
        probe.until(lambda: set(names) <= set(probe.seen.graph.nodes), 60)
        clock, barrier = all_.enter_context(followed_clock(probe, names))
        ticking_s = time.monotonic()
        for _ in range(round(ROBOT_S * 1e9 / STEP_NS)):
            clock.tick(STEP_NS, barrier, 10.0)
        end_s = time.monotonic()
        return end_s - began_s, ROBOT_S / (end_s - ticking_s)


# --- how soon a node is seen -------------------------------------------------------------------


def discovery() -> None:
    """From the start of a node to the moment when the probe sees it."""
    script = SCRIPTS / "styles" / "timer.py"
    took_s = []
    for _ in range(DISCOVERIES):
        with tempfile.TemporaryDirectory() as folder, stage(script, folder) as room:
            scene, _, _ = room
            with scene.run(NodeContract(node="/talker", executable="talker")):
                took_s.append(scene.seen.discovery_s)
    print(
        f"discovery, process start included: p50 {statistics.median(took_s):.2f} s,"
        f" worst of {DISCOVERIES} {max(took_s):.2f} s"
    )


# --- behind the wall ---------------------------------------------------------------------------


@contextmanager
def stage(script: Path, folder: str) -> Iterator[tuple[Scene, Probe, Arena]]:
    """A scene in a fresh arena, where the script is the program `talker`."""
    home = Path(folder)
    with (
        opened(installed(script, home), ArenaPlace(our_wall(), home, home)) as arena,
        Probe(arena.domain_id, ExperimentSeen(name="bench", clock="wall")) as probe,
    ):
        yield Scene(arena, probe, 1, 2.0), probe, arena


def our_wall() -> Wall:
    """The wall that this process was started behind."""
    wall: Wall = json.loads(os.environ["BENCH_WALL"])
    return wall


SECTIONS = {"error": error, "speed": speed, "discovery": discovery}


def main(words: Sequence[str]) -> None:
    """Run the sections; those that watch in this process go behind the wall first."""
    count = int(words[-1]) if words and words[-1].isdecimal() else 5
    chosen = [word for word in words if not word.isdecimal()] or [*SECTIONS, "verdicts"]
    print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores", flush=True)
    wall = choose_isolation()
    for name in chosen:
        if name == "verdicts":
            verdicts(count)
        elif "BENCH_WALL" in os.environ:
            SECTIONS[name]()
        else:
            behind = {"BENCH_WALL": json.dumps(wall.wall), **ros_environment(wall.wall)}
            command = wall.command([sys.executable, __file__, name])
            subprocess.run(command, env={**os.environ, **behind}, check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
