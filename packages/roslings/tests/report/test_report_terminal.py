"""The verdict in the terminal: real output of real consoles, read back as text."""

from __future__ import annotations

import io
import re

import pytest
import written_verdicts as written
from rich.cells import cell_len
from rich.console import Console

from roslings.report.log_lines import helpful
from roslings.report.terminal import NoSuchCheck, print_verdict
from roslings.verdict import Verdict

COLOUR = re.compile(r"\x1b\[3[0-7]m|\x1b\[1;3[0-7]m")


def shown(
    verdict: Verdict,
    *,
    width: int = 80,
    height: int = 200,
    encoding: str = "utf-8",
    terminal: bool = False,
    hint_step: int | None = None,
    only: str | None = None,
    whole: bool = False,
    before: Verdict | None = None,
) -> str:
    """What the console writes, decoded."""
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding=encoding)
    console = Console(
        file=stream,
        width=width,
        height=height,
        force_terminal=terminal,
        color_system="standard" if terminal else None,
        legacy_windows=False,
    )
    print_verdict(
        verdict, console=console, hint_step=hint_step, only=only, whole=whole, before=before
    )
    stream.flush()
    return raw.getvalue().decode(encoding)


def without_colours(text: str) -> str:
    """The text as it stands on the screen."""
    return re.sub(r"\x1b\[[0-9;]*m", "", text)


VERDICTS = {
    "full score": written.full_score(),
    "too slow": written.too_slow(),
    "crashed": written.crashed(),
    "syntax error": written.syntax_error(),
    "three faults": written.three_faults(),
    "inconclusive": written.inconclusive(),
}


@pytest.mark.parametrize("name", VERDICTS)
@pytest.mark.parametrize("width", [60, 80, 132])
@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "latin-1"])
def test_every_line_fits_and_every_check_has_its_points(
    name: str, width: int, encoding: str
) -> None:
    """Nothing is wider than the console, in any encoding, and no check is left out."""
    text = shown(VERDICTS[name], width=width, encoding=encoding)
    assert max(map(cell_len, text.splitlines())) <= width
    marked = re.findall(r"^\S (pass|fail|skip|open) +(\?|\d+)/\d+  \S", text, re.MULTILINE)
    assert [word for word, _ in marked] == sorted(
        (
            {"inconclusive": "open"}.get(check.outcome, check.outcome)
            for check in VERDICTS[name].checks
        ),
        key=["pass", "skip", "open", "fail"].index,
    )


@pytest.mark.parametrize("name", ["full score", "too slow", "syntax error", "inconclusive"])
def test_fits_a_screen_of_24_lines(name: str) -> None:
    """With one failure or none everything stands on one screen, the prompt included."""
    text = without_colours(shown(VERDICTS[name], height=24, terminal=True))
    assert text.count("\n") <= 23
    for check in VERDICTS[name].checks:
        assert check.id in text


def test_three_failures_fit_a_screen_of_40_lines() -> None:
    """Passes share lines, so that three failures with all they have to say fit."""
    text = without_colours(shown(written.three_faults(), height=40, terminal=True))
    assert text.count("\n") <= 39
    assert "well_formed 5/5, depends 5/5" in text


def test_a_screen_has_the_first_failure_on_top_and_folds_the_others() -> None:
    """Of the others there is one line each; `--all`, a file and a pipe have them whole."""
    verdict = written.three_faults()
    first, *others = verdict.failed()
    screen = without_colours(shown(verdict, terminal=True))
    assert screen.index(f"{first.id}: ") < screen.index("pass")
    assert screen.count("  expected  ") == 1
    assert screen.endswith("All       See every check whole: ./roslings check topics --all\n")
    for text in (shown(verdict, terminal=True, whole=True), shown(verdict)):
        assert text.count("  expected  ") == 1 + len(others)
        assert "--all" not in text


def test_a_screen_says_what_has_turned_green_and_what_is_green_no_more() -> None:
    """Since the check before; where nothing changed, or nothing was before, nothing is said."""
    before, now = written.three_faults(), written.too_slow()
    green = without_colours(shown(now, terminal=True, before=before))
    new = [check.id for check in before.failed() if check.id != "rate"]
    assert f"New       Green since your last check: {', '.join(new)}.\n" in green
    assert "Lost" not in green
    lost = without_colours(shown(before, terminal=True, before=now))
    assert f"Lost      Green before, and not now: {', '.join(new)}.\n" in lost
    for same in (now, None):
        assert "your last check" not in shown(now, terminal=True, before=same)


