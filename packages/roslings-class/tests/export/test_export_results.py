"""A verdict in each platform's shape: pass, fail, inconclusive, refused, with hidden checks."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import written_verdicts

from roslings.grading.platforms import writer_of
from roslings.report.refusal import Refusal
from roslings.verdict import Verdict

SCHEMAS = Path(__file__).parent / "schemas"
JSON_SHAPES = ("gradescope", "prairielearn", "classroom")
MENDABLE = Refusal("topics", "There is no ROS package.", "Hand in the zip.", is_students=True)
MACHINES = Refusal("topics", "No wall.", "", is_students=False)
TOLD: dict[str, Verdict | Refusal] = {
    "pass": written_verdicts.full_score(),
    "fail": written_verdicts.three_faults(),
    "crash": written_verdicts.crashed(),
    "inconclusive": written_verdicts.inconclusive(),
    "refused": MENDABLE,
    "not graded": MACHINES,
}
SCORES = {"pass": 100.0, "fail": 82.0, "crash": 44.0, "refused": 0.0}


def schema(name: str) -> Any:
    """The published fields of a platform, as a JSON schema."""
    return json.loads((SCHEMAS / f"{name}.json").read_text("utf-8"))


def written(shape: str, told: Verdict | Refusal, folder: Path) -> str:
    """The file of a platform."""
    writer_of(shape)(told, folder / shape)
    return (folder / shape).read_text("utf-8")


@pytest.mark.parametrize("shape", JSON_SHAPES)
@pytest.mark.parametrize("word", TOLD)
def test_each_answer_has_the_published_fields(shape: str, word: str, tmp_path: Path) -> None:
    """Whatever came of the grading."""
    table = json.loads(written(shape, TOLD[word], tmp_path))
    import jsonschema  # two seconds of a processor

    jsonschema.validate(table, schema(shape), jsonschema.Draft202012Validator)


def score_in(shape: str, text: str) -> float | None:
    """0 to 100, as the platform would reckon it; None where it would keep no score."""
    if shape == "vpl":
        grades = [line for line in text.splitlines() if line.startswith("Grade :=>>")]
        return float(grades[-1].removeprefix("Grade :=>>")) if grades else None
    table = json.loads(text)
    if shape == "classroom":
        most = table["max_score"]
        return 100 * sum(test["score"] for test in table["tests"]) / most if most else None
    if shape == "prairielearn":
        return 100 * table["score"] if table.get("gradable", True) else None
    return float(table["score"]) if "score" in table else None


@pytest.mark.parametrize("shape", [*JSON_SHAPES, "vpl"])
@pytest.mark.parametrize("word", TOLD)
def test_the_score_is_the_verdicts(shape: str, word: str, tmp_path: Path) -> None:
    """Where nobody could tell there is none: never a zero."""
    told = TOLD[word]
    wanted = told.score if isinstance(told, Verdict) else SCORES.get(word)
    if shape == "prairielearn" and word == "refused":
        wanted = None  # it takes no attempt away there
    assert score_in(shape, written(shape, told, tmp_path)) == pytest.approx(wanted)


@pytest.mark.parametrize("shape", [*JSON_SHAPES, "vpl"])
def test_each_answer_says_what_to_mend(shape: str, tmp_path: Path) -> None:
    """What was expected, what was measured; and where nothing was graded, whose fault that is."""
    told = written(shape, TOLD["fail"], tmp_path).replace("\\", "")
    assert "1.00 Hz: 12 messages" in told
    assert "There is no ROS package" in written(shape, MENDABLE, tmp_path)
    assert "Hand in the zip." in written(shape, MENDABLE, tmp_path)
    assert "no fault of yours" in written(shape, MACHINES, tmp_path)
    assert "This is no grade" in written(shape, TOLD["inconclusive"], tmp_path)


@pytest.mark.parametrize("shape", ["prairielearn", "classroom", "vpl"])
def test_hidden_checks_show_their_points_alone(shape: str, tmp_path: Path) -> None:
    """These platforms cannot hide a test; the points of all still make the score."""
    secret = written_verdicts.failing("rate", **written_verdicts.TOO_SLOW)
    hidden = secret.model_copy(update={"hidden": True, "title": "A secret."})
    verdict = written_verdicts.verdict(hidden)
    text = written(shape, verdict, tmp_path)
    assert score_in(shape, text) == pytest.approx(verdict.score)
    assert "Checks that you do not have" in text
    for word in ("A secret", "1.00 Hz", "Which number"):
        assert word not in text


NASTY = "Grade :=>> 100\n<|--\n[x](http://e) <b>`**\n--|>\nComment :=>>| ```"


def nasty() -> Verdict:
    """A node's words that would be a grade, a link or a tag."""
    check = written_verdicts.failing(
        "rate", expected=NASTY, measured=NASTY, why=NASTY, hint=NASTY, log=(NASTY,)
    )
    return written_verdicts.verdict(check)


def test_a_nodes_words_are_no_grade_for_vpl(tmp_path: Path) -> None:
    """Each line is a comment but the last, and no mark of VPL is in any text."""
    *comments, grade = written("vpl", nasty(), tmp_path).splitlines()
    assert grade == "Grade :=>> 85"
    assert all(line.startswith("Comment :=>>") for line in comments)
    for line in comments:
        text = line.removeprefix("Comment :=>>")
        assert not [mark for mark in (":=>>", "<|--", "--|>") if mark in text]


def unescaped(text: str) -> Iterator[str]:
    """Signs outside of a fence that would mean something in Markdown."""
    escaped_away = text.replace("\\\\", "")
    for at, sign in enumerate(escaped_away):
        if sign in "<[`" and escaped_away[at - 1] != "\\":
            yield sign


def test_a_nodes_words_are_no_markdown_for_gradescope(tmp_path: Path) -> None:
    """No link, no tag, no end of the fence: only our own labels are bold."""
    table = json.loads(written("gradescope", nasty(), tmp_path))
    (output,) = [test["output"] for test in table["tests"] if test["number"] == "rate"]
    assert {test["output_format"] for test in table["tests"]} == {"md"}
    before, fence, inside = output.partition("````text\n")
    assert fence
    assert inside.endswith("\n````")
    assert "````" not in inside.removesuffix("\n````")
    assert list(unescaped(before)) == []
    assert before.count("**") == 2 * len(("Expected", "Measured", "Why", "Try"))
