"""No pass rests on what was dropped; a fault that was seen in the rest stands."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from real_run import evidence_of_solution

from roslings.course import lab
from roslings.evidence import DroppedSeen, Evidence
from roslings.judge import judge
from roslings.verdict import Verdict

TOPICS = lab("topics")
Drop = Callable[[Evidence], None]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """What was seen of a real run of the solution."""
    return evidence_of_solution("topics", tmp_path_factory.mktemp("whole"))


def without(whole: Evidence, drop: Drop) -> Verdict:
    """The verdict where something of the evidence is dropped; read back as a file would be."""
    seen = whole.model_copy(deep=True)
    drop(seen)
    return judge(TOPICS, Evidence.model_validate_json(seen.model_dump_json(by_alias=True)))


def outcomes(verdict: Verdict) -> dict[str, str]:
    """Check to outcome, of those that neither passed nor wait for another."""
    found = {check.id: check.outcome for check in verdict.checks}
    return {name: outcome for name, outcome in found.items() if outcome not in ("pass", "skip")}


def last_messages(seen: Evidence) -> None:
    """What came on /chatter later."""
    seen.experiments["talking"].topics["/chatter"].not_kept = 7


def contents(seen: Evidence) -> None:
    """What one message says."""
    topic = seen.experiments["talking"].topics["/chatter"]
    topic.messages[1].content, topic.not_read = None, 1


def whole_topic(seen: Evidence) -> None:
    """The topic was one of many, and nobody listened to it."""
    talking = seen.experiments["talking"]
    del talking.topics["/chatter"]
    talking.dropped = [DroppedSeen(kind="topics", count=300)]


def endpoints(seen: Evidence) -> None:
    """A part of the graph."""
    seen.experiments["together"].dropped = [DroppedSeen(kind="graph", count=9)]


@pytest.mark.parametrize(
    ("drop", "unclear", "words"),
    [
        (last_messages, {"rate", "text", "counting", "talker_logs"}, "7 messages on /chatter"),
        (contents, {"text", "counting", "talker_logs"}, "1 message on /chatter holds"),
        (whole_topic, {"rate", "text", "counting", "talker_logs"}, "300 topics of 'talking'"),
        (endpoints, {"together"}, "9 names, publishers and subscriptions"),
    ],
)
def test_no_check_passes_that_rests_on_what_was_dropped(
    whole: Evidence, drop: Drop, unclear: set[str], words: str
) -> None:
    """It is inconclusive and names the drop; all others pass."""
    verdict = without(whole, drop)
    assert outcomes(verdict) == dict.fromkeys(unclear, "inconclusive")
    assert all(words in str(c.why) for c in verdict.checks if c.id in unclear)
    assert verdict.score is None
    assert all(check.points == 0 for check in verdict.checks if check.id in unclear)


def test_a_fault_that_was_seen_stands(whole: Evidence) -> None:
    """A wrong text in what was kept is wrong, whatever came after it."""

    def drop(seen: Evidence) -> None:
        last_messages(seen)
        seen.experiments["talking"].topics["/chatter"].messages[0].content = {"data": "no"}

    verdict = without(whole, drop)
    assert outcomes(verdict)["text"] == "fail"


def lost_lines(seen: Evidence) -> None:
    """Of the log and of the terminal, a part."""
    talking = seen.experiments["talking"]
    talking.dropped = [DroppedSeen(kind="rosout", count=4)]
    talking.processes["talker"].output_dropped_bytes = 5


def test_a_line_that_was_found_is_found(whole: Evidence) -> None:
    """Other lines may be missing: nobody asks for silence."""
    assert without(whole, lost_lines).score == 100


def test_a_line_that_is_not_found_may_be_a_dropped_one(whole: Evidence) -> None:
    """Then nobody can tell."""

    def drop(seen: Evidence) -> None:
        lost_lines(seen)
        talking = seen.experiments["talking"]
        talking.rosout, talking.processes["talker"].lines = {}, []

    verdict = without(whole, drop)
    assert outcomes(verdict) == {"talker_logs": "inconclusive"}
    why = next(str(check.why) for check in verdict.checks if check.id == "talker_logs")
    assert "5 bytes that talker wrote" in why
    assert "4 lines in /rosout" in why


def test_an_end_of_which_a_part_is_missing_is_not_clean(whole: Evidence) -> None:
    """A traceback may have been in it."""

    def drop(seen: Evidence) -> None:
        lost_lines(seen)
        seen.experiments["talking"].processes["talker"].ending_cut = True

    verdict = without(whole, drop)
    assert outcomes(verdict) == {"clean_exit": "inconclusive"}
    assert "5 bytes" in next(str(c.why) for c in verdict.checks if c.id == "clean_exit")


def test_evidence_from_before_is_read(whole: Evidence) -> None:
    """Nothing was said of drops then."""
    old = whole.model_dump(by_alias=True, mode="json")
    for seen in old["experiments"].values():
        del seen["dropped"]
        for topic in seen["topics"].values():
            del topic["not_read"], topic["cut_short"]
    assert judge(TOPICS, Evidence.model_validate(old)).score == 100
