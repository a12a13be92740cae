"""Keys are heard while a check runs, and `q` ends it; then which drill comes next."""

from __future__ import annotations

import os
import pty
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime, timezone
from pathlib import Path

import pytest
from watch_terminal import watching

from ros2_on_pip.keyboard import keys_of
from roslings.course import all_labs, lab
from roslings.workspace.progress import record_drill
from roslings.workspace.progress_file import LabProgress, StudentProgress, as_json
from roslings_launcher.cli import parser
from roslings_learn.commands.watch import neighbour, next_name, run
from roslings_learn.commands.watch.drill import begun as drill_begun
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.commands.watch.lab import begun as lab_begun
from roslings_learn.commands.watch.session import Ours, WatchSession
from roslings_learn.drills import NoSuchDrill, all_drills, drill

pytestmark = pytest.mark.timeout(method="thread")
"""The alarm is the keyboard's here: the limit of each test must not use it as well."""

BOUND_S = 60.0
"""Only a test that fails waits so long."""
MARK = "sleeps_in_a_drill_4711"
SLEEPS = f"import time\nprint('it sleeps', flush=True)\n{MARK} = 600\ntime.sleep({MARK})\n"


@contextmanager
def hands() -> Iterator[tuple[Keyboard, int]]:
    """A keyboard, and the end at which keys are pressed."""
    pressed, terminal = pty.openpty()
    with os.fdopen(terminal, encoding="utf-8") as file, keys_of(file) as keys:
        yield Keyboard(keys), pressed
    os.close(pressed)


def until(is_so: object) -> None:
    """Wait for it."""
    assert callable(is_so)
    end_s = time.monotonic() + BOUND_S
    while not is_so():
        assert time.monotonic() < end_s
        time.sleep(0.01)


def test_a_key_is_answered_while_something_runs(capfd: pytest.CaptureFixture[str]) -> None:
    """At once, and once however long it is held; what it asks for comes afterwards."""
    with hands() as (keys, pressed):
        said = ""
        with keys.heard_meanwhile(lambda key: f"heard {key}"):
            for key in ("h", "h", "l"):
                os.write(pressed, key.encode())
                wanted = f"heard {key}"

                def is_said(wanted: str = wanted) -> bool:
                    nonlocal said
                    said += capfd.readouterr().out
                    return wanted in said

                until(is_said)
        assert said.count("heard h") == 1
        assert [keys.take(), keys.take(), keys.take()] == ["h", "l", ""]


def test_q_breaks_off_and_a_second_q_does_nothing() -> None:
    """It comes while all is put away: that must go on to its end."""
    with hands() as (keys, pressed):
        put_away = False
        with pytest.raises(KeyboardInterrupt), keys.heard_meanwhile(str):
            try:
                os.write(pressed, b"q")
                time.sleep(BOUND_S)
            finally:
                os.write(pressed, b"q")
                until(lambda: not keys.keys or not keys.keys.next(0.0))
                put_away = True
        assert put_away and keys.has_quit
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
        assert signal.getsignal(signal.SIGALRM) == signal.SIG_DFL


def test_without_keys_nothing_is_changed() -> None:
    """In a pipe no signal comes."""
    with Keyboard().heard_meanwhile(str):
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def sleeps() -> bool:
    """Whether the program of the drill still runs, in whatever namespace."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if MARK.encode() in (folder / "environ").read_bytes():
                return True
        except OSError:
            continue
    return False


@pytest.mark.slow
def test_q_ends_a_check_and_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice pressed, too: no verdict comes, and nothing of the run goes on."""
    monkeypatch.setenv("TMPDIR", str(tmp_path / MARK))
    (tmp_path / MARK).mkdir()
    one = drill("no_spin")
    file = tmp_path / "roslings_ws" / "drills" / one.day / one.file_name
    file.parent.mkdir(parents=True)
    file.write_text(SLEEPS)
    with watching(tmp_path, one.name) as watch:
        watch.shows("Drill .*no_spin|The lamp that goes out")
        watch.press("h")
        watch.shows("h: hint, as soon as this check is over")
        watch.press("q")
        os.write(watch.screen, b"q")
        said = watch.shows("q: quit. The check is ended.")
        watch.process.wait(BOUND_S)
    assert "no_spin  " not in said
    until(lambda: not sleeps())
    assert list((tmp_path / MARK).iterdir()) == []


# --- which keys are offered --------------------------------------------------------------------


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty, of a student without an editor."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path))
    for word in ("VISUAL", "EDITOR", "TERM_PROGRAM"):
        monkeypatch.delenv(word, raising=False)
    monkeypatch.setenv("PATH", "")
    return tmp_path


def offered(session: WatchSession) -> str:
    """The letters in the line of keys."""
    return "".join(sorted(each.key for each in session._all_offers() if each.now))


