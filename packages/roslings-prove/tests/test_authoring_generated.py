"""`prove --generated`: what operators make, which are chosen, what is kept and explained."""

from __future__ import annotations

import ast
import shutil
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, lab
from roslings.course.files import BadCourseFile, read_tree, read_yaml
from roslings.course.labs import example_root
from roslings.verdict import CheckOutcome, CheckResult, Environment, Timings, Verdict, outcome_of
from roslings_changes.candidates import modules_of
from roslings_changes.operators import OPERATORS
from roslings_changes.source import read_source
from roslings_class import grading
from roslings_class.alone import alone_in
from roslings_class.gradebook import gradebook
from roslings_class.release import is_for_students
from roslings_class.result import GradingOrder, GradingResult, broken
from roslings_class.scheduler import BatchProgress
from roslings_class.submissions import digest_of
from roslings_prove.generated import choice, graded_process
from roslings_prove.generated import run as running
from roslings_prove.generated.choice import Generated, chosen, generated
from roslings_prove.generated.explained import FILE, Explanations, explained
from roslings_prove.generated.keeping import AlreadyProving
from roslings_prove.generated.kills import kill_of
from roslings_prove.generated.packages import Fate, GeneratedPackage, fate_of, judged_by
from roslings_prove.generated.run import Keeping, prove_generated
from roslings_prove.generated.table import HEAD, GeneratedOutcome, told
from roslings_prove.proofs.digests import measuring
from roslings_prove.proofs.kept import Folder, name_in
from roslings_prove.proofs.kills import KnownKill, kills_in, write_kills
from roslings_prove.proofs.record import ProofRecorder

EXAMPLE = lab("example")


# --- the operators -----------------------------------------------------------------------------


def made(operator: str, program: str, folder: Path) -> list[str]:
    """All that an operator makes of a program."""
    (folder / "it.py").write_text(program, "utf-8")
    source = read_source(folder, "it.py")
    change = OPERATORS[operator]
    return [source.with_new(node, new) for node in source.nodes() for new in change(node, source)]