def test_failure_says_expected_measured_why_what_to_try_and_what_is_next() -> None:
    """Each part of a failure has its label; the end says the score and the next step."""
    text = shown(written.too_slow())
    assert "✗ fail   0/15  rate: /chatter carries two messages a second." in text
    assert "  expected  2 Hz, from 1.9 to 2.1 Hz\n" in text
    assert "  measured  1.00 Hz: 12 messages, one each 1.00 s\n" in text
    assert "  why       A robot that steers" in text
    assert "  try       The period is twice" in text
    assert "  read      days/03-topics#timers\n" in text
    assert text.endswith(
        "Score     85 of 100. 20 checks: 19 pass, 1 fails.\n"
        'Next      Mend "rate", then check again: ./roslings check topics\n'
        "Stuck     Ask for a hint: ./roslings check topics --hint\n"
    )


def test_first_failed_check_is_the_next_step() -> None:
    """Of three failures the first in the grader's order comes first."""
    assert 'Mend "rate" first, then check again:' in shown(written.three_faults())


def test_skipped_checks_say_once_what_must_be_mended_first() -> None:
    """Sixteen checks wait for one; the reason stands below them, once."""
    text = shown(written.syntax_error())
    assert text.count("This waits for builds: mend that first.") == 1
    assert text.count("○ skip") == 16


def test_inconclusive_has_its_reason_and_no_score() -> None:
    """It says that nothing is lost, and what to do."""
    text = " ".join(shown(written.inconclusive()).split())
    assert "? open ?/15 /chatter carries two messages a second." in text
    assert "This machine was too busy: the observer itself stood still for 2.1 s." in text
    assert "Score none yet." in text
    assert "costs you nothing" in text
    assert "./roslings doctor" in text


def test_full_score_is_short_warm_and_says_what_comes_next() -> None:
    """No exclamation marks, and the next command."""
    text = shown(written.full_score())
    assert "Score     100 of 100. 20 checks, and every one passes." in text
    assert "Well done: chatter does all that this lab asks for." in text
    assert "./roslings pack topics" in text
    assert "!" not in text
    assert "fail" not in text


def test_colour_only_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a terminal, or with NO_COLOR, the words alone tell the outcome."""
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert "\x1b" not in shown(written.too_slow())
    assert COLOUR.search(shown(written.too_slow(), terminal=True))
    monkeypatch.setenv("NO_COLOR", "1")
    assert not COLOUR.search(shown(written.too_slow(), terminal=True))


def test_ascii_where_the_encoding_lacks_the_marks() -> None:
    """Marks and box fall back to ASCII; words stay."""
    text = shown(written.crashed(), encoding="ascii")
    assert "x fail    0/5  talker_runs:" in text
    assert "+ pass" in text
    assert "- skip" in text
    assert "  +- The last lines that came out -" in text


def test_ascii_on_the_linux_text_console(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its fonts lack the marks although it says UTF-8."""
    monkeypatch.setenv("TERM", "linux")
    assert "x fail" in shown(written.too_slow())


def test_escape_sequences_and_markup_of_the_student_are_harmless() -> None:
    """A node's output can neither clear the screen, nor set colours, nor turn text round."""
    bad = (
        "\x1b[2J\x1b]0;title\x07 [red]10/10[/red] :smile: \r\b\u202egnp.\u2028 \udcff \ud800 \x9b2J"
    )
    verdict = written.verdict(written.failing("text", measured=bad, log=(bad,), hint=bad))
    text = shown(verdict)
    assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e\u2028]", text)
    assert "\\x1b[2J\\x1b]0;title\\x07 [red]10/10[/red] :smile: \\r\\x08\\u202egnp.\\u2028" in text
    assert "\\xff \\ud800 \\x9b2J" in text


def test_new_lines_of_a_message_stay_below_their_label() -> None:
    """A message with line breaks cannot write a line of its own, such as a mark and points."""
    verdict = written.verdict(written.failing("text", measured="Hello\n✓ pass  100/100"))
    assert "  measured  Hello\n            ✓ pass  100/100\n" in shown(verdict)
    title = written.failing("text").model_copy(update={"title": "One\n✓ pass  5/5"})
    assert "\n✓ pass  5/5" not in shown(written.verdict(title))


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_endless_lines_are_cut(encoding: str) -> None:
    """A megabyte on one line, in log or measured, does not push the verdict off the screen."""
    verdict = written.verdict(
        written.failing("text", measured="word " * 200_000, log=("界" * 1_000_000,) * 40)
    )
    text = shown(verdict, encoding=encoding)
    assert text.count("\n") < 75
    assert max(map(cell_len, text.splitlines())) <= 80


def test_long_paths_break_after_a_slash() -> None:
    """No folder's name is torn where the path has a place to break."""
    path = "/home/anna/" + "/".join(f"folder{number}" for number in range(20)) + "/talker.py"
    text = shown(written.verdict(written.failing("builds", measured=f"{path}:3: bad")))
    parts = text.split("measured")[1].split("\n\n")[0].split()
    whole = re.compile(r"[/a-z0-9]+/(talker\.py:3:)?|talker\.py:3:|bad")
    assert all(whole.fullmatch(part) for part in parts), parts
    assert "".join(parts) == f"{path}:3:bad"


