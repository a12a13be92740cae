"""A launch in two namespaces: its graph, its values, its arguments, what comes back and ends."""

from __future__ import annotations

from typing import Any

import pytest

from roslings.capabilities.launch import faults
from roslings.capabilities.launch.contract import (
    ArgumentContract,
    LaunchContract,
    NamespaceContract,
)
from roslings.capabilities.launch.demands import (
    be_alike,
    come_back,
    end_as_a_whole,
    follow_the_argument,
    follow_the_file,
    give_its_values,
    leave_out,
    show_its_arguments,
    start_in_each_namespace,
    win_over_its_section,
)
from roslings.capabilities.launch.record import LABEL, LaunchSeen, ProgramKilled
from roslings.capabilities.parameters.record import ParametersRead, ParametersSeen
from roslings.course import NodeContract
from roslings.evidence import (
    Ending,
    Endpoint,
    ExperimentSeen,
    GraphSeen,
    HeldUpSeen,
    LogLine,
    ProcessSeen,
    Qos,
)
from roslings.judge import ExperimentView, Inconclusive, NothingToJudge

LOUD = ArgumentContract(name="loud", about="", default="false", tried="true", sets="it.loud")
FILE = ArgumentContract(name="file", about="", default="config/all.yaml", tried="another")
TWO = LaunchContract(
    file="launch/two.launch.py",
    starts=("it",),
    respawns=("it",),
    respawns_within_s=2.0,
    arguments=(FILE, LOUD),
    namespaces=(
        NamespaceContract(namespace="/left", values={"it.size": 10}),
        NamespaceContract(namespace="/right", only_with="right", values={"it.size": 20}),
    ),
)
IT = NodeContract(node="/it", executable="it")


def node(executable: str) -> NodeContract:
    """As `CARD.node`."""
    assert executable == IT.executable
    return IT


def end(node: str, topic: str) -> Endpoint:
    """A publisher."""
    return Endpoint(kind="publisher", node=node, topic=topic, type="a/msg/B", qos=Qos(), gid="")


def view(*nodes: str, ends: tuple[Endpoint, ...] = (), **more: Any) -> ExperimentView:
    """What is seen of a launch with these nodes in the graph."""
    fields: dict[str, Any] = {"status": None, "launch": LaunchSeen(), "read": {}, **more}
    process = ProcessSeen(
        executable=f"{LABEL} two two.launch.py",
        started_ns=0,
        status=fields["status"],
        ended_by_itself=fields["status"] is not None,
        ending=fields.get("ending"),
        left_behind=fields.get("left", 0),
        lines=[
            LogLine(arrival_ns=1, text=line, source="terminal") for line in fields.get("lines", ())
        ],
    )
    read = [ParametersRead(node=name, values=values) for name, values in fields["read"].items()]
    seen = ExperimentSeen(
        name="launch",
        clock="wall",
        processes={LABEL: process},
        graph=GraphSeen(nodes=[*dict.fromkeys((*nodes, *fields["read"]))], endpoints=[*ends]),
        held_up=fields.get("held_up", {}),
        parts={"launch": fields["launch"], "parameters": ParametersSeen(read=read)},
    )
    return ExperimentView(seen)


def test_each_namespace_has_each_node() -> None:
    """A node elsewhere has another hint than one that is missing."""
    demand = start_in_each_namespace(TWO, ["/it"])
    view("/left/it", "/right/it").must(demand)
    with pytest.raises(faults.NodeElsewhere, match="starts /right/it"):
        view("/left/it", "/it").must(demand)
    with pytest.raises(faults.LaunchMissesNode) as caught:
        view("/left/it", "/right/other").must(demand)
    assert type(caught.value) is faults.LaunchMissesNode


