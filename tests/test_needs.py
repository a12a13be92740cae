"""What a slow test needs is recorded as the kernel sees it, and the gate chooses by the record."""

from __future__ import annotations

import hashlib
import json
import lzma
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from needed.choice import (
    BY_TEST,
    CORE,
    PART_FOR_NAMES,
    PART_FOR_THE_CORE,
    PART_OF_KEPT,
    Choice,
    Core,
)
from needed.left_out import KEPT, UNDRAWN, LeftOut, drawn, read, write
from needed.opened import Opened, Watch, module_of
from needed.recorder import NoRecord, skipped_in
from needed.records import Record, Records, made_with, numbers, ranges
from needed.tree import (
    BYTES,
    ENTRY,
    MEANING,
    NAMES,
    NAMES_BUT_MODULES,
    NOTES_ONLY,
    Need,
    Tree,
)
from skips import skip_without

HERE = Path(__file__).parent
IT = "tests/test_it.py"

# --- a small clone, and a test in it that starts all kinds of processes ------------------------

TEST = '''
"""It reads nothing itself: each process that it starts reads one file."""

import subprocess
import sys


def run(*words):
    return subprocess.run(words, env={}, check=True, capture_output=True, text=True).stdout


assert "by a shell" in run("/bin/bash", "script.sh")
assert "alone" in run(sys.executable, "-I", "alone.py")
if "walled" in sys.argv:
    run("/usr/bin/env", "bwrap", "--ro-bind", "/", "/", "--bind", "walled", "/mnt", "--unshare-all",
        "--clearenv", "/bin/cat", "/mnt/seen.txt")
'''
PROJECT = """
[dependency-groups]
test = ["one", {include-group = "site"}]
site = ["two"]
[tool.pytest.ini_options]
addopts = "-n 4"
[tool.ruff]
line-length = 100
"""
FILES = {
    "pyproject.toml": PROJECT,
    "constraints.txt": "one==1  # test\ntwo==2  # test\n",
    IT: TEST,
    "script.sh": "cat by_bash.txt\n",
    "by_bash.txt": "by a shell\n",
    "alone.py": f"import sys\nsys.path.insert(0, {'lib'!r})\nimport told\nprint(told.WORD)\n",
    "lib/told.py": '"""What it says."""\n\nWORD = open("by_python.txt").read()  # a word\n',
    "lib/beside.py": "",
    "by_python.txt": "alone\n",
    "walled/seen.txt": "",
    "listed/one.txt": "",
    "unread.txt": "",
    "lib/unread.txt": "",
    ".gitignore": "__pycache__/\nmade.txt\n",
}


