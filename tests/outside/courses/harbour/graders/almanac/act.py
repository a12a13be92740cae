"""Experiments with wind."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from graders.almanac.record import WindSeen

from roslings.capabilities.qos.contract import AskContract
from roslings.course import NodeContract
from roslings.experiment import Scene

PROGRAM = Path(__file__).with_name("wind.py")
COMES_WITHIN_S, SHOWS_WITHIN_S = 20.0, 3.0


def blow(scene: Scene, node: NodeContract, asked: AskContract, speeds_m_s: Sequence[float]) -> None:
    """A wind of each speed, one after the other, beside the running node."""
    plan = {"topic": asked.topic, "deadline_s": asked.deadline_s, "lease_s": asked.lease_s}
    process = next(each for each in scene.arena.processes if each.alive)
    with scene.arena.companion(PROGRAM, plan, scene.probe.notify) as wind:
        scene.until(lambda: any(each["matched"] for each in wind.told("matched")), COMES_WITHIN_S)
        for count, speed_m_s in enumerate(speeds_m_s, 1):
            line = (node.log or "").format(text=f"{speed_m_s:.1f}")
            wind.tell(blow=speed_m_s)
            scene.until(lambda n=count: len(wind.told("blown")) >= n, SHOWS_WITHIN_S)  # type: ignore[misc]
            scene.until_own(
                lambda said=line: any(said in each.text for each in process.lines()),  # type: ignore[misc]
                SHOWS_WITHIN_S,
            )
        scene.seen.recording(WindSeen).speeds_m_s += [each["blown"] for each in wind.told("blown")]