def test_two_namespaces_are_alike() -> None:
    """With the same topics, none of them outside."""
    names = ("/left/it", "/right/it")
    both = [end(name, f"{name[:-3]}/out") for name in names]
    view(*names, ends=(*both,)).must(be_alike(TWO))
    with pytest.raises(faults.NamespacesDiffer, match="only in /right: it publishes out"):
        view(*names, ends=(both[1],)).must(be_alike(TWO))
    differ = view(*names, ends=(both[1],))
    differ.must(be_alike(TWO, view(*names, ends=(*both,))))
    with pytest.raises(faults.NamespacesDiffer):
        differ.must(be_alike(TWO, view(), differ))
    busy = {"launch": HeldUpSeen(cpu_wait_s=5.0, stall_s=0.0)}
    with pytest.raises(Inconclusive, match="a topic of the launch came late"):
        view(*names, ends=(both[1],), held_up=busy).must(be_alike(TWO))
    with pytest.raises(faults.TopicOutside, match="it uses /out"):
        view(*names, ends=(end("/left/it", "/out"), end("/right/it", "/out"))).must(be_alike(TWO))


def test_the_values_are_those_of_the_card() -> None:
    """10 and 10.0 are one; who said nothing is not judged."""
    demand = give_its_values(TWO, node)
    view(read={"/left/it": {"size": 10.0}, "/right/it": {"size": 20}}).must(demand)
    with pytest.raises(faults.WrongValueAfterLaunch, match=r"size of /right/it is 20.*it is 10"):
        view(read={"/left/it": {"size": 10}, "/right/it": {"size": 10}}).must(demand)
    with pytest.raises(NothingToJudge):
        view(read={"/left/it": {"size": 10}}).must(demand)


def test_who_gave_no_answer_is_not_judged_by_its_neighbour() -> None:
    """On a busy computer one of two may be silent: what the other one lacks says nothing of it."""
    right, other = {"size": 10}, {"rate": 5}
    read = {"/left/it": right, "/right/other": other}
    with pytest.raises(Inconclusive, match="/right/it did not say"):
        view("/right/it", read=read).must(give_its_values(TWO, node))


def test_the_file_that_was_given_counts_and_the_argument_wins() -> None:
    """The file says that it is not loud; whoever launched it says that it is."""
    launch = LaunchSeen(given={"loud": "true"}, values={"it.size": 7, "it.loud": False})
    right = {"size": 7, "loud": True}
    demands = (follow_the_file(TWO, node), follow_the_argument(TWO, LOUD, node))
    view(launch=launch, read={"/left/it": right, "/right/it": right}).must(*demands)
    with pytest.raises(faults.FileIgnored):
        read = {"/left/it": right, "/right/it": {**right, "size": 20}}
        view(launch=launch, read=read).must(demands[0])
    with pytest.raises(faults.ArgumentIgnored, match=r"loud of /left/it is true.*it is false"):
        view(launch=launch, read={"/left/it": {**right, "loud": False}}).must(demands[1])
    with pytest.raises(NothingToJudge):
        view(read={"/left/it": right}).must(demands[0])


def test_a_section_of_the_node_is_told_where_only_it_has_won() -> None:
    """The file says no to all, and once more to /right/it; whoever launched it says yes."""
    launch = LaunchSeen(
        given={"loud": "true"}, values={"it.loud": False}, by_name={"/right/it": {"loud": False}}
    )
    quiet, loud = {"loud": False}, {"loud": True}
    every, own = follow_the_argument(TWO, LOUD, node), win_over_its_section(TWO, LOUD, node)
    view(launch=launch, read={"/left/it": loud, "/right/it": loud}).must(every, own)
    named = view(launch=launch, read={"/left/it": loud, "/right/it": quiet})
    named.must(every)
    with pytest.raises(faults.SectionOfTheNodeWins, match="in its section /right/it") as caught:
        named.must(own)
    assert "name=..." in caught.value.mend
    with pytest.raises(faults.ArgumentIgnored) as nobody:
        view(launch=launch, read={"/left/it": quiet, "/right/it": quiet}).must(every)
    assert type(nobody.value) is faults.ArgumentIgnored


def test_a_launch_file_may_name_a_node_as_the_card_does() -> None:
    """Whatever it is called in its code: that is the fault of another check."""
    demand = start_in_each_namespace(TWO, ["/it", "/coded"])
    view("/left/it", "/right/coded").must(demand)
    with pytest.raises(faults.LaunchMissesNode, match="starts /right/coded"):
        view("/left/it", "/right/other").must(demand)


