"""What README's command leaves to CI is listed, has its stage there, and leaves no room empty."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from few import FIRST
from roslings.course import all_labs, root
from slow import LIST, ROW, folders_of_tests, is_slow_whole, slow_files

GATE = (root() / ".ci/run").read_text("utf-8")
STAGES = set(re.findall(r'^(?:stage|trial) "([^"$]+)"', GATE, re.MULTILINE))
OF_FOLDERS = {
    "tests/labs/": "By the wall's clock, and with nothing in them",
    "tests/rogues/": "The rogues",
}
WHOLE_MACHINE = "The tests that take the whole machine"
ROWS = [match.groupdict() for match in ROW.finditer(LIST.read_text("utf-8"))]
MARKED = {
    "all": "import pytest\n\npytestmark = [\n    pytest.mark.slow,\n]\n\ndef test_it(): pass\n",
    "some": "from few import few_labs\n\n\n@few_labs('lab')\ndef test_it(lab):\n    pass\n",
}


def test_the_list_has_each_file_with_slow_tests() -> None:
    """And no other; a row whose form is wrong is no row."""
    assert {row["file"]: row["how_many"] for row in ROWS} == dict(slow_files())
    assert len(ROWS) == LIST.read_text("utf-8").count("\n| `")


@pytest.mark.parametrize("how_many", MARKED)
def test_a_mark_of_each_form_is_seen(how_many: str, tmp_path: Path) -> None:
    """A file that is marked and not listed would be found."""
    for tests in ("tests", "packages/one/tests"):
        (tmp_path / tests).mkdir(parents=True)
        (tmp_path / tests / "test_it.py").write_text(MARKED[how_many], "utf-8")
        quick = "def test_it():\n    'pytest.mark.slow'\n"
        (tmp_path / tests / "test_quick.py").write_text(quick, "utf-8")
    found = dict(slow_files(tmp_path))
    assert found == dict.fromkeys(["packages/one/tests/test_it.py", "tests/test_it.py"], how_many)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["file"])
def test_each_has_its_stage(row: dict[str, str]) -> None:
    """One that there is; the tests of labs and the rogues have a stage of their own."""
    stages = {*row["stage"].split("; ")}
    assert stages <= STAGES
    own = {stage for folder, stage in OF_FOLDERS.items() if row["file"].startswith(folder)}
    assert stages & {*OF_FOLDERS.values()} == (set() if stages == {WHOLE_MACHINE} else own)


def test_the_stages_run_slow_tests() -> None:
    """Those of labs and the rogues in one each, all others in two."""
    runs = ('-m "$slow and not alone"', '-m "$slow and alone"', 'tests/labs -m "$slow"')
    for words in (*runs, 'tests/rogues -m "$slow and not alone"'):
        assert words in GATE
    assert "--ignore=tests/labs --ignore=tests/rogues" in GATE


def test_what_a_run_may_not_do_without_comes_before_what_it_may() -> None:
    """Too few rogues fail a run, and so does what is due; slow tests without time do not."""
    stages = re.findall(r'^(?:stage|trial) "([^"$]+)"', GATE, re.MULTILINE)
    needed = ["The proofs that are due", "The rogues", "The slow tests"]
    assert [stage for stage in stages if stage in needed] == needed


def test_no_room_is_left_without_a_test() -> None:
    """Who breaks a room hears it from README's command."""
    files = [file for tests in folders_of_tests() for file in tests.rglob("test_*.py")]
    quick = {file.parent for file in files if not is_slow_whole(file)}
    assert {file.parent for file in files} - quick == set()


def test_the_lab_that_stays_is_there() -> None:
    """Else every lab would be slow."""
    assert FIRST in {lab.name for lab in all_labs()}