def git(folder: Path, *words: str) -> None:
    """In a repository of its own, whatever this one is."""
    subprocess.run(["git", "-C", str(folder), *words], check=True, capture_output=True)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A repository in which nothing was run yet, but for its bytecode."""
    folder = tmp_path / "clone"
    for name, text in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    git(tmp_path, "init", "-q", str(folder))
    git(folder, "add", ".")
    subprocess.run([sys.executable, "-m", "compileall", "-q", "lib"], cwd=folder, check=True)
    return folder


def recorded(clone: Path, *words: str) -> Record:
    """The record of its test."""
    tree = Tree(clone)
    with Watch(clone, tuple(tree.watched)) as watch:
        subprocess.run([sys.executable, IT, *words], cwd=clone, check=True)
        list((clone / "listed").iterdir())
    needs = tree.needs(IT, watch.opened())
    return Record(IT, made_with(), {}, {need: tree.digest(need) for need in needs})


NO_CORE = Core(frozenset(), "no core")


def choice(clone: Path, *records: Record, commit: str = "a", core: Core = NO_CORE) -> Choice:
    """What is done with these at a commit, on a machine that has all."""
    found = {record.file: record for record in records}
    return Choice(found, Tree(clone), lambda: core, commit, lambda name: "")


def others_named(clone: Path, record: Record) -> set[str]:
    """What is another than when it was recorded."""
    return {need.path for need in choice(clone, record).other_needs(record)}


def test_what_any_process_opens_is_seen(clone: Path) -> None:
    """A shell, what it starts, and a Python that no hook of a parent reaches."""
    paths = {need.path: need.kind for need in recorded(clone).needs}
    read_by_name = (IT, "script.sh", "by_bash.txt", "alone.py", "by_python.txt")
    assert [name for name in read_by_name if paths.get(name) != BYTES] == []
    assert (paths["lib/told.py"], paths["listed"]) == (MEANING, NAMES)
    assert not paths.keys() & {"unread.txt", "lib/unread.txt", "lib/beside.py", "walled/seen.txt"}


def test_what_is_opened_behind_a_wall_is_seen(clone: Path) -> None:
    """Mounted in another place, in namespaces of its own, with no environment."""
    skip_without("bubblewrap")
    assert "walled/seen.txt" in {need.path for need in recorded(clone, "walled").needs}


@pytest.mark.parametrize("name", ["by_bash.txt", "by_python.txt", "script.sh", "lib/told.py", IT])
def test_a_change_in_what_only_a_started_process_reads_is_found(name: str, clone: Path) -> None:
    """It runs, and says for what. One that nobody opened changes nothing."""
    record = recorded(clone)
    with (clone / "unread.txt").open("a") as file:
        file.write("another\n")
    assert others_named(clone, record) == set()
    with (clone / name).open("a") as file:
        file.write("\nanother = 1\n")
    assert others_named(clone, record) == {name}
    chosen = choice(clone, record)
    assert (chosen.left_out, chosen.why(IT)) == ({}, f"runs: another: {name}")


def test_a_change_behind_a_wall_is_found(clone: Path) -> None:
    """The same of what only a walled process reads."""
    skip_without("bubblewrap")
    record = recorded(clone, "walled")
    (clone / "walled/seen.txt").write_text("another\n")
    assert others_named(clone, record) == {"walled/seen.txt"}


def test_a_comment_counts_where_the_text_was_read(clone: Path) -> None:
    """A module that was only imported counts by what it does and says."""
    record = recorded(clone)
    told = clone / "lib/told.py"
    told.write_text(told.read_text("utf-8").replace("  # a word", "\n# two words\n"), "utf-8")
    assert others_named(clone, record) == set()
    told.write_text(told.read_text("utf-8").replace("What it says.", "Its word."), "utf-8")
    assert others_named(clone, record) == {"lib/told.py"}
    with (clone / "alone.py").open("a") as file:
        file.write("# read as text\n")
    assert others_named(clone, record) == {"lib/told.py", "alone.py"}


def test_a_file_more_or_less_counts_in_a_folder_that_was_listed(clone: Path) -> None:
    """Also one that is not yet added to git; none that git ignores."""
    record = recorded(clone)
    (clone / "listed/made.txt").touch()
    assert others_named(clone, record) == set()
    (clone / "listed/two.txt").touch()
    assert others_named(clone, record) == {"listed"}
    (clone / "listed/two.txt").unlink()
    (clone / "listed/one.txt").unlink()
    assert others_named(clone, record) == {"listed"}


def test_a_new_module_counts_where_somebody_opened_all_that_were_there(clone: Path) -> None:
    """Python lists a folder to find one module or package; who copies it opens all of it."""
    record = recorded(clone)
    assert Need("lib", NAMES_BUT_MODULES) in record.needs
    (clone / "lib/new.py").touch()
    (clone / "lib/package").mkdir()
    (clone / "lib/package/__init__.py").touch()
    assert others_named(clone, record) == set()
    (clone / "lib/pictures").mkdir()
    (clone / "lib/pictures/new.svg").touch()
    assert others_named(clone, record) == {"lib"}
    (clone / "lib/pictures/new.svg").unlink()
    (clone / "lib/new.txt").touch()
    assert others_named(clone, record) == {"lib"}
    tree = Tree(clone)
    all_of_it = frozenset({"lib/told.py", "lib/beside.py", "lib/new.py"})
    opened = Opened(all_of_it, frozenset(), frozenset({"lib"}), frozenset())
    assert Need("lib", NAMES) in set(tree.needs(IT, opened))


ONE_MORE = {
    "constraints.txt": ("one==1", "more==3  # desk\none==1"),
    "pyproject.toml": ('site = ["two"]', 'site = ["two", "more"]\ndesk = ["more"]'),
}
OTHERS = {
    "another version": ("constraints.txt", "one==1", "one==2", {"constraints.txt one==1"}),
    "no pin": ("constraints.txt", "two==2  # test", "", {"constraints.txt two==2"}),
    "another option of pytest": (
        "pyproject.toml",
        "-n 4",
        "-n 2",
        {"pyproject.toml tool.pytest.ini_options.addopts = '-n 4'"},
    ),
    "in no group any more": (
        "pyproject.toml",
        '"two"',
        "",
        {"pyproject.toml a group has 'two'", "pyproject.toml tests have 'two'"},
    ),
    "not with the tests any more": (
        "pyproject.toml",
        ', {include-group = "site"}',
        "",
        {"pyproject.toml tests have 'two'"},
    ),
}


def change(file: Path, old: str, new: str) -> None:
    """A part of a text that stands there."""
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), "utf-8")


def test_a_package_more_changes_nothing(clone: Path) -> None:
    """Nor do the groups behind a pin, or what only tools of authors read."""
    record = recorded(clone)
    for name, (old, new) in ONE_MORE.items():
        change(clone / name, old, new)
    change(clone / "constraints.txt", "# test", "# site test")
    change(clone / "pyproject.toml", "line-length = 100", "line-length = 90")
    assert others_named(clone, record) == set()


def test_a_package_that_moved_to_another_group_changes_nothing(clone: Path) -> None:
    """Nor does a group of another name: the same is installed."""
    record = recorded(clone)
    change(clone / "pyproject.toml", "site", "pages")
    change(clone / "pyproject.toml", 'site = ["two"]', 'pages = ["two"]')
    assert others_named(clone, record) == set()
    change(clone / "pyproject.toml", '["one", ', '["one", "two", ')
    change(clone / "pyproject.toml", 'pages = ["two"]', "pages = []")
    assert others_named(clone, record) == set()


@pytest.mark.parametrize("what", OTHERS)
def test_another_package_changes_all(what: str, clone: Path) -> None:
    """Another version, or none; another option of pytest."""
    record = recorded(clone)
    name, old, new, entries = OTHERS[what]
    change(clone / name, old, new)
    assert others_named(clone, record) == entries


def test_what_only_notes_what_came_of_a_test_is_no_need(clone: Path) -> None:
    """Else each word that is noted more would make all stale."""
    opened = Opened(NOTES_ONLY, NOTES_ONLY, frozenset(), frozenset())
    for file in NOTES_ONLY:
        (clone / file).parent.mkdir(parents=True, exist_ok=True)
        (clone / file).write_text("WORD = 1\n", "utf-8")
    tree = Tree(clone)
    assert tree.names >= NOTES_ONLY
    assert {need.path for need in tree.needs(IT, opened) if need.kind != ENTRY} == {IT}


def test_what_is_gone_is_another(clone: Path) -> None:
    """Also where nothing else tells of it."""
    record = recorded(clone)
    (clone / "by_bash.txt").unlink()
    assert "by_bash.txt" in others_named(clone, record)


def test_what_is_recorded_is_no_need(clone: Path) -> None:
    """Else each record would make those stale that copy the repository."""
    folder = clone / "tests/proofs/needs"
    Records(folder).write([recorded(clone)])
    assert [name for name in Tree(clone).names if "proofs" in name] == []


def test_a_file_that_was_changed_meanwhile_is_seen(clone: Path) -> None:
    """The digest of then cannot be told any more."""
    tree = Tree(clone)
    with Watch(clone, tuple(tree.watched)) as watch:
        (clone / "unread.txt").write_text("another")
        (clone / "listed/one.txt").rename(clone / "listed/two.txt")
    assert watch.opened().changed == {"unread.txt", "listed/one.txt", "listed/two.txt"}


@pytest.mark.parametrize(
    ("file", "module"),
    [
        ("src/a/__pycache__/b.cpython-312.pyc", "src/a/b.py"),
        ("__pycache__/b.cpython-39.opt-1.pyc", "b.py"),
        ("tests/__pycache__/test_b.cpython-311-pytest-9.1.1.pyc", "tests/test_b.py"),
        ("tests/b.pyc", None),
    ],
)
def test_bytecode_stands_for_its_module(file: str, module: str | None) -> None:
    """Whichever Python made it, and whoever rewrote it."""
    assert module_of(file) == module


# --- what is kept ------------------------------------------------------------------------------

A, B, C = Need("a.py", MEANING), Need("b c.txt", BYTES), Need("", NAMES)


def record_of(file: str, needs: Mapping[Need, str] | None = None) -> Record:
    """One that was made as this run would make it."""
    return Record(file, made_with(), {}, needs or {})


def test_what_was_written_is_read_again(tmp_path: Path) -> None:
    """Of the same need in two states, too; one that is recorded anew replaces its own."""
    one = replace(record_of("tests/test_1.py", {A: "1", B: "2", C: "-"}), skipped={"x[y]": "root"})
    two = record_of("tests/test_2.py", {A: "3", B: "2"})
    records = Records(tmp_path / "needs")
    assert records.read() == {}
    records.write([two, one])
    assert records.read() == {one.file: one, two.file: two}
    newer = record_of(two.file, {A: "1"})
    records.add(newer, there=[one.file])
    assert records.read() == {one.file: one, two.file: newer}
    records.add(newer, there=[])
    assert records.read() == {two.file: newer}


def test_records_are_packed(tmp_path: Path) -> None:
    """The digests of many files, of which each test file needs most; the same bytes each time."""
    digests = (hashlib.sha256(b"%d" % n).hexdigest()[:16] for n in range(1000))
    needs = {
        Need(f"packages/some/src/room/module_{n}.py", MEANING): d for n, d in enumerate(digests)
    }
    records = [record_of(f"tests/test_{n}.py", needs) for n in range(50)]
    folders = [tmp_path / "one", tmp_path / "other"]
    for folder, order in zip(folders, (records, records[::-1]), strict=True):
        Records(folder).write(order)
    one, other = ({f.name: f.read_bytes() for f in folder.iterdir()} for folder in folders)
    assert one == other and one.keys() == {"states.txt.xz", "records.jsonl.xz"}
    plain = {name: lzma.decompress(content).decode() for name, content in one.items()}
    first = plain["states.txt.xz"].splitlines()[0]
    assert first == f"{MEANING} {needs[Need(first.split(' ')[2], MEANING)]} {first.split(' ')[2]}"
    assert sum(map(len, one.values())) < sum(map(len, plain.values())) / 3


def test_runs_of_numbers_are_short() -> None:
    """And can be read again."""
    found = [0, 1, 2, 5, 7, 8]
    assert ranges(found) == "0-2 5 7-8"
    assert [*numbers(ranges(found))] == found and [*numbers(ranges([]))] == []


def came_of(folder: Path, *tests: tuple[str, str]) -> Path:
    """A file of costs with these outcomes and lacks."""
    file = folder / "costs"
    lines = ({"test": f"t{n}", "outcome": o, "lack": lack} for n, (o, lack) in enumerate(tests))
    file.write_text("".join(f"{json.dumps(line)}\n" for line in lines), "utf-8")
    return file


def test_what_was_skipped_for_the_machine_is_recorded_by_name(tmp_path: Path) -> None:
    """The others have passed: that is worth a record."""
    assert skipped_in(came_of(tmp_path, ("passed", ""), ("skipped", "root"))) == {"t1": "root"}


@pytest.mark.parametrize(
    "tests",
    [
        (),
        (("skipped", "root"),),
        (("passed", ""), ("skipped", "time for slow tests")),
    ],
)
def test_what_did_not_run_gets_no_record(
    tests: tuple[tuple[str, str], ...], tmp_path: Path
) -> None:
    """None at all, all skipped, or time was over for some."""
    with pytest.raises(NoRecord):
        skipped_in(came_of(tmp_path, *tests))


# --- the rules ---------------------------------------------------------------------------------


def same(clone: Path, number: int = 60) -> list[Record]:
    """Records of so many test files, with all that they need as it is."""
    tree = Tree(clone)
    needs = {Need(name, BYTES): tree.digest(Need(name, BYTES)) for name in ("script.sh", IT)}
    return [record_of(f"tests/test_{n}.py", needs) for n in range(number)]


def runs(chosen: Choice) -> set[str]:
    """The files that are not left out."""
    return chosen.records.keys() - chosen.left_out.keys()


def test_a_sixth_runs_all_the_same_and_over_time_all_do(clone: Path) -> None:
    """The commit draws it: the same one the same files, and another one others."""
    records = same(clone)
    ran = [runs(choice(clone, *records, commit=f"commit {number}")) for number in range(60)]
    assert {len(files) for files in ran} == {len(records) / PART_OF_KEPT}
    assert set.union(*ran) == {record.file for record in records}
    assert len(set(map(frozenset, ran))) > 50
    assert ran[0] == runs(choice(clone, *records, commit="commit 0"))
    assert max(Counter(file for files in ran for file in files).values()) < len(ran) / 2


def test_one_that_is_another_runs_whatever_the_lot(clone: Path) -> None:
    """And a file without a record is in no list of what is left out."""
    changed = replace(same(clone)[0], needs={Need(IT, BYTES): "another"})
    for number in range(20):
        chosen = choice(clone, changed, *same(clone)[1:], commit=str(number))
        assert changed.file in runs(chosen)
        assert chosen.why("tests/test_new.py") == "runs: it has no record"


def in_the_core(clone: Path, digest: str) -> Choice:
    """Of all files only a module of the core is another."""
    needs = {Need("lib/told.py", MEANING): "before"}
    records = [record_of(f"tests/test_{number}.py", needs) for number in range(60)]
    return choice(clone, *records, core=Core(frozenset({"lib/told.py"}), digest))


def test_where_only_the_core_is_another_a_third_runs(clone: Path) -> None:
    """Each state of the core has another third; what is left out is not told as proven."""
    chosen = [in_the_core(clone, f"state {number}") for number in range(20)]
    assert {len(runs(each)) for each in chosen} == {60 / PART_FOR_THE_CORE}
    assert set.union(*map(runs, chosen)) == chosen[0].records.keys()
    assert {left.outcome for left in chosen[0].left_out.values()} == {UNDRAWN}
    assert {each.rule for each in chosen[0].standings.values()} == {CORE}


def test_where_only_files_were_added_a_third_runs(clone: Path) -> None:
    """The commit draws it. A folder that is gone is for certain, and so is another file."""
    listed, told = Need("listed", NAMES), Need("lib/told.py", MEANING)
    needs = {listed: Tree(clone).digest(listed), told: Tree(clone).digest(told)}
    records = [record_of(f"tests/test_{number}.py", needs) for number in range(60)]
    (clone / "listed/new.txt").touch()
    chosen = [choice(clone, *records, commit=f"commit {number}") for number in range(20)]
    assert {len(runs(each)) for each in chosen} == {60 / PART_FOR_NAMES}
    assert set.union(*map(runs, chosen)) == chosen[0].records.keys()
    assert {left.outcome for left in chosen[0].left_out.values()} == {UNDRAWN}
    (clone / "lib/told.py").write_text("WORD = 1\n", "utf-8")
    assert choice(clone, *records).left_out == {}
    gone = [record_of(each.file, {Need("no_folder", NAMES): "before"}) for each in records]
    assert choice(clone, *gone).left_out == {}


def test_the_core_and_something_else_is_for_certain(clone: Path) -> None:
    """A test file's own text, above all; and a folder of the core is no module of it."""
    core = Core(frozenset({"lib/told.py", "lib"}), "state")
    told, own, lib = Need("lib/told.py", MEANING), Need(IT, BYTES), Need("lib", NAMES)
    for needs in ({told: "before", own: "before"}, {told: "before", lib: "before"}):
        records = [record_of(f"tests/test_{number}.py", needs) for number in range(12)]
        assert choice(clone, *records, core=core).left_out == {}


