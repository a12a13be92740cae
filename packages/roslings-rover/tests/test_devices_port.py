"""The board on its serial port, read by pyserial as a bridge would: faults, and a cable pulled."""

from __future__ import annotations

import select
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from program import environment, run, running, until

from roslings_rover.board import Board, DriveCommand, LineReader, Mega, Spoiler, framed
from roslings_rover.board.wire import HELD_S, Wire
from roslings_rover.rover import Box, Rover, World
from skips import imported

serial = imported("serial")
FLOOR = World(room=Box(-50, -50, 50, 50))


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    """A board that lives step by step."""
    with Board(Mega(Rover(FLOOR)), tmp_path / "ttyTEST") as board:
        yield board


def opened(board: Board) -> serial.Serial:
    """The port as a student opens it."""
    return serial.Serial(board.name, 115200, timeout=0, write_timeout=0.2, exclusive=True)


def test_lines_arrive_and_commands_are_obeyed(board: Board) -> None:
    """Both ways through a real pseudo-terminal."""
    with opened(board) as host:
        host.write(DriveCommand(5, 100, 50).line())
        board.step(0.2)
        bodies = LineReader().feed(host.read(4096))
    assert bodies[0] == "A,5"
    assert bodies[1].startswith("W,0,20,")
    assert (board.chip.truth.left_pwm, board.chip.truth.right_pwm) == (100, 50)
    assert [chunk.content for chunk in board.heard] == [DriveCommand(5, 100, 50).line()]


def test_what_nobody_reads_is_lost_and_the_board_goes_on(board: Board) -> None:
    """As on a wire; the buffer of the system holds some seconds of it."""
    with opened(board) as host:
        for _ in range(60):
            board.step(1.0)
        assert board.lost_bytes > 0
        host.reset_input_buffer()
        board.step(0.2)
        assert LineReader().feed(host.read(4096))


def test_a_pulled_cable_is_an_error_and_the_same_name_comes_back(board: Board) -> None:
    """The board lives on meanwhile: its clock shows it."""
    with opened(board) as host:
        board.unplug()
        assert not Path(board.name).exists()
        with pytest.raises(serial.SerialException):
            host.read(1)
    with pytest.raises(serial.SerialException, match="No such file"):
        opened(board)
    board.step(5.0)
    board.plug_in()
    with opened(board) as again:
        board.step(0.1)
        first = LineReader().feed(again.read(4096))[0]
    assert int(first.split(",")[2]) == 5020


def test_a_port_in_use_is_busy(board: Board) -> None:
    """Where both ask for it alone."""
    with opened(board), pytest.raises(serial.SerialException, match="exclusively lock"):
        opened(board)


def test_in_real_time_a_reader_is_woken(board: Board) -> None:
    """Lines come by themselves, in order, while the block runs; no thread is left after it."""
    with board.running(), opened(board) as host:
        host.timeout = 30
        reader, bodies = LineReader(), list[str]()
        while len(bodies) < 20:
            came = host.read(1)
            assert came, f"no more came than {bodies}"
            bodies += reader.feed(came)
    sequence = [int(body.split(",")[1]) for body in bodies if body.startswith("W")]
    assert sequence == list(range(sequence[0], sequence[0] + len(sequence)))
    assert "board" not in [thread.name for thread in threading.enumerate()]


def test_a_board_lives_on_however_often_its_cable_is_pulled(board: Board) -> None:
    """Also where it is pulled in the very moment in which the board waits for it."""
    before_s = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with board.running():
            for _ in range(500):
                board.unplug()
                board.plug_in()
            pulled_s = board.chip.truth.time_s
            alive = [thread for thread in threading.enumerate() if thread.name == "board"]
            assert len(alive) == 1
            until(
                lambda: board.chip.truth.time_s > pulled_s or not alive[0].is_alive(),
                lambda: f"its clock stands at {pulled_s} s",
            )
            assert alive[0].is_alive()
    finally:
        sys.setswitchinterval(before_s)
    assert board.trouble is None


