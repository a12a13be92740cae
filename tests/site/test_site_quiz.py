"""Quizzes, review and the end of a day, answered in a real browser."""

from __future__ import annotations

import json
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import pytest
from two_days_site import Visit

from roslings_learn.lessons import read_lessons
from roslings_learn.lessons.quiz import ChoiceQuestion
from roslings_learn.lessons.quiz_text import as_text, without_links
from roslings_learn.notebook.quiz_widgets import drawn

pytestmark = pytest.mark.slow

QUIZ_1, QUIZ_3 = "days/01-install/quiz.html", "days/03-topics/quiz.html"
RIGHT, WRONG = "Nothing", "All of it"
"""Of the question about one terminal."""
MASTER, LTS = "It needs no master", "It is supported until May 2029"
SYSTEM = "It is an operating system"
DAYS_UNTIL_LEARNT = (1, 3, 7, 14, 30)


def question(page: Any, name: str) -> Any:
    """The form of a question."""
    return page.locator(f"#q-{name}")


def choose(form: Any, *texts: str) -> str:
    """Choose answers by their texts, check them; returns what the form says."""
    for box in form.locator("input[type=checkbox]").all():
        box.uncheck()
    for text in texts:
        form.get_by_label(text, exact=True).check()
    form.get_by_role("button", name="Check", exact=True).click()
    return str(form.locator(".outcome").inner_text())


def stored(page: Any) -> Any:
    """What the browser keeps."""
    return page.evaluate("roslings.read()")


def test_one_of_several_choices(visit: Visit) -> None:
    """Feedback for the choice made; all of them once it is right."""
    form = question(visit.go(QUIZ_1), "install-one-terminal")
    assert "Answer first" in choose(form)
    assert "Not yet" in choose(form, WRONG)
    assert form.locator(".why:visible").all_inner_texts() == [
        "Not right: Each terminal has variables of its own."
    ]
    assert "Right" in choose(form, RIGHT)
    assert form.locator(".why:visible").count() == 3


def test_all_places_show_the_choices_in_one_order(visit: Visit, site: Path) -> None:
    """Page, key, page of answers (which is printed), review, Anki, and the notebook's two forms."""
    quiz = read_lessons(site.parents[1]).quiz("01-install")
    assert quiz
    asked = [each for each in quiz.questions if isinstance(each, ChoiceQuestion)]
    texts = [[without_links(choice.text) for choice in each.choices] for each in asked]
    right = [[n for n, choice in enumerate(each.choices) if choice.right] for each in asked]
    assert [choice.right for choice in asked[0].choices] != [True, False, False]  # as it is written
    for address in (QUIZ_1, "review.html"):
        page = visit.go(address)
        labels = [question(page, each.id).locator(".choices label") for each in asked]
        assert [found.all_text_contents() for found in labels] == texts
        keys = page.evaluate("roslings.keys")
        assert [keys[each.id]["right"] for each in asked] == right
        whys = [keys[each.id]["why"] for each in asked]
        assert whys == [[choice.why for choice in each.choices] for each in asked]
    cards = [page.evaluate(f"roslings.keys['{each.id}']") for each in asked]
    sections = visit.go("days/01-install/answers.html").locator("section section")
    answers = [sections.nth(n).locator("li") for n, _ in enumerate(asked)]
    printed, drawn_there = as_text(quiz), drawn(quiz).children
    for place, each in enumerate(asked):
        found = answers[place].all_text_contents()
        assert len(found) == len(texts[place])
        for number, (text, choice) in enumerate(zip(texts[place], each.choices, strict=True)):
            assert found[number].startswith(f"{'Right' if choice.right else 'Not right'}: {text}")
            assert f"   {ascii_lowercase[number]}) {text}" in printed
        for side in ("front", "back"):
            places = [cards[place][side].index(f"{text[:8]}") for text in texts[place]]
            assert places == sorted(places)
    one, several = (drawn_there[n].children for n in (0, 1))
    assert [option[0] for option in one[1].options] == texts[0]
    assert [box.description for box in several[1:4]] == texts[1]


def test_several_right_answers(visit: Visit) -> None:
    """All right ones and no other."""
    form = question(visit.go(QUIZ_1), "install-which-are-true")
    assert form.locator("input[type=checkbox]").count() == 3
    assert "more" in choose(form, MASTER)
    assert "Not yet" in choose(form, MASTER, SYSTEM, LTS)
    assert "Right" in choose(form, MASTER, LTS)


