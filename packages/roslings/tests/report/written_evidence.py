"""Evidence written by hand, as a grading would leave it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from written_graphs import STRING, graph

from roslings.evidence import (
    BuildSeen,
    Ending,
    Evidence,
    ExperimentSeen,
    LogLine,
    MachineSeen,
    MessageSeen,
    PackageSeen,
    ProcessSeen,
    TopicSeen,
)

START_NS = 5_000_000_000
EPOCH_NS = 1_800_000_000_000_000_000
MACHINE = MachineSeen(
    roslings="0.1.0",
    ros_distro="jazzy",
    rmw="rmw_fastrtps_cpp",
    python="3.12.3",
    platform="Linux 6.8 x86_64",
    isolation="namespace",
)


def messages(
    times_s: Sequence[float], lost: Collection[int] = (), simulated: bool = False
) -> list[MessageSeen]:
    """One message sent at each time, without those whose index is in `lost`."""
    return [
        MessageSeen(
            source_ns=EPOCH_NS + round(time_s * 1e9),
            sequence=index + 1,
            arrival_ns=START_NS + round(time_s * 1e9) + 400_000,
            sim_ns=round(time_s * 1e9) if simulated else None,
            size=24,
            content={"data": f"Hello robotics {index}"},
        )
        for index, time_s in enumerate(times_s)
        if index not in lost
    ]


def steady(period_s: float, count: int) -> list[float]:
    """The times of a timer."""
    return [index * period_s for index in range(count)]


def process(name: str, *texts: str) -> ProcessSeen:
    """A process that wrote these lines and ended after Ctrl-C."""
    return ProcessSeen(
        executable=name,
        started_ns=START_NS,
        ended_ns=START_NS + 6_000_000_000,
        status=0,
        ending=Ending(signal="SIGINT", after_s=0.1, watched_s=0.1),
        lines=[
            LogLine(arrival_ns=START_NS + 10**9, text=text, source="terminal") for text in texts
        ],
    )


def talking(heard: Sequence[MessageSeen], topic: str = "/chatter", *lines: str) -> ExperimentSeen:
    """The talker alone."""
    return ExperimentSeen(
        name="talking",
        clock="wall",
        graph=graph(publishes=[("/talker", topic, STRING)]),
        topics={topic: TopicSeen(name=topic, type=STRING, messages=list(heard))},
        processes={"talker": process("talker", *(lines or ("Publishing: 'Hello robotics 0'",)))},
    )


def evidence(*experiments: ExperimentSeen, package: str = "chatter") -> Evidence:
    """A grading with these experiments."""
    return Evidence(
        lab="topics",
        seed=7,
        machine=MACHINE,
        package=PackageSeen(name=package, folder=package, build_type="ament_python"),
        build=BuildSeen(
            succeeded=True,
            recognised_as="ros.ament_python",
            seconds=1.5,
            output=["Finished <<< chatter [1.20s]"],
            executables=["talker", "listener"],
        ),
        experiments={each.name: each for each in experiments},
    )