LINES: dict[str, tuple[str, str, list[str]]] = {
    "a whole number": ("number", "n = 10", ["n = 11", "n = 9", "n = 20"]),
    "another number": (
        "number",
        "t = 0.5",
        ["t = 0.75", "t = 0.25", "t = 1.0", "t = 5.0", "t = 0.05"],
    ),
    "nothing": ("number", "t = 0.0", ["t = 1.0"]),
    "seconds": ("unit", "t = 2.0", ["t = 2000.0", "t = 200.0", "t = 0.002"]),
    "a number alone": ("unit", "depth = 10", []),
    "metres": ("unit", "d = 1  # m", ["d = 1000.0  # m", "d = 100.0  # m", "d = 0.001  # m"]),
    "an angle": ("unit", "a = math.atan2(y, x)", ["a = math.degrees(math.atan2(y, x))"]),
    "of an angle": ("unit", "x = math.cos(a)", ["x = math.cos(math.degrees(a))"]),
    "a quotient": ("unit", "d = a * b / c", ["d = a * b / c * 1000", "d = a * b / c * 100"]),
    "plus": ("sign", "a = b + c", ["a = b - c"]),
    "a sign": ("sign", "a = -b", ["a = b"]),
    "a number's sign": ("sign", "a = 3", ["a = -3"]),
    "counting": ("sign", "n += 1", ["n -= 1"]),
    "times": ("arithmetic", "a = b * c", ["a = b / c"]),
    "less": ("comparison", "a = b < c", ["a = b <= c", "a = b > c"]),
    "an interval": (
        "comparison",
        "a = 0 <= b < c",
        ["a = 0 < b < c", "a = 0 >= b < c", "a = 0 <= b <= c", "a = 0 <= b > c"],
    ),
    "none": ("comparison", "a = b is None", ["a = b is not None"]),
    "and": ("condition", "a = b and c", ["a = b or c"]),
    "yes": ("condition", "a = True", ["a = False"]),
    "not": ("condition", "a = not b", ["a = b"]),
    "a condition": ("condition", "a = 1 if b else 2", ["a = 1 if not b else 2"]),
    "a name": (
        "name",
        "a = 'chatter'",
        ["a = 'chatte'", "a = 'chatters'", "a = 'chatter_'", "a = 'chtater'", "a = 'Chatter'"],
    ),
    "an encoding": (
        "name",
        "a = b.decode('ascii')",
        [
            "a = b.decode('asci')",
            "a = b.decode('asciis')",
            "a = b.decode('ascii_')",
            "a = b.decode('acsii')",
        ],
    ),
    "no name": ("name", "a = 'Hello you'", []),
    "a text": (
        "text",
        "a = 'Hello you'",
        ["a = ''", "a = 'you'", "a = 'Hell you'", "a = 'Hello  you'", "a = 'hello you'"],
    ),
    "a text with a place": (
        "text",
        "a = f'I heard {b}'",
        [
            "a = 'I heard {b}'",
            "a = f'{b}'",
            "a = f'heard {b}'",
            "a = f'I herd {b}'",
            "a = f'I  heard {b}'",
            "a = f'i heard {b}'",
        ],
    ),
    "a statement": ("drop", "a = 1\nb()", ["b()", "a = 1"]),
    "one alone": ("drop", "if a:\n    b()", ["", "if a:\n    pass"]),
    "documentation": ("drop", '"""It."""\nimport a\n', []),
    "what does something": ("double", "a = b()\nc()", ["a = b()\nc()\nc()"]),
    "what is there already": (
        "double",
        "a.x = f(b)\na.close()\nrclpy.spin(n)\nself.p = self.create_client(T, 'a')",
        [],
    ),
    "what is seen from outside": (
        "double",
        "self.t = self.create_timer(1, f)",
        ["self.t = self.create_timer(1, f)\nself.t = self.create_timer(1, f)"],
    ),
    "the end of ROS": ("drop", "rclpy.try_shutdown()", []),
    "the depth of a queue": ("number", "self.create_publisher(T, 'a', 10)", []),
    "another depth": ("number", "self.create_subscription(T, 'a', f, 10, callback_group=g)", []),
    "two parts of one thing": ("too-early", "def f(m):\n    m.x = a\n    m.y = b\n", []),
    "what counts": ("double", "self.n += 1", ["self.n += 1\nself.n += 1"]),
    "what ROS does not run": ("drop", "if __name__ == '__main__':\n    main()", []),
}


@pytest.mark.parametrize(("operator", "program", "wrong"), LINES.values(), ids=LINES)
def test_what_an_operator_makes(
    operator: str, program: str, wrong: list[str], tmp_path: Path
) -> None:
    """All of it, and nothing else."""
    assert sorted(made(operator, program, tmp_path)) == sorted(wrong)


NODE = '''
class Talker(Node):
    def __init__(self):
        super().__init__('talker')  # the name
        self.count = 0

    def say(self):
        """Say it."""
        text = String()
        text.data = self.count
        self.publisher.publish(text)
'''


def bodies(operator: str, function: str, folder: Path) -> list[list[str]]:
    """What becomes of one function, line by line, without its documentation."""
    trees = (ast.parse(each) for each in made(operator, NODE, folder))
    found = [
        [ast.unparse(line) for line in node.body if "Say it" not in ast.unparse(line)]
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.name == function
    ]
    return [body for body in found if body != SAYS]


SAYS = ["text = String()", "text.data = self.count", "self.publisher.publish(text)"]
CALLS = "self.calls = getattr(self, 'calls', 0) + 1"


def test_a_function_that_ends_early(tmp_path: Path) -> None:
    """Before each statement but the last, or from some call on."""
    assert [body for body in bodies("early-return", "say", tmp_path)] == [
        ["return", *SAYS],
        [SAYS[0], "return", *SAYS[1:]],
        [CALLS, "if self.calls >= 3:\n    return", *SAYS],
    ]


def test_a_callback_that_blocks(tmp_path: Path) -> None:
    """A while, for ever, and for ever in one call."""
    assert bodies("blocks", "say", tmp_path) == [
        ["import time", "time.sleep(1.0)", *SAYS],
        ["import time", "time.sleep(1000.0)", *SAYS],
        ["import time", CALLS, "if self.calls == 3:\n    time.sleep(1000.0)", *SAYS],
    ]