# --- how fast the cable is ---------------------------------------------------------------------


def test_on_a_slow_cable_a_line_comes_in_pieces(tmp_path: Path) -> None:
    """A tenth of the bits a second are bytes; all of them come, in their order, cut anywhere."""
    chip = Mega(Rover(FLOOR))
    with Board(chip, tmp_path / "ttyTEST", Wire(4800)) as board, opened(board) as host:
        pieces = []
        for _ in range(200):
            board.step(0.005)
            pieces.append(host.read(4096))
        told = b"".join(chunk.content for chunk in board.told)
    came = b"".join(pieces)
    assert max(map(len, pieces)) <= 3
    assert any(piece and not piece.endswith(b"\n") for piece in pieces)
    assert came == told[: len(came)]
    assert 400 < len(came) <= 480 < len(told)


def test_a_chip_that_gathers_bytes_is_late() -> None:
    """What came through meanwhile arrives together, when its time is over; all of it comes."""
    wire = Wire(bits_s=10_000, packet_s=0.016)
    came = [wire(b"0123456789" if n % 3 == 0 else b"", 0.004) for n in range(12)]
    assert [n for n, piece in enumerate(came) if piece] == [3, 7, 11]
    assert came[3] == b"01234567890123"
    assert b"".join(came) == b"0123456789" * 4


LINE = b"$W,2,60,0,0*7BFF\n"


def test_a_packet_ends_within_a_line_and_everywhere_in_turn() -> None:
    """Each line comes in two pieces at least, and no byte is lost."""
    wire = Wire(bits_s=57_600, packet_s=0.016)
    came = [wire(LINE if n % 5 == 0 else b"", 0.0041) for n in range(1000)]
    sent = b"".join(came)
    ends = {len(sent[:at]) % len(LINE) for at in _ends(came)}
    assert set(range(1, len(LINE))) <= ends
    assert sum(not piece.endswith(b"\n") for piece in came if piece) > 190
    assert (LINE * 200).startswith(sent) and len(sent) > 199 * len(LINE)


def _ends(pieces: list[bytes]) -> list[int]:
    return [sum(map(len, pieces[:n])) for n, piece in enumerate(pieces, 1) if piece]


def test_a_packet_waits_for_a_host_that_has_not_read_the_one_before() -> None:
    """A host that is late finds a half, too; one that never reads is not waited for."""
    wire = Wire(packet_s=0.016)
    assert wire(LINE, 0.016) == LINE[:1]
    assert wire(LINE, 0.1, is_read=False) == b""
    late = wire(b"", 0.016)
    assert late.startswith(LINE[1:]) and not late.endswith(b"\n")
    assert wire(b"", HELD_S, is_read=False) == (LINE * 2)[1 + len(late) :]


def test_the_port_knows_what_the_host_has_read(board: Board) -> None:
    """What was sent waits until it is read."""
    with opened(board) as host:
        assert board.port.is_read
        board.port.write(b"hello")
        assert select.select([host.fd], [], [], 60)[0]
        assert not board.port.is_read
        assert host.read(5) == b"hello"
        assert board.port.is_read


def test_a_cable_that_is_pulled_keeps_nothing() -> None:
    """What was under way is lost; then the whole next line comes, as fast as before."""
    wire = Wire(bits_s=100)
    assert wire(b"hello", 0.2) == b"he"
    assert wire(b"", 0.15) == b"l"
    wire.cut()
    assert wire(b"you", 0.1) == b"y"
    assert Wire()(b"all at once", 0.0) == b"all at once"


def test_the_board_knows_the_speed_that_the_host_asked_for(board: Board) -> None:
    """The pretended port carries bytes at any speed; nobody's is none."""
    assert board.port.host_bits_s is None
    with opened(board):
        assert board.port.host_bits_s == 115200
    with serial.Serial(board.name, 57600):
        assert board.port.host_bits_s == 57600
    board.unplug()
    assert board.port.host_bits_s is None


# --- what can go wrong on the cable ------------------------------------------------------------

LINES = [DriveCommand(i, i % 256, -i % 256).line() for i in range(500)]


