"""A verdict as JSON: the published schema, the way there and back, nothing half written."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import written_verdicts as written

from roslings.report.json_file import BadVerdictFile, read_json, write_json
from roslings.report.schema import SCHEMA_FILE, schema_text, verdict_schema
from roslings.report.whole_file import CannotWriteFile
from roslings.verdict import SCHEMA_VERSION, Verdict
from skips import imported

VERDICTS = [
    written.full_score(),
    written.crashed(),
    written.three_faults(),
    written.inconclusive(),
]


def test_the_published_schema_is_the_models() -> None:
    """Who changes the model publishes its schema anew."""
    assert SCHEMA_FILE.read_text("utf-8") == schema_text(), (
        "verdict.schema.json is not what verdict.py says."
        " Make it anew: python -m roslings.report.schema"
    )


def test_the_schema_names_its_version() -> None:
    """A reader finds the version in the schema and in the file."""
    schema = verdict_schema()
    assert schema["$id"] == f"urn:roslings:verdict:{SCHEMA_VERSION}"
    assert schema["properties"]["schema"]["const"] == SCHEMA_VERSION


@pytest.mark.parametrize("verdict", VERDICTS)
def test_what_is_written_is_what_the_schema_says(verdict: Verdict, tmp_path: Path) -> None:
    """A validator that knows nothing of pydantic agrees, and refuses a damaged file."""
    jsonschema = imported("jsonschema")
    validator = jsonschema.Draft202012Validator(json.loads(SCHEMA_FILE.read_text("utf-8")))
    write_json(verdict, tmp_path / "verdict.json")
    found = json.loads((tmp_path / "verdict.json").read_text("utf-8"))
    validator.validate(found)
    assert not validator.is_valid({**found, "outcome": "perhaps"})
    assert not validator.is_valid({key: found[key] for key in found if key != "score"})


@pytest.mark.parametrize("verdict", VERDICTS)
def test_there_and_back(verdict: Verdict, tmp_path: Path) -> None:
    """Nothing is lost, and the top level has the names of the contract."""
    path = tmp_path / "mit Leerzeichen und ü.json"
    write_json(verdict, path)
    assert read_json(path) == verdict
    found = json.loads(path.read_text("utf-8"))
    assert {"schema", "lab", "outcome", "score", "checks", "seconds", "environment"} <= set(found)
    assert found["schema"] == 1
    assert found["score"] == verdict.score


def test_bytes_that_were_no_text_do_not_stop_it(tmp_path: Path) -> None:
    """A node may print anything; the file stays UTF-8 that every reader takes."""
    verdict = written.verdict(written.failing("text", log=("caf\udce9", "\ud800", "é 界")))
    write_json(verdict, tmp_path / "verdict.json")
    log = read_json(tmp_path / "verdict.json").failed()[0].log
    assert log == ("caf\ufffd", "\ufffd", "é 界")


def test_dash_is_standard_output_and_utf_8() -> None:
    """Also where the terminal is not."""
    code = (
        "import sys; from pathlib import Path; import written_verdicts as w;"
        "from roslings.report.json_file import write_json;"
        "write_json(w.verdict(w.failing('text', measured='ü')), Path('-'))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={
            **os.environ,
            "PYTHONIOENCODING": "ascii",
            "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path]),
        },
        capture_output=True,
        check=True,
    )
    assert Verdict.model_validate_json(done.stdout).failed()[0].measured == "ü"
    assert not done.stderr


def test_an_old_file_is_replaced_whole_and_nothing_stays_beside_it(tmp_path: Path) -> None:
    """A link stays a link; what it points to is new."""
    real, link = tmp_path / "real.json", tmp_path / "link.json"
    real.write_text("old" * 100_000, "utf-8")
    link.symlink_to(real)
    write_json(written.full_score(), link)
    assert link.is_symlink()
    assert read_json(real) == written.full_score()
    assert {path.name for path in tmp_path.iterdir()} == {"real.json", "link.json"}


def test_a_failed_write_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C in the middle: the old verdict is still there, and no part of the new one."""
    path = tmp_path / "verdict.json"
    write_json(written.full_score(), path)

    def interrupted(self: Path, target: Path) -> Path:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_json(written.crashed(), path)
    assert read_json(path) == written.full_score()
    assert [entry.name for entry in tmp_path.iterdir()] == ["verdict.json"]


def test_a_full_disk_is_one_clear_line() -> None:
    """/dev/full is a disk with no room; it is not replaced by a file either."""
    with pytest.raises(
        CannotWriteFile, match=r"Cannot write /dev/full: No space left .* Free some"
    ):
        write_json(written.full_score(), Path("/dev/full"))
    assert Path("/dev/full").is_char_device()


def test_a_device_is_written_to_and_not_replaced() -> None:
    """As root a rename would put a file where /dev/null was."""
    write_json(written.full_score(), Path("/dev/null"))
    assert Path("/dev/null").is_char_device()


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("no/such/folder/verdict.json", "Make the folder first: mkdir -p"),
        (".", "this is a folder"),
        ("a file/verdict.json", "Not a directory"),
    ],
)
def test_a_place_that_cannot_be_written(place: str, words: str, tmp_path: Path) -> None:
    """Each says what to do."""
    (tmp_path / "a file").touch()
    with pytest.raises(CannotWriteFile, match=words):
        write_json(written.full_score(), tmp_path / place)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "Invalid JSON"),
        (b"\xff\xfe", "Invalid JSON"),
        (b"[]", "the file"),
        (b'{"schema": 2}', "schema"),
    ],
)
def test_a_file_that_is_no_verdict(content: bytes, words: str, tmp_path: Path) -> None:
    """It says what is wrong with it and how to make one."""
    path = tmp_path / "other.json"
    path.write_bytes(content)
    with pytest.raises(BadVerdictFile, match=words) as caught:
        read_json(path)
    assert "./roslings check LAB --json FILE" in str(caught.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    """One clear line."""
    with pytest.raises(BadVerdictFile, match="Cannot read"):
        read_json(tmp_path / "none.json")
