"""Each promise has a test that runs, and each name that a stand-in offers is promised something."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

import pytest
from promise_list import BadList, Listed, read
from terminal import HERE

from ros2_on_pip.launching import jazzy, node, processes, provided
from sources import code_of

sys.path.append(str(code_of("ros2_on_pip") / "stand_ins"))

import rosbag2_py

LISTS = {file.stem: read(file) for file in sorted(Path(__file__).parent.glob("*.yaml"))}
PROMISES = [promise for one in LISTS.values() for promise in one.promises]

GOOD = """\
places:
  reader: {repository: ros2/rosbag2, commit: 0ca490edd5a9de8623459ca9246fe1d713bf78ab, path: a.pyi}
promises:
  it-ends:
    promise: It ends.
    covers: [End]
    source: {place: reader, name: End}
    test: test_a.py::test_it
left_out:
  Other: Nobody needs it.
differs:
  words: They are ours.
"""


def public_names(module: ModuleType) -> set[str]:
    """What a package offers, with the methods that its classes have of their own."""
    found = set(module.__all__)
    for name in module.__all__:
        value = getattr(module, name)
        if inspect.isclass(value):
            methods = (k for k, v in vars(value).items() if inspect.isfunction(v))
            found |= {f"{name}.{method}" for method in methods if not method.startswith("_")}
    return found


def names_of_launch() -> set[str]:
    """What each package exports, with the keywords of what starts a process."""
    modules = {name: provided.modules().get(name, {}) for name in jazzy.PACKAGES}
    found = {f"{module}.{name}" for module, names in modules.items() for name in names}
    for module, cls in (("launch", processes.ExecuteProcess), ("launch_ros", node.Node)):
        parameters = inspect.signature(cls).parameters.values()
        keywords = (each.name for each in parameters if each.kind is each.KEYWORD_ONLY)
        found |= {f"{module}.actions.{cls.__name__}.{name}" for name in keywords}
    return found


OFFERED = {"rosbag2_py": lambda: public_names(rosbag2_py), "launch": names_of_launch}
"""List to the public names of the stand-in that it is about."""


def collected(files: Iterable[str]) -> set[str]:
    """Every test that pytest finds in `files` and no mark keeps back, with and without its case."""
    runs = "not skip and not skipif and not xfail"
    words = ["--collect-only", "-q", "-n", "0", "-p", "no:cacheprovider", "-m", runs]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *words, *(str(HERE / file) for file in files)],
        text=True,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.findall(r"^\S*?tests/(\S+\.py::.+)$", done.stdout, re.MULTILINE)
    return {*found, *(test.partition("[")[0] for test in found)}


def test_each_promise_has_a_test_that_runs() -> None:
    """By its file, its name and, where there is one, its case."""
    named = {promise.test for promise in PROMISES}
    files = sorted({test.partition("::")[0] for test in named})
    assert named - collected(files) == set()


@pytest.mark.parametrize("name", LISTS)
def test_each_public_name_is_promised_something(name: str) -> None:
    """Or is left out with a reason, and never both; and no list has a name that is not there."""
    listed: Listed = LISTS[name]
    left_out = set(listed.left_out)
    assert OFFERED[name]() - listed.covered - left_out == set()
    assert (listed.covered | left_out) - OFFERED[name]() == set()
    assert listed.covered & left_out == set()


def test_each_stand_in_has_its_list() -> None:
    """And no list is about something else."""
    assert set(LISTS) == set(OFFERED)


def test_no_promise_stands_in_two_lists() -> None:
    """Neither its name nor its sentence; within one, the reader says so."""
    for said in ("name", "promise"):
        found = [getattr(promise, said).casefold() for promise in PROMISES]
        assert sorted(set(found)) == sorted(found)


def test_a_list_is_read(tmp_path: Path) -> None:
    """With the place of a source written once for all."""
    file = tmp_path / "a.yaml"
    file.write_text(GOOD)
    (promise,) = read(file).promises
    assert (promise.source.path, promise.source.name) == ("a.pyi", "End")
    assert read(file).left_out == {"Other": "Nobody needs it."}


FAULTS = [
    ("    covers: [End]\n", "", 5, "'covers' is missing"),
    ("covers:", "cover:", 5, "'cover' is not known here. Did you mean covers?"),
    ("[End]", "End", 5, "'covers' must be a list of names"),
    ("[End]", "[End, End]", 5, "'covers' has a name twice"),
    ("It ends.", "[It]", 5, "'promise' must be a text"),
    ("place: reader", "place: redaer", 7, "there is no place 'redaer'. Did you mean reader?"),
    ("test_a.py::test_it", "test_a.py", 5, "'test' is not of its form: test_a.py"),
    ("0ca490ed", "0ca490e", 2, "'commit' is not of its form"),
    ("ros2/rosbag2", "rosbag2", 2, "'repository' is not of its form"),
    (", path: a.pyi", "", 2, "'path' is missing"),
    ("differs:\n", "differ:\n", 1, "'differ' is not known here. Did you mean differs?"),
    ("Nobody needs it.", "[]", 10, "'Other' must be a text"),
    ("  it-ends:\n", "  it-ends: 1\n  it-ends:\n", 5, "'it-ends' stands here twice"),
    ("[End]", "[End", 7, "no valid YAML"),
]


@pytest.mark.parametrize(("old", "new", "line", "reason"), FAULTS)
def test_what_is_wrong_is_told_with_its_line(
    tmp_path: Path, old: str, new: str, line: int, reason: str
) -> None:
    """The file, the line, the mistake."""
    assert old in GOOD
    file = tmp_path / "a.yaml"
    file.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(BadList, match=re.escape(f"a.yaml, line {line}: ")) as told:
        read(file)
    assert reason in str(told.value)


def test_the_same_twice_and_a_place_for_nothing_are_refused(tmp_path: Path) -> None:
    """Also where the names differ."""
    file = tmp_path / "a.yaml"
    first = GOOD[GOOD.index("  it-ends") : GOOD.index("left_out")]
    file.write_text(GOOD.replace("left_out", first.replace("it-ends", "it-stops") + "left_out", 1))
    with pytest.raises(BadList, match=r"line 10: 'it-ends' promises the same"):
        read(file)
    place = "  writer: {repository: a/b, commit: " + "0" * 40 + ", path: b.pyi}\n"
    file.write_text(GOOD.replace("promises:", place + "promises:", 1))
    with pytest.raises(BadList, match=r"line 3: no promise has its source in 'writer'"):
        read(file)
