"""What a student may do to a drill's file, and what comes of it."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from changed_drills import changed, check

from roslings_learn.drills import Drill, drill


def test_a_file_that_python_cannot_read_is_not_run(tmp_path: Path) -> None:
    """File, line and Python's words."""
    file = changed(tmp_path, "no_spin", "def main():", "def main()")
    verdict = check(drill("no_spin"), file)
    assert verdict.first and verdict.first.fault == "SyntaxErrorInCode"
    assert verdict.headline.startswith("starter.py, line ")
    assert "expected ':'" in verdict.headline


@pytest.mark.slow
@pytest.mark.parametrize("stream", ["stdout", "stderr"])
@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("    rclpy.spin(Tick())", "    tick = Tick()\n    {loop}"),
        ("        self.count += 1", "        {loop}"),
    ],
    ids=["instead of spin", "in a callback"],
)
def test_a_program_that_prints_without_end_is_told_its_lines(
    tmp_path: Path, before: str, after: str, stream: str
) -> None:
    """At once, and never that nobody can tell.

    On a busy computer it has printed too little to be called endless; it never spins then, too.
    """
    loop = f"while True: print('tick', file=__import__('sys').{stream})"
    file = changed(tmp_path, "first_node", before, after.format(loop=loop), of="solution")
    verdict = check(drill("first_node"), file)
    assert verdict.outcome == "fail" and verdict.first
    assert verdict.first.fault in ("PrintsWithoutEnd", "NeverSpins")
    told = re.search(r"it wrote [\d,]+ lines", verdict.headline)
    assert bool(told) == (verdict.first.fault == "PrintsWithoutEnd")


def test_a_wrong_answer_is_told_without_the_right_one(tmp_path: Path) -> None:
    """The right one is for the student to find."""
    file = changed(tmp_path, "full_name", "ANSWER = None", "ANSWER = '/wheel'")
    verdict = check(drill("full_name"), file)
    assert verdict.first and verdict.first.fault == "WrongPrediction"
    assert "/left/front/wheel" not in verdict.first.model_dump_json()


def test_only_the_answer_may_be_changed(tmp_path: Path) -> None:
    """The question is about this program."""
    file = changed(tmp_path, "full_name", '="left/front"', '="left"', of="solution")
    verdict = check(drill("full_name"), file)
    assert verdict.first and verdict.first.fault == "ProgramChanged"


def test_an_answer_may_be_right_in_other_words(tmp_path: Path) -> None:
    """4 and 4.0 are one number."""
    file = changed(tmp_path, "every_other", "ANSWER = None", "ANSWER = 4.0")
    verdict = check(drill("every_other"), file)
    assert verdict.outcome == "pass"
    assert "1 / 0.125" in verdict.because


def test_a_program_of_other_shape_passes(tmp_path: Path) -> None:
    """What is judged is what it does."""
    file = tmp_path / "mine.py"
    file.write_text(
        "import rclpy\n"
        "from std_msgs.msg import Float64\n"
        "rclpy.init()\n"
        "node = rclpy.create_node('doubler')\n"
        "out = node.create_publisher(Float64, '/doubled', 10)\n"
        "double = lambda heard: out.publish(Float64(data=2 * heard.data))\n"
        "node.create_subscription(Float64, '/number', double, 10)\n"
        "while rclpy.ok():\n"
        "    rclpy.spin_once(node)\n"
    )
    assert check(drill("doubler"), file).outcome == "pass"


def test_a_wrong_sum_is_told_with_both_numbers(tmp_path: Path) -> None:
    """What went in, and what came out."""
    file = changed(tmp_path, "doubler", "* 2", "+ 2", of="solution")
    verdict = check(drill("doubler"), file)
    assert verdict.first and verdict.first.fault == "WrongReaction"
    assert verdict.headline == "after data 2.5 on /number: data 4.5 on /doubled"


def with_card(tmp_path: Path, name: str, before: str, after: str) -> Drill:
    """A drill with one word of its card changed."""
    one = drill(name)
    folder = tmp_path / one.folder.name
    shutil.copytree(one.folder, folder)
    card = folder / "drill.yaml"
    text = card.read_text("utf-8")
    assert before in text
    card.write_text(text.replace(before, after), "utf-8")
    return Drill(one.name, one.day, one.number, folder)


TYPE = "type: std_msgs/msg/Float64, "


@pytest.mark.parametrize(
    ("within", "outcome"), [(TYPE, "fail"), (f"{TYPE}numbers_within: 0.01, ", "pass")]
)
def test_a_card_says_how_far_off_a_number_may_be(tmp_path: Path, within: str, outcome: str) -> None:
    """As the card of a lab does."""
    file = changed(tmp_path, "doubler", "* 2", "* 2.001", of="solution")
    one = with_card(tmp_path, "doubler", f"{TYPE}fields", f"{within}fields")
    assert check(one, file).outcome == outcome


def test_what_hears_another_type_is_told_nothing(tmp_path: Path) -> None:
    """A message of the card does not fit into it."""
    source = drill("doubler").solution.read_text("utf-8")
    file = tmp_path / "doubler.py"
    file.write_text(
        source.replace("import Float64", "import Float64, Int32").replace(
            'Float64, "number"', 'Int32, "number"'
        )
    )
    verdict = check(drill("doubler"), file)
    assert verdict.first and verdict.first.fault == "WrongType"
    assert "std_msgs/msg/Int32" in verdict.headline


def test_an_answer_that_does_not_come_is_told_with_its_case(tmp_path: Path) -> None:
    """A node that hears, and says nothing."""
    before = "self.publisher.publish(Float64(data=message.data * 2))"
    file = changed(tmp_path, "doubler", before, "pass", of="solution")
    verdict = check(drill("doubler"), file)
    assert verdict.first and verdict.first.fault == "DoesNotReact"
    assert verdict.headline == "after data 2.5 on /number: no message on /doubled"


OWN_CHECK = """
from roslings_learn.drills.steps import Step


def demand(view):
    assert view.seen.graph.nodes == ["/tower"], "it is no tower"


def steps(card):
    yield Step("tower", "It is a tower.", demand)
"""


def test_a_drill_may_bring_a_check_of_its_own(tmp_path: Path) -> None:
    """For what no card can say."""
    folder = tmp_path / "01_no_spin"
    shutil.copytree(drill("no_spin").folder, folder)
    (folder / "check.py").write_text(OWN_CHECK)
    one = Drill("no_spin", "02-nodes", 1, folder)
    verdict = check(one, one.solution)
    assert verdict.first and (verdict.first.id, verdict.first.fault) == ("tower", "Unmet")
    assert "it is no tower" in (verdict.first.measured or "")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("first", "outcome"),
    [("timeout 4 sh -c 'while :; do :; done' || true", "pass"), ("sleep 60", "fail")],
    ids=["works", "sleeps"],
)
def test_a_script_that_still_loads_is_waited_for(tmp_path: Path, first: str, outcome: str) -> None:
    """A slow computer needs seconds for two `ros2` commands; who only sleeps is not waited for."""
    begins = "ros2 topic pub"
    file = changed(tmp_path, "one_terminal", begins, f"{first}\n{begins}", of="solution")
    verdict = check(drill("one_terminal"), file)
    assert verdict.outcome == outcome
    assert outcome == "pass" or (verdict.first and verdict.first.fault == "NotPrinted")
