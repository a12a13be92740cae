"""`prove --rewritten`: what a rewrite makes does the same, is Python, and its result is told."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node

from few import few_labs
from roslings.course import Lab, all_labs, lab
from roslings.evidence import Evidence
from roslings.verdict import CheckResult, Environment, Timings, Verdict
from roslings.workspace.inspect import inspect_package
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingResult
from roslings_prove.new_lab import new_lab
from roslings_prove.prove import Proof
from roslings_prove.rewritten import Rewritten, Score, rewritten
from roslings_prove.rewritten.arguments import OF_ROS
from roslings_prove.rewritten.grading import _proofs
from roslings_prove.rewritten.keeping import AlreadyRewriting, kept_results
from roslings_prove.rewritten.source import CannotRewrite, Sources
from roslings_prove.rewritten.table import COMBINATIONS, REWRITES, all_at_once, made_from
from until_told import checked

EXAMPLE = lab("example")
HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n"
MAIN = """
def main(args=None):
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
"""
TALKER = (
    HEAD
    + """LIMIT = 3


def short(text):
    return text[:LIMIT]


class Talker(Node):
    \"\"\"It talks.\"\"\"

    def __init__(self):
        super().__init__('beacon')
        self.declare_parameter('period', 0.5)
        self.kept = self.declare_parameter('word', 'hello').value
        self.publisher = self.create_publisher(String, 'alive', 10)
        self.create_timer(0.1, self.talk)  # seconds

    def talk(self):
        message = String()
        message.data = f'{self.kept} {1.5:.2f} %'
        self.publisher.publish(message)
        self.get_logger().info(short(message.data))

    def period(self):
        return self.get_parameter('period').value
"""
    + MAIN
)


def sources(**modules: str) -> Sources:
    """The example's package with other modules."""
    found = Sources.read(EXAMPLE.solution, EXAMPLE.card)
    kept = {name: text for name, text in found.texts.items() if not name.endswith("/beacon.py")}
    code = {f"beacon/{name}.py": text for name, text in modules.items()}
    return replace(found, texts={**kept, **code})


def changed(name: str, text: str = TALKER) -> str:
    """What a rewrite makes of one module."""
    return REWRITES[name](sources(beacon=text)).texts["beacon/beacon.py"]


EXPECTED = {
    "extracted": "self.finish_talk(message)\n\n    def finish_talk(self, message):\n",
    "inlined": "self.get_logger().info((message.data[:LIMIT]))",
    "values by type": "return self.get_parameter('period').get_parameter_value().double_value",
    "read live": "f'{self.get_parameter(\"word\").value} {1.5:.2f} %'",
    "noted by a callback": "if parameter.name == 'period':\n                self.period_now =",
    "a rate in a thread": "self.rate = self.create_rate(1 / 0.1)",
    "multi threaded": "rclpy.spin(Talker(), executor=MultiThreadedExecutor())",
    "a loop of spin once": "node = Talker()\n        while rclpy.ok():\n            rclpy.spin",
    "a with block": "try:\n        with ros(args):\n            rclpy.spin(Talker())\n    except",
    "reentrant groups": "self.create_timer(0.1, self.talk, callback_group=group)",
    "async callbacks": "    async def talk(self):",
    "longer queues": "self.create_publisher(String, 'alive', QoSProfile(depth=50))",
    "another qos that fits": "QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
    "print for the logger": "        print(short(message.data))",
    "format for f strings": "'{} {:.2f} %'.format(self.kept, 1.5)",
    "percent for f strings": "('%s %.2f %%' % (self.kept, 1.5))",
    "keyword arguments": "self.create_timer(timer_period_sec=0.1, callback=self.talk)",
    "composition for inheritance": "self.node = Node('beacon')\n        self.node.declare_param",
    "methods in another order": '    """It talks."""\n\n    def period(self):',
    "renamed classes": "rclpy.spin(MyTalker())",
    "renamed functions": "self.create_timer(0.1, self.do_talk)",
    "renamed attributes": "self.my_publisher.publish(message)",
    "renamed variables": "return the_text[:THE_LIMIT]",
    "stripped": "class Talker(Node):\n\n    def __init__(self):",
    "double quotes": 'super().__init__("beacon")',
}