def test_rogues_are_drawn_one_by_one(clone: Path) -> None:
    """Some of them run at each landing, and each comes."""
    needs = same(clone)[0].needs
    chosen = [
        choice(clone, *(record_of(file, needs) for file in BY_TEST), commit=f"commit {number}")
        for number in range(60)
    ]
    tests = [f"test[{number}]" for number in range(90)]
    for file in BY_TEST:
        assert (HERE.parent / file).is_file()
        of_each = [each.left_out[file].drawn(tests) for each in chosen]
        assert {len(found) for found in of_each} == {len(tests) / PART_OF_KEPT}
        assert set.union(*of_each) == set(tests)


def test_another_python_or_more_of_a_machine_runs_it(clone: Path) -> None:
    """What was never tried here is not proven."""
    elsewhere = replace(same(clone)[0], made_with="Python 3.99, ROS from pip")
    assert choice(clone, elsewhere).left_out == {}
    without = [replace(each, skipped={"a test": "/dev/net/tun"}) for each in same(clone)]
    has_all = choice(clone, *without)
    assert has_all.left_out == {}
    assert has_all.why(without[0].file) == "runs: it was recorded without /dev/net/tun"
    lacks_too = replace_lack(has_all, "it is not here")
    assert len(lacks_too.left_out) == 50
    assert {each.skipped for each in lacks_too.left_out.values()} == {("a test",)}


