"""What the worst file costs that we read of a package: fuzzed for so many seconds; asserts nothing.

    .venv/bin/python tests/bench/readers.py SECONDS

Hypothesis makes files of up to the size that each reader takes, of words that its grammar knows and
of honest files that are cut and mended, and goes on with those that took the most time. Each is
read in a child with the bounds of a grading.
"""

from __future__ import annotations

import io
import json
import platform
import random
import shutil
import sys
import tarfile
import tempfile
import time
import zipfile
import zlib
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from hypothesis import HealthCheck, Phase, Verbosity, given, settings, target
from hypothesis import strategies as st

import roslings.folders.lab_folders  # noqa: F401  # `graders` can be imported from here on
from graders.black_box import diagnosis
from ros2_on_pip.errors import RoslingsError
from roslings.arena.bounds import MB
from roslings.course import PictureContract, lab
from roslings.hand_in.errors import HandInRefused
from roslings.hand_in.unpack import package_in
from roslings.workspace import bounded, code, documents
from roslings.workspace.bounded import Bookmark, ReaderEnded, read_in_child
from roslings.workspace.colcon_settings import said_in_child
from roslings.workspace.inspect import setup_cfg_problems
from roslings.workspace.manifest import read_manifest
from roslings.workspace.normal import digest_of_file
from roslings.workspace.packages import LARGEST_BYTES, insist_on_small_files
from roslings.workspace.pictures import look_at
from roslings_class.fingerprints import fingerprint
from written_png import head_of, png_of

SOLUTION = lab("topics").solution
EXAMPLES = 300
"""After so many files Hypothesis begins anew, elsewhere: it can climb one hill for very long."""


@dataclass(frozen=True)
class Reader:
    """One place where bytes of a stranger's are understood outside of every wall."""

    name: str
    file: str
    """Where the bytes are put, in a package."""
    most_bytes: int
    words: tuple[bytes, ...]
    read: Callable[[Path], object]
    """Told the package's folder."""
    honest: bytes = b""
    wrapped: Callable[[bytes], bytes] = bytes


@dataclass
class Worst:
    """Of all files that a reader was given."""

    files: int = 0
    seconds: float = 0.0
    memory_bytes: int = 0
    by_seconds: bytes = b""
    ended: Counter[str] = field(default_factory=Counter)
    """How often a bound was met, and the rest of what the child died of."""


def contents(reader: Reader) -> st.SearchStrategy[bytes]:
    """Words, many times over, in an honest file or alone."""
    runs = st.lists(
        st.tuples(
            st.lists(st.sampled_from(reader.words), min_size=1, max_size=4).map(b"".join),
            st.sampled_from((1, 2, 7, 60, 900, 9_000, 70_000, 600_000)),
        ),
        min_size=1,
        max_size=6,
    ).map(lambda parts: b"".join((word * count)[: reader.most_bytes] for word, count in parts))
    alone = st.one_of(runs, st.binary(max_size=200))
    cut = st.tuples(st.integers(0, max(len(reader.honest), 1)), runs).map(
        lambda at: reader.honest[: at[0]] + at[1] + reader.honest[at[0] :]
    )
    return st.one_of(alone, cut).map(lambda text: reader.wrapped(text)[: reader.most_bytes])


# --- the readers -------------------------------------------------------------------------------


def words(text: str) -> tuple[bytes, ...]:
    """Parted by blanks; ~ is a blank, and | the end of a line."""
    return tuple(part.replace("~", " ").replace("|", "\n").encode() for part in text.split())


XML = words("""<!-- --> <depend~ <exec_depend> </exec_depend> <name> </name> <a> </a> <a~ a="b"
    > < <![CDATA[ ]]> <!DOCTYPE &amp; &#65; <build_type> </build_type> <export> </export> <?x ?> ~ |
    a ($x~==~1) condition="((" <license> </license> <version>1.0.0</version> <author~email="a@a">
    """)
CFG = words(
    """[develop] [install] [ ] script_dir install_scripts = : ~ | ~a a % # ; $base/lib y|"""
)
YAML = words("""[ ] { } - ? : ~ | &a *a << <<: &b~ *b a: a:~ " ' # %YAML --- ... ! !!int !!set
    1 1: 2001-01-01 > | , ~~ \\ \t name: type: ~-~ |-~""")