def test_an_exception_in_some_call(tmp_path: Path) -> None:
    """The first one, or a later one; what is called once has no later one."""
    found = bodies("breaks", "say", tmp_path)
    assert [each[:-3] for each in found] == [
        ["raise RuntimeError('in call 1')"],
        *(
            [CALLS, f"if self.calls == {n}:\n    raise RuntimeError('in call {n}')"]
            for n in (2, 3, 5, 7, 10)
        ),
    ]
    assert sum("raise" in body[0] for body in bodies("breaks", "__init__", tmp_path)) == 1


def test_a_value_that_is_used_too_early(tmp_path: Path) -> None:
    """Before what it needs, however far away; or None at first."""
    assert bodies("too-early", "say", tmp_path) == [
        [SAYS[1], SAYS[0], SAYS[2]],
        [SAYS[2], SAYS[0], SAYS[1]],
        [SAYS[0], SAYS[2], SAYS[1]],
    ]
    begun = bodies("too-early", "__init__", tmp_path)
    assert ["self.count = 0", "super().__init__('talker')"] not in begun, "that is as good"
    assert ["super().__init__('talker')", "self.count = None"] in begun


def test_comments_and_layout_stay(tmp_path: Path) -> None:
    """The diff is the change alone."""
    (wrong,) = (each for each in made("name", NODE, tmp_path) if "'talke')" in each)
    assert wrong == NODE.replace("'talker'", "'talke'")


# --- the choice --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def packages() -> list[Generated]:
    """All of the example."""
    return generated(EXAMPLE)


def test_the_same_packages_each_time(packages: list[Generated]) -> None:
    """In the same order, with names of their own, whatever the order they are found in."""
    found = choice.candidates(EXAMPLE)
    assert [each.name for each in chosen(reversed(found))] == [each.name for each in chosen(found)]
    assert len({each.name for each in packages}) == len(packages)
    assert all("/" not in each.name for each in packages)


def test_each_is_another_program(packages: list[Generated]) -> None:
    """It compiles, and is neither the solution nor another one."""
    meanings = {(each.file, ast.dump(ast.parse(each.after))) for each in packages}
    solution = {(each.file, ast.dump(ast.parse(each.before))) for each in packages}
    assert len(meanings | solution) == len(packages) + len(solution)