@pytest.mark.parametrize("name", EXPECTED)
def test_each_rewrite_writes_what_it_says(name: str) -> None:
    """And what it makes is Python."""
    new = changed(name)
    assert EXPECTED[name] in new
    compile(new, name, "exec")


def test_each_rewrite_is_shown() -> None:
    """Those of whole files below."""
    below = {
        "one file into three",
        "all files into one",
        "other quotes in lines",
        "logger for print",
        "a goal that sleeps",
    }
    assert set(REWRITES) - set(EXPECTED) == below


@pytest.mark.parametrize(
    ("line", "new"),
    [
        ("f\"I heard: '{text}'\"", "f'I heard: \"{text}\"'"),
        ('f"I heard {text}"', "f'I heard {text}'"),
        ("f\"I heard {each['text']}\"", "f\"I heard {each['text']}\""),
    ],
)
def test_other_quotes_are_written(line: str, new: str) -> None:
    """In what the program says, where that leaves it a program of Python 3.10."""
    talker = TALKER.replace("short(message.data))", f"{line})")
    assert f"info({new})" in changed("other quotes in lines", talker)


PROGRAM = """import sys


def tell(word):
    print(f'it is {word}')
    print('nothing', word)
    print(word)


def main():
    tell(sys.argv[1])
"""


def test_a_program_without_a_node_gets_one_to_log_with() -> None:
    """For its texts; what a logger does not take stays as it is, and so does a node's own print."""
    new = logging(PROGRAM)
    assert "writer().get_logger().info(f'it is {word}')" in new
    assert "    print('nothing', word)\n    print(word)\n" in new
    assert "@cache\ndef writer():" in new and "import rclpy\n" in new
    compile(new, "beacon", "exec")
    assert logging(new) == new
    node = TALKER.replace("self.get_logger().info(", "print(f'' + ")
    assert logging(node) == node
    assert logging(PROGRAM, allowed=()) == PROGRAM


def logging(code: str, allowed: tuple[str, ...] = ("print() or get_logger()",)) -> str:
    """The program with a logger, where the card leaves that free."""
    given = sources(beacon=code)
    free = replace(given, card=given.card.model_copy(update={"not_judged": allowed}))
    return REWRITES["logger for print"](free).texts["beacon/beacon.py"]


def sleeping(solution: Sources) -> str:
    """The server of the lab, as the rewrite makes it."""
    return REWRITES["a goal that sleeps"](solution).texts["drive_to/drive_server.py"]


def test_a_goal_sleeps_in_place_of_awaiting_a_tick() -> None:
    """As day 5 once taught it: more threads, and neither a coroutine nor a timer is left."""
    server = sleeping(Sources.read(lab("actions").solution, lab("actions").card))
    compile(server, "drive_server", "exec")
    assert "    def drive(self, goal_handle):" in server
    assert "            time.sleep(PERIOD)" in server and "import time\n" in server
    assert "rclpy.spin(DriveServer(), executor=MultiThreadedExecutor())" in server
    assert not re.search(r"async|await|create_timer|tick", server)


def test_a_goal_that_awaits_something_else_too_is_left_alone() -> None:
    """Only a tick can become a sleep."""
    solution = Sources.read(lab("actions").solution, lab("actions").card)
    server = solution.texts["drive_to/drive_server.py"]
    other = server.replace("        goal = goal", "        await self.ready\n        goal = goal")
    assert other != server
    texts = {**solution.texts, "drive_to/drive_server.py": other}
    assert sleeping(replace(solution, texts=texts)) == other