PYTHON = words("""( ) [ ] { } : ; , . = == + - ~-~ * ** ~ | a 1 1e9 0x 'a' \\" \\' ''' f' {a} # \\
    not~ lambda~ lambda: if~ else~ await~ async~ def~a(): class~a: import~a| from~a~import~b| a=a|
    |~ |~~~~ @ -> := ~if~a~else~ setup( name= entry_points={ 'console_scripts':[ match~a:| case~
    'a'+ a.b \t \\"\\"\\" """)


def manifest(package: Path) -> object:
    """package.xml, for us and for colcon."""
    insist_on_small_files(package)
    return read_manifest(package)


def settings_of_setup(package: Path) -> object:
    """setup.cfg."""
    insist_on_small_files(package)
    return setup_cfg_problems(package / "setup.cfg", "chatter")


def python(package: Path) -> object:
    """A module, as it is read for its mistakes, its imports and its digest."""
    file = package / "chatter/talker.py"
    with suppress(code.NotPython):
        tree = code.parse(file)
        return code.read_setup(tree), [*code.imports(tree)]
    return digest_of_file(file)


def diagnosed(package: Path) -> object:
    """The text of a diagnosis, as the judge reads it."""
    text = documents.text_of(package / "diagnosis.yaml")
    with suppress(diagnosis.Unreadable):
        return diagnosis.read(text)
    return None


def picture(package: Path) -> object:
    """A picture."""
    return look_at(package, PictureContract.model_construct(path="a.png"))


def unpacked(package: Path) -> object:
    """What was handed in as one file."""
    room = Path(tempfile.mkdtemp(dir=package))
    try:
        with suppress(HandInRefused):
            return package_in(package / "handed-in", "chatter", room)
        return None
    finally:
        shutil.rmtree(room, ignore_errors=True)


def png_with(rows: bytes) -> bytes:
    """A picture whose rows are these bytes, 4000 pixels wide; some have an honest head."""
    rng = random.Random(rows[:50])
    colour, depth = rng.choice([(0, 1), (0, 4), (0, 8), (2, 8), (3, 2), (6, 8), (6, 16), (2, 16)])
    size = rng.choice([(4000, 5000), (1, 20_000_000), (20_000_000, 1), (3, 6_000_000), (9, 9)])
    head = head_of(*size, depth, colour, interlace=rng.choice([0, 1]))
    packer = zlib.compressobj(1)
    body = b"".join(packer.compress(rows) for _ in range(rng.choice([1, 3, 40]))) + packer.flush()
    cut = rng.choice([1, 7, 100, 1_000_000])
    pieces = [body[at : at + cut] for at in range(0, min(len(body), cut * 50_000), cut)]
    images = ((b"IDAT", each) for each in pieces)
    return png_of(head, (b"PLTE", b"abc"), *images, (b"IEND", b""))


def archive_of(text: bytes) -> bytes:
    """A zip or a tar of the solution, with the text in its middle, or as a file of it."""
    rng, out = random.Random(text[:50]), io.BytesIO()
    if rng.random() < 0.5:
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as packed:
            packed.write(SOLUTION / "package.xml", "chatter/package.xml")
            packed.writestr("chatter/more.py", text)
    else:
        mode = rng.choice(["w", "w:gz", "w:xz", "w:bz2"])
        with tarfile.open(fileobj=out, mode=mode) as packed_tar:  # type: ignore[call-overload]
            packed_tar.add(SOLUTION, "chatter")
    made = out.getvalue()
    at = rng.randrange(len(made))
    return made if rng.random() < 0.3 else made[:at] + text[:300] + made[at:]