def replace_lack(chosen: Choice, why: str) -> Choice:
    """The same on a machine that has nothing."""
    return Choice(chosen.records, chosen.tree, chosen.core_now, chosen.commit, lambda name: why)


def test_a_lot_falls_on_one_at_least() -> None:
    """Of few, too; of none on none."""
    assert [len(drawn("abcdefg"[:n], "a", 6)) for n in (0, 1, 6, 7)] == [0, 1, 1, 2]


# --- pytest leaves them out --------------------------------------------------------------------

SUITE = """
import pytest

def test_quick():
    pass

@pytest.mark.slow
@pytest.mark.parametrize("number", range(12))
def test_slow(number):
    pass

@pytest.mark.slow
@pytest.mark.twice
def test_twice():
    pass
"""
HOOKED = """
from costs import add_costs_option, note_costs
from needed.plugin import add_needed_option, leave_out

def pytest_addoption(parser):
    add_costs_option(parser)
    add_needed_option(parser)

def pytest_configure(config):
    for name in ("slow", "twice"):
        config.addinivalue_line("markers", name)
    note_costs(config)
    leave_out(config)
"""


def run_suite(folder: Path, left_out: LeftOut, *words: str) -> tuple[Counter[str], str, int]:
    """Outcome to how many tests had it, by the file of costs; what pytest says; its status."""
    (folder / "test_suite.py").write_text(SUITE, "utf-8")
    (folder / "conftest.py").write_text(HOOKED, "utf-8")
    write(folder / "needed", [left_out])
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-c",
        os.devnull,
        f"--rootdir={folder}",
        "-p",
        "xdist",
        "-p",
        "no:cacheprovider",
        f"--costs={folder / 'costs'}",
        f"--needed={folder / 'needed'}",
        *words,
        str(folder),
    ]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(HERE), *sys.path]),
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    }
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    lines = map(json.loads, (folder / "costs").read_text("utf-8").splitlines())
    return Counter(line["outcome"] for line in lines), done.stdout, done.returncode