def test_they_are_spread(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over operators: none has two more than another that has some left; and over lines."""
    monkeypatch.setattr(choice, "WANTED", 30)
    found = choice.candidates(EXAMPLE)
    taken, all_of = (Counter(each.operator for each in some) for some in (chosen(found), found))
    fewest = min(taken[name] for name in all_of if taken[name] < all_of[name])
    assert sum(taken.values()) == 30 and max(taken.values()) <= fewest + 1
    assert len({each.place for each in chosen(found)}) >= 10


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("actions", "command.angular.z = max"),  # the starter has all of `steer`
        ("serial-bridge", "throttle_duration_sec"),  # "No board yet": no card names that line
        ("serial-bridge", "The board is on"),
        ("pi-camera", "The camera is"),
    ],
)
def test_what_nobody_asks_for_is_left_alone(name: str, own: str) -> None:
    """What is given, and what a package writes of its own accord; the rest of the file is not."""
    found = choice.candidates(lab(name))
    touched = [
        each.name
        for each in found
        if any(line.startswith("-") and own in line for line in each.diff.splitlines())
    ]
    assert len(found) > 300 and touched == []


@pytest.mark.slow
def test_a_number_that_no_card_names_is_not_changed_a_little() -> None:
    """91 for 90 is as good a threshold; the card's own numbers, and small ones, are changed."""
    changed = "".join(e.diff for e in choice.candidates(lab("pi-camera")) if e.operator == "number")
    assert "-LEAST_SATURATION" not in changed and "-HUE_WINDOW" in changed
    assert "-        whole = IntegerRange(from_value=0, to_value=100, step=1)" in changed


@pytest.mark.slow
def test_what_is_for_people_asks_for_nothing() -> None:
    """Points, an example and a thing's name are no words of the contract; a request is one."""
    changed = "".join(
        each.diff for each in choice.candidates(lab("serial-bridge")) if each.operator == "number"
    )
    assert "-LARGEST_PWM = 255" not in changed  # only a sentence says it
    assert "-        too_fast = max(1.0" not in changed  # the points of a check are 1
    assert "-        self.baud = self.declare_parameter('baud', 115200).value" in changed


def test_what_the_starter_has_word_for_word_is_not_changed(tmp_path: Path) -> None:
    """It is given; the student does not write it."""
    own = replace(EXAMPLE, folder=tmp_path / "example")
    shutil.copytree(EXAMPLE.folder, own.folder)
    assert list(modules_of(own, own.solution)) == ["beacon/beacon.py"]
    shutil.copy(own.solution / "beacon" / "beacon.py", own.starter / "beacon" / "beacon.py")
    assert list(modules_of(own, own.solution)) == []


def test_a_package_is_the_solution_with_one_change(
    packages: list[Generated], tmp_path: Path
) -> None:
    """One file differs, and its diff says how."""
    package = GeneratedPackage(packages[0]).make(tmp_path)
    after = (package / EXAMPLE.card.package / packages[0].file).read_text("utf-8")
    lines = packages[0].changed.splitlines()
    assert all(line[1:] in after for line in lines if line.startswith("+"))
    assert packages[0].name in GeneratedPackage(packages[0]).name


# --- what came of them -------------------------------------------------------------------------


ENVIRONMENT = Environment(
    roslings="1",
    ros_distro="jazzy",
    rmw="rmw_fastrtps_cpp",
    python="3.11",
    platform="Linux",
    isolation="namespaces",
    clock="wall",
    seed=1,
)


def result(
    outcome: CheckOutcome = "fail", submission: str = "it", *others: CheckOutcome
) -> GradingResult:
    """A result with one check, or with some."""
    checks = tuple(
        CheckResult(id="rate", title="rate", outcome=each, points=0, max_points=100)
        for each in (outcome, *others)
    )
    verdict = Verdict(
        lab="example",
        package="beacon",
        outcome=outcome_of(checks),
        score=None,
        checks=checks,
        seconds=Timings(total=1.0),
        environment=ENVIRONMENT,
    )
    return GradingResult(
        submission=submission, digest="0", attempt=1, state="graded", verdict=verdict
    )


def test_only_a_failed_check_is_a_kill() -> None:
    """Not what nobody could tell, nor a grading that broke off."""
    assert fate_of(result("fail")) is Fate.KILLED
    assert fate_of(result("pass")) is Fate.SURVIVED
    assert fate_of(result("inconclusive")) is Fate.UNCLEAR
    assert fate_of(result("pass", "it", "inconclusive")) is Fate.UNCLEAR
    assert fate_of(result("fail", "it", "inconclusive")) is Fate.KILLED
    order = GradingOrder.model_construct(submission="it", digest="0", attempt=1)
    assert fate_of(broken(order, "no memory")) is Fate.UNCLEAR
    assert fate_of(None) is Fate.UNCLEAR


def explaining(folder: Path, *entries: str) -> Lab:
    """The example, with explanations of its generated packages."""
    own = replace(EXAMPLE, folder=folder / "example")
    shutil.copytree(EXAMPLE.folder, own.folder, dirs_exist_ok=True)
    (own.folder / FILE).write_text("".join(entries) or "[]", "utf-8")
    return own


def entry(package: Generated, why: str = "equivalent: It does the same.") -> str:
    """One explanation."""
    diff = "".join(f"    {line}\n" for line in package.changed.splitlines())
    return f"- package: {package.name}\n  diff: |\n{diff}  {why}\n"


def outcome(packages: list[Generated], own: Lab, survivors: int) -> GeneratedOutcome:
    """The first ones survive."""
    fates = {
        each: Fate.SURVIVED if number < survivors else Fate.KILLED
        for number, each in enumerate(packages)
    }
    return GeneratedOutcome("example", fates, explained(own, packages))


def test_an_explained_survivor_is_taken_out_of_the_rate(
    packages: list[Generated], tmp_path: Path
) -> None:
    """The raw rate stays beside it."""
    found = outcome(packages, explaining(tmp_path, entry(packages[0])), 2)
    assert found.kill_rate == (len(packages) - 2) / (len(packages) - 1)
    assert found.raw_rate == (len(packages) - 2) / len(packages)
    assert len(found.row) == len(HEAD) == 79
    lines = [each.line for each in told([found])]
    assert packages[1].name in lines[0] and packages[1].changed.splitlines()[0][:70] in lines[0]
    assert not any(packages[0].name in line for line in lines)


def wrong(found: GeneratedOutcome) -> list[str]:
    """What does not hold."""
    return [proof.line for proof in found.proofs() if not proof.holds]


def test_at_most_one_in_ten_is_explained(packages: list[Generated], tmp_path: Path) -> None:
    """More would be no proof; and what is caught needs none."""
    tenth = len(packages) // 10
    entries = [entry(each) for each in packages[: tenth + 1]]
    some = explaining(tmp_path, *entries[:-1])
    assert wrong(outcome(packages, some, tenth)) == []
    (caught,) = wrong(outcome(packages, some, tenth - 1))
    assert "it is caught" in caught
    (many,) = wrong(outcome(packages, explaining(tmp_path, *entries), tenth + 1))
    assert "close the holes" in many


def test_too_few_that_are_caught_is_no_proof(packages: list[Generated], tmp_path: Path) -> None:
    """And what is unclear leaves it open."""
    some = explaining(tmp_path)
    (few,) = wrong(outcome(packages, some, len(packages) // 10))
    assert few.startswith("WRONG") and "see the survivors" in few
    unclear = GeneratedOutcome("example", dict.fromkeys(packages, Fate.UNCLEAR), {})
    assert all(line.startswith("open") for line in wrong(unclear))


BAD: dict[str, tuple[str, str]] = {
    "no such package": ("package: x\n  diff: ''\n  equivalent: so", ":1: no generated package"),
    "no reason": ("package: x\n  diff: ''", ":1: 0: Value error, give one reason"),
    "two reasons": (
        "package: x\n  diff: ''\n  equivalent: a\n  not_judged: b",
        ":1: 0: Value error, give one",
    ),
    "another word": ("package: x\n  diff: ''\n  because: a", ":3: 0.because"),
}


@pytest.mark.parametrize(("words", "told"), BAD.values(), ids=BAD)
def test_a_bad_explanation_is_told_with_its_line(
    words: str, told: str, packages: list[Generated], tmp_path: Path
) -> None:
    """Before anything is graded."""
    with pytest.raises(BadCourseFile) as caught:
        explained(explaining(tmp_path, f"- {words}\n"), packages)
    assert told in str(caught.value)


def test_an_explanation_names_its_diff_and_a_line_of_the_card(
    packages: list[Generated], tmp_path: Path
) -> None:
    """So that it cannot speak of another change, nor of a promise that nobody made."""
    first, second = packages[:2]
    moved = entry(first).replace(first.name, second.name)
    with pytest.raises(BadCourseFile, match=r":1: the diff of .* is another one"):
        explained(explaining(tmp_path, moved), packages)
    with pytest.raises(BadCourseFile, match="no such line under not_judged"):
        explained(explaining(tmp_path, entry(first, "not_judged: the weather")), packages)


@pytest.mark.parametrize("one", all_labs(), ids=lambda one: one.name)
def test_the_file_of_each_lab_can_be_read(one: Lab) -> None:
    """One that has comments alone says that nothing is explained."""
    file = one.folder / FILE
    entries = read_yaml(file, Explanations).root if file.is_file() else ()
    assert len(entries) == len(read_tree(file) or ())


def test_students_do_not_get_what_is_explained() -> None:
    """A diff holds a line of the solution."""
    assert not is_for_students(f"labs/{EXAMPLE.name}/{FILE}")
    assert is_for_students(f"labs/{EXAMPLE.name}/card.yaml")


# --- what is kept ------------------------------------------------------------------------------


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """A course with the example as its lab, of which three packages are made."""
    for folder in ("labs", "graders"):
        shutil.copytree(example_root() / folder, tmp_path / folder)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    monkeypatch.setattr(choice, "WANTED", 3)
    return lab("example")


def test_what_judges_is_part_of_what_is_known(course: Lab) -> None:
    """The card and the grader; not what explains, nor what is graded."""
    before = judged_by(course)
    (course.folder / FILE).write_text("[]")
    (course.folder / "mutants" / "new.yaml").write_text("")
    assert judged_by(course) == before
    course.grader.write_text(course.grader.read_text("utf-8") + "\n")
    after = judged_by(course)
    (course.folder / "card.yaml").write_text("")
    assert len({before, after, judged_by(course)}) == 3


@pytest.mark.slow
def test_a_run_goes_on_where_it_was_ended(course: Lab, tmp_path: Path) -> None:
    """Two are known, one is graded, and nothing the next time. A kill's evidence is kept."""
    keeping = Keeping(tmp_path / "kept", tmp_path / "kills")
    keeping.folder.mkdir()
    known = [GeneratedPackage(each) for each in generated(course)[1:]]
    with gradebook(keeping.folder, running.BOOK) as book:
        for each in known:
            digest = digest_of(each.make(tmp_path / "made"))
            book.write(result("fail", each.name).model_copy(update={"digest": digest}))
    for before in (2, 3):
        seen: list[int] = []
        watcher = partial(_note, seen)
        lines = list(prove_generated([course], watcher, 1, keeping))
        assert seen[:1] == ([2] if before == 2 else [])
        assert any("3       3         0" in line.line for line in lines)
    course.grader.write_text(course.grader.read_text("utf-8") + "\n")
    looking = Keeping(keeping.folder, so_far=True)
    now = list(prove_generated([course], partial(_note, []), 1, looking))
    assert now[0].line.startswith("open   0 of 3 packages are graded")
    (kill,) = kills_in(tmp_path / "kills", course)
    assert kill.applies(course)
    with gradebook(keeping.folder, running.BOOK) as book:
        assert {each.attempt for each in book.latest().values()} == {1}


def _note(seen: list[int], now: BatchProgress) -> None:
    seen.append(now.done)


def test_two_commands_do_not_keep_in_one_place(course: Lab, tmp_path: Path) -> None:
    """The second says so."""
    with (
        alone_in(tmp_path / "kept", AlreadyProving),
        pytest.raises(AlreadyProving, match="--keep DIR"),
    ):
        next(prove_generated([course], lambda _: None, 1, Keeping(tmp_path / "kept")))


def test_large_evidence_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It would make the course large."""
    order = GradingOrder.model_construct(room=tmp_path)
    for size, stays in (
        (graded_process.SMALL_BYTES, True),
        (graded_process.SMALL_BYTES + 1, False),
    ):
        monkeypatch.setattr(
            grading, "main", lambda order, n=size: order.evidence.write_bytes(b"x" * n)
        )
        graded_process.main(order)
        assert order.evidence.exists() is stays


def _saw(size: int, order: GradingOrder) -> None:
    order.evidence.write_bytes(b"x" * size)


# --- known kills -------------------------------------------------------------------------------


def all_changes() -> Iterator[Generated]:
    """Some of labs with one file and with many, by all operators."""
    for own in (lab("topics"), lab("actions"), EXAMPLE):
        yield from generated(own)[:40]


def test_a_kill_is_made_of_the_solution_again(tmp_path: Path) -> None:
    """The edit that is kept of a change makes the same file, of lines that stand once."""
    for number, change in enumerate(all_changes()):
        kill = kill_of(change, "some")
        assert kill.applies(change.lab), change.name
        made = KnownKill(change.lab, kill).make(tmp_path / str(number))
        file = made / change.lab.card.package / change.file
        assert file.read_text("utf-8") == change.after, change.name


def test_a_kill_whose_line_is_gone_is_left_out_and_told(course: Lab, tmp_path: Path) -> None:
    """It is no package any more; the command that names others is told."""
    folder = Folder(tmp_path / "proofs")
    kills = [kill_of(each, "text") for each in generated(course)]
    write_kills(folder.path, course, kills)
    names = [kill.name for kill in kills]
    assert [name_in(course, each)[5:] for each in folder.packages(course)[-3:]] == names
    file = course.solution / kills[0].edit.file
    file.write_text(file.read_text("utf-8").replace(kills[0].edit.find, ""), "utf-8")
    assert names[0] not in str(folder.packages(course))
    (told,) = ProofRecorder(folder, measuring()).forget_dead_kills([course])
    assert "of its known kills fit the solution no longer, and go" in told.line
    assert f"prove {course.name} --generated --keep-kills" in told.line
    assert names[0] not in {kill.name for kill in kills_in(folder.path, course)}
