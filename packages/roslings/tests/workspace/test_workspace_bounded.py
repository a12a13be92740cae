"""What is read of a package comes to an end: in little time, in little memory, or refused."""

from __future__ import annotations

import faulthandler
import os
import random
import resource
import signal
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import png as png_writer
import pytest
from PIL import Image

from roslings.course import Card, PictureContract
from roslings.course.written_yaml import load
from roslings.evidence import PackageSeen
from roslings.workspace import errors
from roslings.workspace.bounded import Bookmark, ReaderEnded, ReadingBounds, read_in_child
from roslings.workspace.inspect import inspect_package, read_package
from roslings.workspace.packages import LARGEST_BYTES, find_package
from roslings.workspace.pictures import LARGEST_PIXELS, look_at
from written_png import head_of, png_of

LITTLE = ReadingBounds(cpu_s=1, memory_bytes=64_000_000, answer_bytes=1000)
FIGURE = "figures/day3_rqt_graph.png"


# --- the child ---------------------------------------------------------------------------------


def for_ever(bookmark: Bookmark) -> str:
    """Takes a processor."""
    bookmark.put("slow.cfg")
    while True:
        pass


def fills(bookmark: Bookmark) -> str:
    """Takes all memory."""
    bookmark.put("a folder/Zoë.xml")
    return "x" * 10_000_000_000


def talks(bookmark: Bookmark) -> str:
    """Has no end of words."""
    bookmark.put("talks.py")
    return "x" * 2000


def breaks(bookmark: Bookmark) -> str:
    """Ends in a way that nobody has foreseen."""
    bookmark.put("broken.py")
    raise RecursionError


def dies(bookmark: Bookmark) -> str:
    """Ends by a fault of the memory, as a parser in C may."""
    bookmark.put("dies.xml")
    faulthandler.disable()  # of ours, which would tell it on the screen of the tests
    os.kill(os.getpid(), signal.SIGSEGV)
    return ""


@pytest.mark.parametrize(
    ("read", "at", "met"),
    [
        (for_ever, "slow.cfg", "time"),
        (fills, "a folder/Zoë.xml", "memory"),
        (talks, "talks.py", "memory"),
        (breaks, "broken.py", ""),
        (dies, "dies.xml", "crash"),
    ],
)
def test_who_reads_too_much_is_ended_and_the_file_is_named(
    read: Callable[[Bookmark], str], at: str, met: str
) -> None:
    """We go on, with the limits that we had; nothing of it runs on."""
    before = [resource.getrlimit(each) for each in (resource.RLIMIT_AS, resource.RLIMIT_CPU)]
    with pytest.raises(ReaderEnded) as ended:
        read_in_child(read, LITTLE)
    assert (ended.value.at, ended.value.met) == (at, met)
    after = [resource.getrlimit(each) for each in (resource.RLIMIT_AS, resource.RLIMIT_CPU)]
    assert before == after
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


def test_what_is_read_comes_back_and_so_do_errors(tmp_path: Path) -> None:
    """Each as itself: whoever catches it need not know of the child."""
    assert read_in_child(lambda _: "Zoë\0") == "Zoë\0"
    for error in (errors.NoSetupPy(tmp_path, True), errors.CannotRead(tmp_path)):
        with pytest.raises(type(error)) as told:
            read_in_child(lambda _, it=error: (_ for _ in ()).throw(it))  # type: ignore[misc]
        assert str(told.value) == str(error)
    with pytest.raises(FileNotFoundError) as gone:
        read_in_child(lambda _: (tmp_path / "gone").read_text())
    assert gone.value.filename == str(tmp_path / "gone")


# --- what hung, or ate the memory --------------------------------------------------------------