def test_a_key_that_can_do_nothing_is_not_offered(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Editor, reset, next, compare; who presses it all the same reads why."""
    session = drill_begun("no_spin", Keyboard())
    assert offered(session) == "ahlqrs"
    session.file.write_text("# mine\n")
    session.solved = Ours("child", lambda: print("ours"))
    assert offered(session) == "achlqrsx"
    for key, why in (("e", "no editor"), ("n", "not done yet"), ("z", "no such key")):
        session.follow(key)
        assert why in capsys.readouterr().out
    session.follow("c")
    assert capsys.readouterr().out.splitlines()[0] == "ours"


def test_a_lab_has_a_graph_once_a_node_has_run(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A lab can neither be passed over nor begun again."""
    session = lab_begun(lab("nodes"), parser().parse_args(["watch", "nodes"]), Keyboard())
    assert offered(session) == "ahlqr"
    session.follow("g")
    session.follow("a")
    said = capsys.readouterr().out
    assert "No node has run yet" in said and "02-nodes" in said


def test_the_line_of_keys_fits_the_terminal(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All at once, too."""
    session = drill_begun("no_spin", Keyboard())
    session.file.write_text("# mine\n")
    session.solved = Ours("child", print)
    monkeypatch.setenv("PATH", os.defpath)
    assert max(map(len, session._line_of_keys().splitlines())) <= 80


def test_reset_asks_first(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One press changes nothing; the second keeps what was there."""
    session = drill_begun("no_spin", Keyboard())
    session.file.write_text("# mine\n")
    session.follow("x")
    assert session.file.read_text() == "# mine\n"
    session.follow("x")
    assert session.file.read_bytes() == session.drill.starter.read_bytes()
    kept = [path for path in session.file.parent.iterdir() if path != session.file]
    assert [path.read_text() for path in kept] == ["# mine\n"]
    assert kept[0].name in capsys.readouterr().out


def test_what_an_editor_makes_and_takes_away_is_no_save(workspace: Path) -> None:
    """A new name that is gone already; what was there before and is gone is told."""
    session = drill_begun("no_spin", Keyboard())
    session.counts = lambda saved: True  # type: ignore[method-assign]  # as of a lab
    folder = session.folder.resolve()
    here, passing = session.file.resolve(), folder / "AbCdEf"
    assert session._that_stay(frozenset()) == frozenset()
    assert session._that_stay(frozenset({here, passing})) == {here}
    here.unlink()
    assert session._that_stay(frozenset({here})) == {here}
    assert session._that_stay(frozenset({folder})) == {folder}


def test_a_save_of_another_drill_is_none_of_this_one(workspace: Path) -> None:
    """They lie side by side."""
    session = drill_begun("no_spin", Keyboard())
    other = session.folder.resolve() / "02_brackets.py"
    other.write_text("x")
    assert session._that_stay(frozenset({other})) == frozenset()


# --- which one is next -------------------------------------------------------------------------


def test_a_drill_is_followed_by_its_neighbour(workspace: Path) -> None:
    """Of the same day, not done, not passed over; after the last one of the day comes the way."""
    names = [one.name for one in all_drills() if one.day == "03-topics"]
    assert neighbour(names[3], frozenset()) == names[4]
    record_drill(names[4], True, workspace)
    assert neighbour(names[3], frozenset({names[5]})) == names[6]
    assert neighbour(names[-1], frozenset()) is None
    assert neighbour("topics", frozenset()) is None


def test_what_is_passed_over_does_not_come_back(workspace: Path) -> None:
    """In this watch; when all drills are passed over, the lab is next."""
    first = all_drills()[0].name
    assert next_name() == first
    assert next_name(frozenset({first})) == all_drills()[1].name
    lab_one = next(iter(all_labs()))
    up_to_it = {one.name for one in all_drills() if one.day <= lab_one.outline.day}
    assert next_name(frozenset(up_to_it)) == lab_one.name


def test_when_all_is_done_it_is_said(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """And nothing is watched."""
    now = datetime.now(timezone.utc)
    done = LabProgress(100.0, 100.0, 1, now, now, now)
    file = workspace / ".roslings" / "progress.json"
    file.parent.mkdir()
    file.write_text(as_json(StudentProgress({each.name: done for each in all_labs()})))
    assert run(parser().parse_args(["watch", "--plain"])) == 0
    assert "Well done" in capsys.readouterr().out


@pytest.mark.parametrize(("typed", "near"), [("no_spn", "no_spin"), ("chatr", "chater")])
def test_a_slip_in_a_drills_name_is_told(typed: str, near: str, workspace: Path) -> None:
    """Where it is no lab's."""
    with pytest.raises(NoSuchDrill, match=near):
        run(parser().parse_args(["watch", typed, "--plain"]))