def test_one_file_becomes_three() -> None:
    """Each imports what it needs, and nothing else."""
    made = REWRITES["one file into three"](sources(beacon=TALKER)).texts
    assert {name for name in made if name.startswith("beacon/")} == {
        "beacon/__init__.py",
        "beacon/beacon.py",
        "beacon/beacon_class.py",
        "beacon/beacon_parts.py",
    }
    assert "import" not in made["beacon/beacon_parts.py"]
    assert "from beacon.beacon_parts import short\n" in made["beacon/beacon_class.py"]
    assert "from beacon.beacon_class import Talker" in made["beacon/beacon.py"]
    assert "String" not in made["beacon/beacon.py"]


def test_all_files_become_one() -> None:
    """What is imported comes first; each executable calls its own main."""
    talker = "from beacon.words import WORD\n" + TALKER.replace("'hello'", "WORD")
    made = REWRITES["all files into one"](sources(beacon=talker, words="WORD = 'hello'\n"))
    code = made.texts["beacon/programs.py"]
    assert code.index("WORD = 'hello'") < code.index("class Talker")
    assert "beacon.words" not in code
    assert made.entry_points == [("programs", "beacon_main")]
    assert "def beacon_main(args=None):" in code


def test_two_of_one_name_stay_in_two_files() -> None:
    """One would hide the other."""
    given = sources(beacon=TALKER, words="LIMIT = 5\n")
    assert REWRITES["all files into one"](given) == given


def test_what_ros_calls_by_name_keeps_its_name() -> None:
    """A method that a node has, a field of a message, a keyword, a parameter's name."""
    code = TALKER.replace("def period(self)", "def destroy_node(self)")
    code = code.replace(
        "message = String()", "message = String(data='')\n        self.data = message"
    )
    assert "def destroy_node(self)" in changed("renamed functions", code)
    attributes = changed("renamed attributes", code)
    assert "self.data = message" in attributes and "message.data = f" in attributes
    assert "rclpy.init(args=args)" in changed("renamed variables", code)
    assert "'period'" in changed("renamed variables", code)


def test_the_entry_point_follows_the_name_of_main() -> None:
    """`setup.py` says what the executable calls."""
    made = REWRITES["renamed functions"](sources(beacon=TALKER))
    assert made.entry_points == [("beacon", "do_main")]
    assert "def do_main(" in made.texts["beacon/beacon.py"]


def test_an_import_of_another_package_is_named_in_package_xml() -> None:
    """Who imports SetParametersResult depends on rcl_interfaces."""
    made = REWRITES["noted by a callback"](sources(beacon=TALKER))
    assert made.texts["package.xml"].count("<exec_depend>rcl_interfaces</exec_depend>") == 1


def test_values_are_noted_after_a_node_has_agreed() -> None:
    """Who may refuse a value must not find it noted already."""
    judges = TALKER.replace(
        "        self.create_timer",
        "        self.add_on_set_parameters_callback(self.judge)\n        self.create_timer",
        1,
    )
    made = changed("noted by a callback", judges)
    assert "self.add_post_set_parameters_callback(self.take_parameters)" in made
    assert made.count("add_on_set_parameters_callback") == 1
    assert "return SetParametersResult" not in made


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("a rate in a thread", TALKER.replace("0.1, self.talk", "0.1, self.talk, None")),
        ("a rate in a thread", TALKER.replace("self.create_timer", "self.create_wall")),
        ("a rate in a thread", TALKER.replace("publisher.publish", "kept.set_result")),
        ("async callbacks", TALKER.replace("return self.g", "self.talk()\n        return self.g")),
        ("inlined", TALKER.replace("info(short(message.data))", "info(str(short))")),
        ("reentrant groups", TALKER.replace("Talker())", "Talker(), MultiThreadedExecutor())")),
        ("a with block", TALKER.replace("rclpy.try_shutdown()", "rclpy.try_shutdown(); print()")),
        ("print for the logger", TALKER.replace("(message.data))", "(message.data), once=True)")),
    ],
)
def test_what_would_change_what_it_does_is_left_alone(name: str, code: str) -> None:
    """A rewrite looks before it leaps."""
    assert changed(name, code) == code