def test_wide_letters_are_measured_as_they_are_shown() -> None:
    """Chinese letters take two cells each."""
    text = shown(
        written.verdict(written.failing("text", measured="你好" * 100, log=("世界" * 50,)))
    )
    assert max(map(cell_len, text.splitlines())) <= 80


def test_traceback_keeps_the_students_frames() -> None:
    """Of a long traceback the frames in libraries go, and installed paths become short."""
    text = shown(written.crashed())
    assert 'File ".../chatter/talker.py", line 12, in __init__' in text
    assert "AttributeError: type object 'str'" in text
    assert "rclpy/node.py" not in text
    assert "load_entry_point" not in text
    assert "^^^" not in text


def test_a_short_traceback_has_no_start_script_either() -> None:
    """Frames of libraries stay only where the student has none, and there is room."""
    script = '  File "/home/anna/ws/install/chatter/lib/chatter/talker", line 33, in <module>'
    library = '  File "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/node.py", line 9, in spin'
    own = '  File "/home/anna/ws/install/chatter/lib/python3.12/site-packages/chatter/talker.py", 4'
    begin, error = "Traceback (most recent call last):", "TypeError"
    lone = helpful((begin, script, "    sys.exit(main())", library, error), "chatter", 8)
    assert lone == [begin, library, error]
    assert helpful((begin, script, own, library, "    x", error), "chatter", 8) == [
        begin,
        '  File ".../chatter/talker.py", 4',
        error,
    ]


def test_colours_of_a_log_go_away() -> None:
    """Python 3.13 and rcutils colour what they write to a terminal."""
    log = ("\x1b[33m[WARN] [talker]: late\x1b[0m", "  \x1b[1;31m^^^^\x1b[0m")
    text = shown(written.verdict(written.failing("ends", log=log)))
    assert "│ [WARN] [talker]: late " in text
    assert "\\x1b" not in text
    assert "^" not in text


def test_only_shows_one_check() -> None:
    """One check with all there is to say, and the way back to all of them."""
    text = shown(written.crashed(), only="talker_runs")
    assert "Traceback" in text
    assert "listener" not in text
    assert "Ask for a hint: ./roslings check topics --hint\n" in text
    assert "See all checks: ./roslings check topics\n" in text


def test_only_with_a_wrong_name_offers_the_near_one() -> None:
    """A misspelt name is told with the name that was meant."""
    with pytest.raises(NoSuchCheck, match=r"no check 'rat'\. Did you mean 'rate'"):
        shown(written.too_slow(), only="rat")


@pytest.mark.parametrize("step", [1, 2, 3])
def test_a_hint_shows_its_own_step_and_no_other(step: int) -> None:
    """Who asks for the first step does not see the third."""
    text = shown(written.too_slow(), hint_step=step, width=100)
    for number, hint in enumerate(written.HINTS, start=1):
        assert (hint.splitlines()[0] in text) == (number == step)
    assert f"Hint {step} of 3" in text
    assert (f"./roslings check topics --hint {step + 1}\n" in text) == (step < 3)


def test_a_hint_keeps_the_lines_of_its_code() -> None:
    """Python's indentation means something."""
    text = shown(written.too_slow(), hint_step=3)
    assert "  def blink(self):\n      # 4 times a second\n      self.create_timer(1 / 4" in text


def test_a_hint_for_a_later_check_names_it_in_the_next_command() -> None:
    """--only stays, so that the next step is for the same check."""
    text = shown(written.three_faults(), hint_step=1, only="figure")
    assert "./roslings check topics --only figure --hint 2\n" in text


@pytest.mark.parametrize(
    ("verdict", "only", "words"),
    [
        (written.full_score(), None, "No check failed"),
        (written.full_score(), "rate", "needs no hint"),
        (written.crashed(), "rate", "A hint for talker_runs: ./roslings check topics --hint\n"),
        (written.verdict(written.failing("rate")), None, "This check has no such hint."),
    ],
)
def test_where_there_is_no_hint_it_says_so(verdict: Verdict, only: str | None, words: str) -> None:
    """And names what helps instead."""
    text = shown(verdict, only=only, hint_step=1)
    assert words in text
    assert "./roslings check topics" in text


@pytest.mark.parametrize("step", [0, 4, -1])
def test_there_are_three_steps(step: int) -> None:
    """Any other is a mistake of the caller's."""
    with pytest.raises(ValueError, match="steps 1 to 3"):
        shown(written.too_slow(), hint_step=step)


@pytest.mark.parametrize("width", [1, 10, 24, 30])
def test_a_tiny_window_is_no_crash(width: int) -> None:
    """What does not fit wraps."""
    for verdict in VERDICTS.values():
        assert "Score" in "".join(shown(verdict, width=width).split())