READERS = (
    Reader(
        "package.xml",
        "package.xml",
        LARGEST_BYTES["package.xml"],
        XML,
        manifest,
        (SOLUTION / "package.xml").read_bytes(),
    ),
    Reader(
        "setup.cfg",
        "setup.cfg",
        LARGEST_BYTES["setup.cfg"],
        CFG,
        settings_of_setup,
        (SOLUTION / "setup.cfg").read_bytes(),
    ),
    Reader(
        "colcon.pkg",
        "colcon.pkg",
        LARGEST_BYTES["colcon.pkg"],
        YAML,
        lambda package: said_in_child(package / "colcon.pkg", Bookmark()),
    ),
    Reader(
        "Python, setup.py too",
        "chatter/talker.py",
        code.LARGEST_BYTES,
        PYTHON,
        python,
        (SOLUTION / "setup.py").read_bytes(),
    ),
    Reader(
        "Python, for its fingerprint",
        "chatter/talker.py",
        500_000,
        PYTHON,
        fingerprint,
        (SOLUTION / "chatter/talker.py").read_bytes(),
    ),
    Reader(
        "PNG",
        "a.png",
        50_000_000,
        words("a b ~ \x00 \x01 \x02 \x03 \x04 \x05"),
        picture,
        wrapped=png_with,
    ),
    Reader("a diagnosis (judge)", "diagnosis.yaml", documents.LARGEST_BYTES, YAML, diagnosed),
    Reader(
        "zip and tar",
        "handed-in",
        1_000_000,
        words("PK\x03\x04 PK\x01\x02 \x00 \x7f a ustar"),
        unpacked,
        wrapped=archive_of,
    ),
)


# --- measuring ---------------------------------------------------------------------------------


def measured(reader: Reader, package: Path, bookmark: Bookmark) -> str:
    """In the child: processor seconds, and how much its address space grew."""
    bookmark.put(reader.file)
    before_bytes, began_s = bounded.peak_bytes(), time.process_time()
    with suppress(RoslingsError):
        reader.read(package)
    seconds = time.process_time() - began_s
    return json.dumps([seconds, bounded.peak_bytes() - before_bytes])


def tried(reader: Reader, package: Path, content: bytes, worst: Worst) -> float:
    """One file; how long it took."""
    (package / reader.file).write_bytes(content)
    worst.files += 1
    try:
        told = read_in_child(lambda bookmark: measured(reader, package, bookmark))
        seconds, memory_bytes = json.loads(told)
    except ReaderEnded as ended:
        worst.ended[ended.met or ended.words] += 1
        seconds, memory_bytes = (20.0, 0) if ended.met == "time" else (0.0, 0)
    if seconds > worst.seconds:
        worst.seconds, worst.by_seconds = seconds, content
    worst.memory_bytes = max(worst.memory_bytes, memory_bytes)
    return float(seconds)


def fuzzed(reader: Reader, for_s: float) -> Worst:
    """Its worst file of so many seconds."""
    worst, until_s = Worst(), time.monotonic() + for_s
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder) / "chatter"
        shutil.copytree(SOLUTION, package)
        while time.monotonic() < until_s:
            _from_anew(reader, package, worst, until_s)
    return worst


def _from_anew(reader: Reader, package: Path, worst: Worst, until_s: float) -> None:
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        database=None,
        verbosity=Verbosity.quiet,
        suppress_health_check=[*HealthCheck],
        phases=[Phase.generate, Phase.target],
    )
    @given(contents(reader))
    def one(content: bytes) -> None:
        if time.monotonic() < until_s:
            target(tried(reader, package, content, worst))

    one()


def main(for_s: float, keeps: str = "") -> None:
    """Print the table; `keeps` is a folder for the worst file of each reader."""
    print(f"{platform.platform()}, Python {platform.python_version()}, {for_s:.0f} s")
    print("| reader | bound | files | worst CPU s | worst MB | bound met |")
    print("| --- | --- | --- | --- | --- | --- |")
    for reader in READERS:
        worst = fuzzed(reader, for_s / len(READERS))
        met = ", ".join(f"{count} {how}" for how, count in worst.ended.items()) or "-"
        bound = f"{reader.most_bytes / 1000:,.0f} kB"
        cost = f"{worst.seconds:.2f} | {worst.memory_bytes / MB:.0f}"
        print(f"| {reader.name} | {bound} | {worst.files} | {cost} | {met} |", flush=True)
        if keeps:
            (Path(keeps) / reader.file.replace("/", "_")).write_bytes(worst.by_seconds)


if __name__ == "__main__":
    main(float(sys.argv[1]), *sys.argv[2:3])