def test_print_only_where_the_card_allows_it() -> None:
    """A card that asks for a log, and does not say that print is as good."""
    given = sources(beacon=TALKER)
    nodes = tuple(node.model_copy(update={"log": "{text}"}) for node in given.card.nodes)
    asking = given.card.model_copy(update={"nodes": nodes, "not_judged": ()})
    given_asking = replace(given, card=asking)
    assert REWRITES["print for the logger"](given_asking) == given_asking


def test_another_qos_only_where_the_card_allows_it() -> None:
    """A card that says what ours must be, not what it must fit."""
    given = sources(beacon=TALKER)
    node = given.card.nodes[0]
    topic = node.publishes[0]
    exact = topic.model_copy(update={"qos": topic.qos.model_copy(update={"exact": True})})
    nodes = (node.model_copy(update={"publishes": (exact,)}),)
    strict = replace(given, card=given.card.model_copy(update={"nodes": nodes}))
    assert REWRITES["another qos that fits"](strict) == strict


@pytest.mark.parametrize("function", sorted(set(OF_ROS) - {"spin"}))
def test_rclpy_calls_its_arguments_as_we_do(function: str) -> None:
    """In the order of the table."""
    kinds: dict[str, Callable[..., object]] = {
        "ActionServer": ActionServer.__init__,
        "ActionClient": ActionClient.__init__,
    }
    there = list(inspect.signature(kinds.get(function) or getattr(Node, function)).parameters)
    assert there[1 : 1 + len(OF_ROS[function])] == list(OF_ROS[function])


# --- all labs ----------------------------------------------------------------------------------


@cache
def made_of(name: str) -> list[Rewritten]:
    """What is made of a lab."""
    return rewritten(lab(name))


@pytest.mark.slow
def test_each_rewrite_applies_to_some_lab() -> None:
    """And each lab has a dozen at least, and its combinations; half of it where no node is."""
    made = {one.name: made_of(one.name) for one in all_labs()}
    used = {each.made.name for packages in made.values() for each in packages}
    assert set(REWRITES) <= used
    for name, packages in made.items():
        assert len(packages) >= (12 if lab(name).card.nodes else 6) + COMBINATIONS
        assert len({each.name for each in packages}) == len(packages)


@few_labs("one")
def test_what_is_made_is_a_package(one: Lab, tmp_path: Path) -> None:
    """Its Python can be read, its executables exist, and package.xml names what it imports."""
    for each in made_of(one.name):
        folder = each.make(tmp_path)
        seen = inspect_package(folder, one.card)
        assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors], each.about
        assert set(seen.imported) <= set(seen.declared), each.about
        for module, function in each.made.sources.entry_points:
            code = (folder / one.card.package / f"{module}.py").read_text("utf-8")
            assert re.search(rf"^def {function}\(", code, re.MULTILINE), each.about


def test_chance_is_the_same_each_time() -> None:
    """So that a problem can be looked at again."""
    given = Sources.read(EXAMPLE.solution, EXAMPLE.card)
    names = [each.name for each in made_from(given)]
    assert names == [each.name for each in made_from(given)]
    together = all_at_once(given, ["multi threaded", "renamed classes"])
    assert together.name == "multi threaded + renamed classes"
    assert "MyBeacon(), executor=" in together.sources.texts["beacon/beacon.py"]


# --- what comes of it --------------------------------------------------------------------------


def result(points: int, name: str = "it") -> GradingResult:
    """A result whose one check has so many of 100 points."""
    outcome = "pass" if points == 100 else "fail"
    check = CheckResult(
        id="rate",
        title="rate",
        outcome=outcome,
        points=points,
        max_points=100,
        measured="1 Hz",
        fault=None if points == 100 else "TooSlow",
    )
    verdict = Verdict(
        lab="example",
        package="beacon",
        outcome=outcome,
        score=points,
        checks=(check,),
        seconds=Timings(total=1.0),
        environment=Environment.model_construct(),
    )
    return GradingResult(submission=name, digest="0", attempt=1, state="graded", verdict=verdict)