def through(spoil: Spoiler) -> tuple[list[str], int]:
    """The good bodies and the number of rejected lines after a bad cable."""
    reader = LineReader()
    return [body for line in LINES for body in reader.feed(spoil(line))], reader.rejected


@pytest.mark.parametrize(
    "spoil",
    [
        Spoiler(1, noise=0.01),
        Spoiler(1, half_lines=0.3),
        Spoiler(1, wrong_checksums=0.3),
        Spoiler(1, noise=0.01, half_lines=0.2, wrong_checksums=0.2, babble=20),
    ],
    ids=["noise", "half lines", "checksums", "all"],
)
def test_a_bad_cable_costs_lines_and_never_changes_one(spoil: Spoiler) -> None:
    """Each body that passes the checksum is one that was sent."""
    whole = {line[1:-6].decode() for line in LINES}
    bodies, rejected = through(spoil)
    assert set(bodies) <= whole
    assert 50 < len(bodies) < len(LINES) - 50
    assert rejected > 50


def test_a_wrong_checksum_is_all_that_is_wrong_with_a_line() -> None:
    """It is as long as the line was; who does not compare the checksum takes another number."""
    spoil = Spoiler(wrong_checksums=1.0)
    assert spoil(framed("W,7,140,-6100,5327")).startswith(b"$W,7,140,-6100,0327*")
    for line in LINES:
        came = spoil(line)
        numbers, others = line[1:-6].split(b","), came[1:-6].split(b",")
        assert came[-6:] == line[-6:] and len(came) == len(line)
        assert numbers[:-1] == others[:-1] and int(numbers[-1]) != int(others[-1])


def test_a_good_cable_and_a_silent_one() -> None:
    """The two ends."""
    assert through(Spoiler()) == ([line[1:-6].decode() for line in LINES], 0)
    assert through(Spoiler(silent=True)) == ([], 0)


def test_the_same_seed_spoils_the_same() -> None:
    """So that a grading can be repeated."""
    assert through(Spoiler(3, noise=0.02)) == through(Spoiler(3, noise=0.02))
    assert through(Spoiler(3, noise=0.02)) != through(Spoiler(4, noise=0.02))


# --- ./roslings board --------------------------------------------------------------------------


def test_the_board_runs_as_a_command(tmp_path: Path) -> None:
    """It says where its port is, obeys, and leaves no port behind; a second one is refused."""
    port = tmp_path / "ttyROVER"
    surroundings = environment(0, tmp_path)
    with running(["board", "--port", str(port)], surroundings, tmp_path) as program:
        program.wait_for(f"The board is on {port}")
        second = run(["board", "--port", str(port)], surroundings, tmp_path)
        assert second.returncode == 2
        assert "runs already" in second.stderr
        with serial.Serial(str(port), 115200, timeout=30, exclusive=True) as host:

            def is_obeyed() -> bool:
                host.write(DriveCommand(1, 100, 100).line())
                assert host.read(20), "the board sends nothing"
                return "100" in "".join(program.lines[2:])

            until(is_obeyed, lambda: f"no line tells of the power 100: {program.lines}")
        assert program.interrupt() == 0
    assert not port.exists()


def test_what_never_comes_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A board that shows nothing fails the test with what it showed; it does not hang it."""
    monkeypatch.setattr("program.PATIENCE_S", 0.0)
    with pytest.raises(AssertionError, match="no line tells of it"):
        until(lambda: False, lambda: "no line tells of it")


def test_a_port_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    """A folder that is not there, a file in its place, a sketch that is not there."""
    (tmp_path / "file").touch()
    surroundings = environment(0, tmp_path)
    for words, says in (
        (["--port", "no/such/tty"], "No such file"),
        (["--port", "file"], "a file of this name"),
        (["--port", "tty", "--sketch", "none.ino"], "no sketch"),
    ):
        done = run(["board", *words], surroundings, tmp_path)
        assert done.returncode == 2
        assert says in done.stderr
        assert "Traceback" not in done.stderr