@pytest.mark.slow
@pytest.mark.parametrize("processes", ["0", "2"])
def test_only_what_a_record_speaks_of_is_left_out(processes: str, tmp_path: Path) -> None:
    """Slow ones that the gate asks for; each is counted once, and told."""
    found, said, status = run_suite(tmp_path, LeftOut("test_suite.py", KEPT), "-n", processes)
    assert (status, found) == (0, {"passed": 2, KEPT: 12})
    assert "Left out: 12 tests were run before with all that they need as it is." in said


@pytest.mark.slow
@pytest.mark.parametrize("processes", ["0", "2"])
def test_a_run_of_which_all_was_left_out_has_passed(processes: str, tmp_path: Path) -> None:
    """pytest alone would call it a run without tests, which fails the gate's stage."""
    left = LeftOut("test_suite.py", UNDRAWN)
    words = ("-m", "slow and not twice", "-n", processes)
    found, said, status = run_suite(tmp_path, left, *words)
    assert (status, found) == (0, {UNDRAWN: 12})
    assert "Left out: 12 tests not drawn" in said


@pytest.mark.slow
def test_a_part_by_lot_runs_and_what_was_skipped_before_does(tmp_path: Path) -> None:
    """Every worker draws alike, or pytest would refuse the run."""
    skipped = tuple(f"test_suite.py::test_slow[{number}]" for number in range(12))[:3]
    left = LeftOut("test_suite.py", KEPT, part=6, seed="a", skipped=skipped)
    names = {f"test_suite.py::test_slow[{number}]" for number in range(12)}
    here = {*left.drawn(names), *skipped}
    found, _, status = run_suite(tmp_path, left, "-m", "slow and not twice", "-n", "2")
    assert (status, found) == (0, {"passed": len(here), KEPT: 12 - len(here)})


def test_without_a_choice_all_runs(tmp_path: Path) -> None:
    """A gate whose choice failed must not leave anything out."""
    assert read(tmp_path / "nothing") == {}