def test_an_order_by_keyboard(visit: Visit) -> None:
    """Buttons move a step, keep the focus, and say where it is."""
    page = visit.go(QUIZ_1)
    form = question(page, "install-what-first")
    right = ["Open the terminal", "Source ROS", "Run the talker"]
    steps = form.locator(".steps > li > span:first-child")
    assert steps.all_inner_texts() != right
    for place, name in enumerate(right):
        while steps.all_inner_texts().index(name) > place:
            form.get_by_role("button", name=f"Move up: {name}").focus()
            page.keyboard.press("Enter")
            assert page.evaluate("document.activeElement.ariaLabel") == f"Move up: {name}"
            assert "Now step" in form.locator(".outcome").inner_text()
    form.get_by_role("button", name="Check", exact=True).click()
    assert "Right" in form.locator(".outcome").inner_text()


def test_a_wrong_order_is_explained(visit: Visit) -> None:
    """As it stands at first, it is never right."""
    form = question(visit.go(QUIZ_1), "install-what-first")
    assert "Not yet" in choose(form)
    assert "belongs elsewhere" in " ".join(form.locator(".why:visible").all_inner_texts())


def test_what_does_this_print(visit: Visit) -> None:
    """A known mistake gets its own explanation; spaces do not count."""
    page = visit.go(QUIZ_3)
    form = question(page, "topics-period")
    answer = form.get_by_label("It prints:")
    for text, told in (("4", "This is the rate."), ("5", "line by line"), (" 0.25 ", "Right.")):
        answer.fill(text)
        page.keyboard.press("Enter")
        assert told in form.inner_text()


def test_the_form_is_a_real_form(visit: Visit) -> None:
    """Fieldset, legend, radio buttons with arrows, labels, a spoken outcome."""
    page = visit.go(QUIZ_1)
    form = question(page, "install-one-terminal")
    assert "What does terminal 2 know" in form.locator("fieldset > legend").inner_text()
    form.locator("input").first.focus()
    page.keyboard.press("ArrowDown")
    assert form.locator("input").nth(1).is_checked()
    page.keyboard.press("Enter")
    assert form.locator("[role=status]").inner_text()


def test_a_missed_question_comes_back_at_growing_intervals(visit: Visit) -> None:
    """1, 3, 7, 14 and 30 days, and then it is learnt; a wrong answer begins again."""
    page = visit.page
    page.clock.install(time="2026-03-01T10:00:00")
    choose(question(visit.go(QUIZ_1), "install-one-terminal"), WRONG)
    visit.go("review.html")
    assert "comes back on 2026-03-02" in page.locator(".review-status").inner_text()
    assert page.locator("form.question:visible").count() == 0
    due = ["2026-03-02", "2026-03-05", "2026-03-12", "2026-03-26", "2026-04-25"]
    for day, after in zip(due, [*due[1:], None], strict=True):
        page.clock.set_fixed_time(f"{day}T00:05:00")
        visit.go("review.html")
        assert "One question is due today" in page.locator(".review-status").inner_text()
        assert "Right" in choose(page.locator("form.question:visible"), RIGHT)
        assert stored(page)["questions"]["install-one-terminal"].get("due") == after
    assert "No question is missed" in page.locator(".review-status").inner_text()
    choose(question(visit.go(QUIZ_1), "install-one-terminal"), WRONG)
    assert stored(page)["questions"]["install-one-terminal"]["due"] == "2026-04-26"


def test_answering_again_the_same_day_does_not_skip_an_interval(visit: Visit) -> None:
    """Who sees the answer and repeats it has not learnt it."""
    page = visit.page
    page.clock.install(time="2026-12-31T23:00:00")
    form = question(visit.go(QUIZ_1), "install-one-terminal")
    choose(form, WRONG)
    choose(form, RIGHT)
    choose(form, RIGHT)
    assert stored(page)["questions"]["install-one-terminal"]["due"] == "2027-01-01"


def test_home_says_what_is_due(visit: Visit) -> None:
    """And how far each day is."""
    page = visit.page
    page.clock.install(time="2026-03-01T10:00:00")
    choose(question(visit.go(QUIZ_1), "install-one-terminal"), WRONG)
    visit.go("index.html")
    assert page.locator(".review-due").is_hidden()
    assert "1 of 3 questions" in page.locator("[data-day='01-install']").inner_text()
    page.clock.set_fixed_time("2026-03-02T10:00:00")
    visit.go("index.html")
    assert "One missed question" in page.locator(".review-due").inner_text()