def test_what_an_argument_leaves_out() -> None:
    """Not in the graph, and not as a program either; the other namespace is there."""
    demand, one = leave_out(TWO, "right"), LaunchSeen(running={"it": 1})
    view("/left/it", launch=one).must(demand)
    with pytest.raises(faults.StartedAllTheSame, match="/right/it"):
        view("/left/it", "/right/it", launch=one).must(demand)
    with pytest.raises(faults.StartedAllTheSame, match="2 times"):
        view("/left/it", launch=LaunchSeen(running={"it": 2})).must(demand)
    with pytest.raises(faults.LaunchMissesNode):
        view("/right/other", launch=one).must(leave_out(TWO, "nothing"))
    with pytest.raises(faults.LaunchFailed):
        view(status=0, launch=LaunchSeen()).must(demand)


SHOWN = (
    "Arguments (pass arguments as '<name>:=<value>'):",
    "",
    "    'file':",
    "        the file",
    "        (default: '/ws/share/two/config/all.yaml')",
    "",
    "    'loud':",
    "        no description given",
    "        (default: 'False')",
)


def test_the_arguments_are_shown_with_their_defaults() -> None:
    """Of a path only the end counts, however it is put together."""
    demand = show_its_arguments(TWO)
    view(lines=SHOWN, status=0).must(demand)
    joined = "(default: PathJoinSubstitution([FindPackageShare(pkg='two'), 'config', 'all.yaml']))"
    view(lines=[*SHOWN[:4], f"        {joined}", *SHOWN[5:]], status=0).must(demand)
    with pytest.raises(faults.WrongArguments, match=r"shows loud \(default: false\)"):
        view(lines=SHOWN[:6], status=0).must(demand)
    with pytest.raises(faults.WrongArguments, match="default: 'True'"):
        view(lines=[*SHOWN[:-1], "        (default: 'True')"], status=0).must(demand)
    with pytest.raises(faults.ArgumentsNotShown):
        view(lines=["no such file"], status=1).must(demand)


def killed(back_s: float | None) -> LaunchSeen:
    """One that was killed, and was back after so long."""
    back_ns = None if back_s is None else int(back_s * 1e9)
    one = ProgramKilled(executable="it", node="/left/it", killed_ns=0, back_ns=back_ns)
    return LaunchSeen(running={"it": 1}, killed=[one])


def test_who_was_killed_comes_back() -> None:
    """In time, where this computer did not hold it up."""
    demand = come_back(TWO)
    view("/left/it", launch=killed(0.5)).must(demand)
    for late in (3.0, None):
        with pytest.raises(faults.NotBack):
            view("/left/it", launch=killed(late)).must(demand)
    busy = {"respawn": HeldUpSeen(cpu_wait_s=1.5, stall_s=0.0)}
    with pytest.raises(Inconclusive):
        view("/left/it", launch=killed(3.0), held_up=busy).must(demand)
    with pytest.raises(faults.NothingToKill, match="it runs other"):
        view("/left/it", launch=LaunchSeen(running={"other": 1})).must(demand)


def ending(after_s: float | None, others_s: float = 0.0) -> Ending:
    """After Ctrl-C."""
    return Ending(signal="SIGINT", after_s=after_s, watched_s=8.0, others_waited_s=others_s)


def test_a_launch_ends_as_a_whole() -> None:
    """In time, and with all that it has started."""
    demand = end_as_a_whole(2.0)
    view("/left/it", ending=ending(0.3)).must(demand)
    with pytest.raises(faults.LeftByTheLaunch, match="1 process still ran"):
        view("/left/it", ending=ending(0.3), left=1).must(demand)
    for late in (5.0, None):
        with pytest.raises(faults.LaunchDoesNotEnd):
            view("/left/it", ending=ending(late)).must(demand)
    with pytest.raises(Inconclusive, match="waited for a processor"):
        view("/left/it", ending=ending(5.0, others_s=4.0)).must(demand)
    with pytest.raises(NothingToJudge):
        view("/left/it").must(demand)