def test_who_loses_a_point_is_shown_with_what_was_rewritten() -> None:
    """The checks that fail, and the lines that are not as in the solution."""
    first, second, third, *_ = rewritten(EXAMPLE)
    broken = GradingResult(
        submission=third.name, digest="0", attempt=1, state="broken", reason="no room"
    )
    results = {first.name: result(100), second.name: result(0), third.name: broken}
    told = list(_proofs(EXAMPLE, [first, second, third], results))
    proofs = [each for each in told if isinstance(each, Proof)]
    assert [proof.holds for proof in proofs] == [True, True, False, False]
    assert [proof.is_open for proof in proofs] == [False, False, False, True]
    assert "0 of 100; it fails: rate (1 Hz)" in proofs[2].problem
    assert "--- solution/beacon/beacon.py" in proofs[2].problem
    assert told[-1] == Score("example", 1, 3)
    assert told[-1].line == "example: 1 of 3 rewritten solutions get 100 (33%)"


def test_a_solution_of_another_kind_is_refused(tmp_path: Path) -> None:
    """A package without setup.py is no Python package."""
    with pytest.raises(CannotRewrite, match=r"it has no package\.xml and no setup\.py"):
        Sources.read(tmp_path, EXAMPLE.card)


@pytest.mark.slow
@pytest.mark.twice
def test_a_new_lab_takes_every_right_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For real, with the command: a lab that an instructor has just made."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    new_lab("line-follower", package="follower", day="09-lines")
    command = [sys.executable, "-m", "roslings", "prove", "line-follower", "--rewritten"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"(\d+) of \1 rewritten solutions get 100 \(100%\)", done.stdout)
    first = kept(tmp_path)
    subprocess.run(command, capture_output=True, check=True, cwd=tmp_path)
    assert kept(tmp_path) == first, "a second run goes on where the first one was"


@pytest.mark.slow
def test_a_program_that_logs_its_lines_gets_all_points(tmp_path: Path) -> None:
    """For real: each line goes to the terminal and to /rosout, where the grader hears both."""
    (logs,) = (each for each in rewritten(lab("black-box")) if each.made.name == "logger for print")
    made, kept = logs.make(tmp_path), tmp_path / "kept"
    done = checked("black-box", made, "--evidence", kept, folder=tmp_path, kept=kept).ran
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 of 100" in done.stdout
    seen = Evidence.model_validate_json((tmp_path / "kept" / "evidence.json").read_bytes())
    process = seen.experiments["reading"].processes["drive"]
    assert all(line.is_logged for line in process.lines)


@pytest.mark.slow
def test_a_goal_that_sleeps_gets_all_points(tmp_path: Path) -> None:
    """For real: what day 5 once taught is right."""
    (sleeps,) = (
        each for each in rewritten(lab("actions")) if each.made.name == "a goal that sleeps"
    )
    done = checked("actions", sleeps.make(tmp_path), folder=tmp_path).ran
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 of 100" in done.stdout


def kept(course: Path) -> dict[str, GradingResult]:
    """All results that stay in a course."""
    with gradebook(course / ".roslings" / "rewritten", "labs") as book:
        return book.latest()


def test_one_command_at_a_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two would grade everything twice."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    with (
        kept_results(),
        pytest.raises(AlreadyRewriting, match="Wait until it ends"),
        kept_results(),
    ):
        pass


@few_labs("each")
def test_every_module_that_is_made_knows_its_names(each: Lab, tmp_path: Path) -> None:
    """One that is split lacks no import that a later rewrite needs; all pairs are tried."""
    solution = Sources.read(each.solution, each.card)
    after_splitting = [
        all_at_once(solution, ["one file into three", name])
        for name in REWRITES
        if name != "one file into three"
    ]
    for number, made in enumerate([*made_from(solution), *after_splitting]):
        made.sources.write(each.solution, tmp_path / f"{number}")
    words = [sys.executable, "-m", "ruff", "check", "--isolated", "--select", "F821", tmp_path]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