# --- files -------------------------------------------------------------------------------------


def exported(page: Any, button: str) -> str:
    """The text of the file that a button saves."""
    with page.expect_download() as download:
        page.get_by_role("button", name=button).click()
    return Path(download.value.path()).read_text("utf-8")


def load(page: Any, label: str, text: str, name: str = "file.json") -> None:
    """Load a file by a field."""
    file = {"name": name, "mimeType": "application/json", "buffer": text.encode()}
    page.get_by_label(label).set_input_files(file)


def test_progress_is_saved_and_loaded(visit: Visit) -> None:
    """Into another browser; what is newer there is kept."""
    page = visit.page
    page.clock.install(time="2026-03-01T10:00:00")
    choose(question(visit.go(QUIZ_1), "install-one-terminal"), WRONG)
    text = exported(visit.go("review.html"), "Save my progress")
    before = stored(page)
    page.evaluate("localStorage.clear()")
    page.clock.set_fixed_time("2026-03-02T10:00:00")
    choose(question(visit.go(QUIZ_3), "topics-who-hears"), "A best-effort subscription")
    visit.go("review.html")
    load(page, "Load progress", text)
    page.get_by_text("Loaded: 1 questions").wait_for()
    after = stored(page)["questions"]
    assert after["install-one-terminal"] == before["questions"]["install-one-terminal"]
    assert set(after) == {"install-one-terminal", "topics-who-hears"}
    assert "One question is due" in page.locator(".review-status").inner_text()


GOOD = {"right": False, "tries": 1, "on": "2026-03-01", "step": 0, "due": "2026-03-02"}


def progress(**change: Any) -> str:
    """A progress file with one thing other."""
    whole = {"roslings": "progress", "schema": 1, "questions": {"a": GOOD}, "days": {}, "labs": {}}
    return json.dumps({**whole, **change})


BAD_FILES = {
    "cut": (progress()[:-9], "not complete JSON"),
    "a picture": ("\x89PNG", "not complete JSON"),
    "a list": ("[1]", "not complete JSON"),
    "foreign": ('{"anki": 1}', "not a progress file"),
    "newer": (progress(schema=2), "form 2"),
    "no days": (progress(days=None), "damaged at days"),
    "a bad date": (progress(questions={"a": {**GOOD, "on": "yesterday"}}), "damaged at questions"),
    "a bad step": (progress(questions={"a": {**GOOD, "step": 99}}), "damaged at questions"),
    "a bad id": (progress(questions={"<img>": GOOD}), "damaged at questions"),
    "a bad score": (progress(labs={"a": {"on": "2026-03-01", "score": 1e9}}), "damaged at labs"),
    "too large": (progress(days={f"d{n}": {"on": "2026-03-01"} for n in range(40000)}), "JSON"),
}


def test_a_damaged_or_foreign_file_is_refused(visit: Visit) -> None:
    """Today's progress is kept, and the page says why."""
    page = visit.go(QUIZ_1)
    choose(question(page, "install-one-terminal"), WRONG)
    before = stored(page)
    visit.go("review.html")
    for text, told in BAD_FILES.values():
        load(page, "Load progress", text)
        answer = page.locator(".review-answer", has_text=told)
        answer.wait_for()
        assert "Your progress is unchanged" in answer.inner_text()
        assert stored(page) == before


def test_damaged_storage_is_set_aside(visit: Visit) -> None:
    """The page works, and nothing is thrown away."""
    page = visit.go("index.html")
    page.evaluate("localStorage.setItem('roslings.progress', '{\"half')")
    choose(question(visit.go(QUIZ_1), "install-one-terminal"), RIGHT)
    assert page.evaluate("localStorage.getItem('roslings.progress.damaged')") == '{"half'
    assert stored(page)["questions"]["install-one-terminal"]["right"]


def test_questions_go_to_anki(visit: Visit) -> None:
    """A card a line, stable ids, front and back."""
    page = visit.go("review.html")
    page.get_by_role("button", name="Missed questions for Anki").click()
    assert "Nothing was saved" in page.locator(".review-answer").inner_text()
    text = exported(page, "All questions for Anki")
    heads = [line for line in text.splitlines() if line.startswith("#")]
    cards = [line.split("\t") for line in text.splitlines() if not line.startswith("#")]
    assert {"#separator:tab", "#html:true", "#guid column:1"} <= set(heads)
    assert [len(card) for card in cards] == [4] * 5
    by_id = {card[0]: card for card in cards}
    assert "Sourcing changes" in by_id["roslings-install-one-terminal"][2]
    assert "print(1 / rate_hz)" in by_id["roslings-topics-period"][1]