MERGES = "\n".join(
    ["a0: &a0 {k: v}"]
    + [f"a{n}: &a{n} {{<<: [{', '.join([f'*a{n - 1}'] * 9)}]}}" for n in range(1, 12)]
)
ALIASES = "\n".join(
    ["a0: &a0 [x]"] + [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
)
HEAD = '<?xml version="1.0"?><package format="3"><name>chatter</name>'
HOSTILE = {
    "package.xml": [
        HEAD + "<!--" * 15_900,
        HEAD + "<depend " * 7_900,
        HEAD + "<!-->" * 12_000,
        HEAD + "<build_type " * 5_000,
        HEAD + "<a>" * 21_000,
        HEAD + "<name>" * 10_000,
    ],
    "setup.cfg": ["[develop]\n" + "y\n" * 1_900, "[develop]\n" + ("a" + " " * 900 + "b\n") * 60],
    "colcon.pkg": [
        MERGES,
        f"{ALIASES}\ntype: *a11\nname: *a11",
        "[" * 60_000,
        "? " * 30_000,
        "type: " + "1" * 60_000,
        "type: 2001-99-99",
    ],
}
EACH = [(name, text) for name, texts in HOSTILE.items() for text in texts]


@pytest.mark.parametrize(("name", "text"), EACH, ids=[f"{n}-{t[-9:]!r}" for n, t in EACH])
def test_a_hostile_file_within_the_bounds_is_read(
    package: Path, card: Card, name: str, text: str
) -> None:
    """In two seconds of a processor, or it is refused: its readers need linear time."""

    def read(_: Bookmark) -> str:
        try:
            found = find_package(package, "chatter")
            return ",".join(inspect_package(found, card).xml_problems)
        except errors.OtherwiseForColcon as told:
            assert len(str(told)) < 2_000
            return "refused"

    (package / name).write_text(text, "utf-8")
    assert len(text) <= LARGEST_BYTES[name]
    told = read_in_child(read, ReadingBounds(cpu_s=2))
    assert (told == "refused") == (name == "colcon.pkg")


TOO_LARGE = {
    "package.xml": " " * 64_001,
    "setup.cfg": "#" * 64_001,
    "colcon.pkg": "#" * 64_001,
    "setup.cfg ": "[a]\n" + "y\n" * 2_000,
    "setup.cfg  ": "[a]\n#" + "y" * 1_000,
}


@pytest.mark.parametrize("name", TOO_LARGE)
def test_a_file_over_its_bound_is_refused_before_colcon_reads_it(
    package: Path, card: Card, name: str
) -> None:
    """With file, size and bound, and what to do."""
    file = package / name.strip()
    file.write_text(file.read_text() if name == "package.xml" else "")
    with file.open("a") as text:
        text.write(TOO_LARGE[name])
    for read in (lambda: find_package(package, "chatter"), lambda: inspect_package(package, card)):
        with pytest.raises(errors.FileTooLarge) as told:
            read()
        assert str(file) in told.value.problem
        assert "The limit is " in told.value.problem and "Write it anew" in told.value.next_step


def test_code_that_fills_the_memory_is_refused(package: Path, card: Card) -> None:
    """Not told as code that is nested too deeply: the file, its size and the bound are named."""
    (package / "chatter/table.py").write_text("x = [" + "a," * 490_000 + "]")
    with pytest.raises(errors.TooMuchToRead) as told:
        inspect_package(package, card)
    assert "chatter/table.py (980.0 kB)" in told.value.problem
    assert "more than 256 MB of memory" in told.value.problem


@pytest.mark.slow
def test_the_bound_is_what_holds_it(package: Path, card: Card) -> None:
    """The same package is read where there is memory enough: nothing else was in its way."""
    (package / "chatter/table.py").write_text("x = [" + "a," * 490_000 + "]")
    plenty = ReadingBounds(memory_bytes=4_000_000_000)
    told = read_in_child(lambda mark: read_package(package, card, mark).model_dump_json(), plenty)
    assert PackageSeen.model_validate_json(told).syntax_errors == []


@pytest.mark.parametrize("text", ["x = a" + ".b" * 900, "x = " + "1+" * 900 + "1"])
def test_what_is_nested_deeply_is_read(package: Path, card: Card, text: str) -> None:
    """Python reads it; so do we."""
    (package / "chatter/deep.py").write_text(text)
    assert inspect_package(package, card).syntax_errors == []


def test_a_table_of_aliases_is_small() -> None:
    """A name for what stands there already takes nothing; a merge would copy it."""
    assert load("a: &a [1]\nb: [*a, *a]") == {"a": [1], "b": [[1], [1]]}
    assert len(load(ALIASES)) == 12
    with pytest.raises(Exception, match="copies another mapping"):
        load(MERGES)


# --- pictures ----------------------------------------------------------------------------------


def png(width: int, height: int, rows: bytes, depth: int = 8, colour: int = 2) -> bytes:
    """A PNG of filtered rows."""
    image = b"IDAT", zlib.compress(rows, 1)
    return png_of(head_of(width, height, depth, colour), image, (b"IEND", b""))


def colours_of(content: bytes, folder: Path) -> int | None:
    """1, or 2 for all others; None for what is no picture."""
    (folder / "a.png").write_bytes(content)
    seen = look_at(folder, PictureContract.model_construct(path="a.png"))
    assert seen
    return seen.colours if seen.format else None


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA", "I;16"])
@pytest.mark.parametrize("seed", range(4))
def test_colours_are_counted_as_pillow_counts_them(mode: str, seed: int, tmp_path: Path) -> None:
    """Whatever filter the writer chose for a row; one pixel of another colour is enough."""
    lots = random.Random(f"{mode} {seed}")
    size = lots.randint(1, 40), lots.randint(1, 40)
    picture = Image.new(mode, size, lots.choice([0, 1]))
    for bits in range(2):
        picture.save(tmp_path / "b.png", optimize=bool(bits))
        assert colours_of((tmp_path / "b.png").read_bytes(), tmp_path) == 1
    if size != (1, 1):
        at = lots.randrange(size[0]), lots.randrange(size[1])
        was = picture.getpixel(at)
        other = tuple(255 - each for each in was) if isinstance(was, tuple) else int(not was)
        picture.putpixel(at, other)
        picture.save(tmp_path / "b.png")
        assert colours_of((tmp_path / "b.png").read_bytes(), tmp_path) == 2


@pytest.mark.parametrize("first", range(5))
@pytest.mark.parametrize("second", range(5))
def test_every_filter_is_known(first: int, second: int, tmp_path: Path) -> None:
    """The same picture of one colour, filtered by hand as the specification says."""
    pixel, width = (7, 200, 31), 6

    def filtered(way: int, above: list[int]) -> bytes:
        row = list(pixel) * width
        told = [way]
        for index, value in enumerate(row):
            left = row[index - 3] if index > 2 else 0
            corner = above[index - 3] if index > 2 else 0
            guess = left + above[index] - corner
            near = min((left, above[index], corner), key=lambda one: abs(one - guess))
            means = (0, left, above[index], (left + above[index]) // 2, near)
            told.append((value - means[way]) % 256)
        return bytes(told)

    row = list(pixel) * width
    rows = filtered(first, [0] * 18) + filtered(second, row) + filtered(first, row)
    assert colours_of(png(width, 3, rows), tmp_path) == 1
    assert colours_of(png(width, 3, rows[:-1] + bytes([rows[-1] ^ 1])), tmp_path) == 2
    assert colours_of(png(width, 4, rows), tmp_path) is None


@pytest.mark.parametrize("odd", [False, True])
def test_an_interlaced_picture_is_read(odd: bool, tmp_path: Path) -> None:
    """Seven small pictures, one after the other; pypng writes such a one."""
    rows = [[9, 9, 9] * 11 for _ in range(13)]
    rows[12][-1] += odd
    with (tmp_path / "b.png").open("wb") as file:
        png_writer.Writer(11, 13, greyscale=False, interlace=True).write(file, rows)
    assert colours_of((tmp_path / "b.png").read_bytes(), tmp_path) == 1 + odd


def test_a_picture_of_a_whole_screen_is_read(package: Path, card: Card) -> None:
    """A 4K screen of one colour, of which each row must be looked at."""
    Image.new("RGBA", (3840, 2160), (1, 2, 3, 4)).save(package / FIGURE)
    seen = inspect_package(package, card).pictures[FIGURE]
    assert (seen.width, seen.height, seen.colours) == (3840, 2160, 1)


def test_a_picture_of_a_wall_of_screens_is_refused(package: Path, card: Card) -> None:
    """49 million pixels; the file itself has few bytes."""
    (package / FIGURE).write_bytes(png(7000, 7000, b""))
    with pytest.raises(errors.PictureTooLarge) as told:
        inspect_package(package, card)
    assert "7000 x 7000 pixels, 49.0 million. The limit is 20 million" in told.value.problem
    assert LARGEST_PIXELS == 20_000_000


@pytest.mark.slow
def test_a_picture_that_unpacks_without_end_takes_no_memory(package: Path, card: Card) -> None:
    """A gigabyte of zeros in one chunk, behind the rows that are asked for."""
    packer = zlib.compressobj(9)
    rows = b"".join(packer.compress(bytes(1 << 20)) for _ in range(1000)) + packer.flush()
    whole = png(4000, 4000, b"")
    empty = zlib.compress(b"", 1)
    begin = whole.index(empty) - 8
    kind = b"IDAT" + rows
    chunk = struct.pack(">I", len(rows)) + kind + struct.pack(">I", zlib.crc32(kind))
    end = whole[whole.index(b"IEND") - 4 :]
    (package / FIGURE).write_bytes(whole[:begin] + chunk + end)
    assert inspect_package(package, card).pictures[FIGURE].colours == 1