def test_progress_can_be_deleted_after_a_question(visit: Visit) -> None:
    """Not by one press."""
    page = visit.go(QUIZ_1)
    choose(question(page, "install-one-terminal"), WRONG)
    visit.go("review.html")
    page.get_by_role("button", name="Delete my progress").click()
    assert stored(page)["questions"]
    page.get_by_role("button", name="Yes, delete").click()
    assert stored(page)["questions"] == {}


# --- the end of a day --------------------------------------------------------------------------


def verdict(**change: Any) -> str:
    """A verdict as `./roslings check --json` writes it, with one thing other."""
    whole = {"schema": 1, "lab": "topics", "outcome": "pass", "score": 100.0, "checks": []}
    return json.dumps({**whole, **change})


def answer_day_3(page: Any) -> None:
    """Answer each question, right or wrong."""
    question(page, "topics-period").get_by_label("It prints:").fill("1")
    question(page, "topics-period").get_by_role("button", name="Check").click()
    choose(question(page, "topics-who-hears"), "A reliable subscription")
    choose(question(page, "install-one-terminal"), RIGHT)


def test_a_day_is_done_after_its_quiz_and_its_verdict(visit: Visit) -> None:
    """The button unlocks only then; home shows it."""
    page = visit.go(QUIZ_3)
    done = page.get_by_role("button", name="Day 3 is done")
    assert done.is_disabled()
    answer_day_3(page)
    assert "✓ done" in page.locator("[data-need=quiz]").inner_text()
    assert done.is_disabled()
    for text, told in (
        ("{}", "not a verdict"),
        (verdict(outcome="fail", score=80), "80 of 100"),
        (verdict(outcome="inconclusive", score=None), "not everything could be told"),
        (verdict(lab="services"), "kept for the day of that lab"),
    ):
        load(page, "Load the verdict", text)
        page.locator(".day-state", has_text=told).wait_for()
        assert done.is_disabled()
    load(page, "Load the verdict", verdict())
    page.locator(".day-state", has_text="is loaded").wait_for()
    done.click()
    assert "Done" in visit.go("index.html").locator("[data-day='03-topics']").inner_text()


def test_a_verdict_is_dropped_on_the_page(visit: Visit) -> None:
    """As a file from the desktop."""
    page = visit.go(QUIZ_3)
    transfer = page.evaluate_handle(
        """text => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([text], "verdict.json", { type: "application/json" }));
            return transfer;
        }""",
        verdict(),
    )
    page.dispatch_event(".drop", "drop", {"dataTransfer": transfer})
    page.locator("[data-need=lab].done").wait_for()
    assert stored(page)["labs"]["topics"]["score"] == 100


def test_a_real_verdict_is_understood(visit: Visit) -> None:
    """The words of the engine's own model, not ours."""
    from roslings.verdict import Environment, Timings, Verdict

    real = Verdict(
        lab="topics",
        package="chatter",
        outcome="pass",
        score=100.0,
        checks=(),
        seconds=Timings(),
        environment=Environment(
            roslings="0.1.0",
            ros_distro="jazzy",
            rmw="rmw_fastrtps_cpp",
            python="3.12",
            platform="Linux",
            isolation="namespace",
            clock="wall",
            seed=1,
        ),
    )
    page = visit.go(QUIZ_3)
    load(page, "Load the verdict", real.model_dump_json(by_alias=True))
    page.locator("[data-need=lab].done").wait_for()


@pytest.mark.parametrize("name", ["days/01-install/index.html", QUIZ_1])
def test_a_day_without_a_lab_needs_its_quiz_only(visit: Visit, name: str) -> None:
    """Lesson and quiz carry the same box."""
    page = visit.go(QUIZ_1)
    for each, chosen in (("one-terminal", RIGHT), ("which-are-true", MASTER), ("what-first", "")):
        choose(question(page, f"install-{each}"), *filter(None, [chosen]))
    page = visit.go(name)
    page.get_by_role("button", name="Day 1 is done").click()
    assert "This day is done" in page.locator(".day-state").inner_text()
