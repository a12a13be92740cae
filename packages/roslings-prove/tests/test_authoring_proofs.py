"""Kept proofs: what makes one stale, which are due, and what does not fit is found."""

from __future__ import annotations

import lzma
import random
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, root
from roslings.course.files import read_tree
from roslings.workspace import normal
from roslings.workspace.normal import digest_of, digest_of_file
from roslings_launcher.seeds import other_pythons
from roslings_prove.proofs.archives import (
    ARCHIVES,
    LARGEST_BYTES,
    MOST_UNPACKED_BYTES,
    Archives,
    ArchiveTooLarge,
    packed,
)
from roslings_prove.proofs.closure import Modules, ModuleTree
from roslings_prove.proofs.digests import BUILT_TYPES, MeasuringCode, card_digest, measuring
from roslings_prove.proofs.due import AT_EACH_LANDING, PART, Proofs
from roslings_prove.proofs.judging import judge_kept
from roslings_prove.proofs.kept import (
    Folder,
    KeptProof,
    content_of,
    kept_here,
    name_in,
)
from roslings_prove.proofs.record import ProofRecorder
from roslings_prove.prove import Proof, packages_of
from sources import code_of, sources

LABS = {lab.name: lab for lab in all_labs()}


# --- the normal form of Python -----------------------------------------------------------------

AS_IT_WAS = '''
"""What it is for."""

import math


def double(number: float) -> float:
    """Twice as much."""
    return 2 * number  # as often as asked
'''


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"""What it is for."""\n', ""),
        ("Twice as much.", "As much as two."),
        ("  # as often as asked", ""),
        ("\n\n\n", "\n# a line of its own\n\n"),
        ("2 * number", "(2 * number)"),
    ],
)
def test_how_it_is_written_does_not_count(old: str, new: str, tmp_path: Path) -> None:
    """Comments, docstrings, blanks and brackets leave no trace."""
    assert old in AS_IT_WAS
    assert _digest(AS_IT_WAS, tmp_path) == _digest(AS_IT_WAS.replace(old, new), tmp_path)


@pytest.mark.parametrize(
    ("old", "new"),
    [("2 *", "3 *"), ("2 *", "2.0 *"), ("math", "cmath"), ("double", "twice"), ("-> float", "")],
)
def test_what_it_does_counts(old: str, new: str, tmp_path: Path) -> None:
    """A number, its type, an import, a name."""
    assert old in AS_IT_WAS
    assert _digest(AS_IT_WAS, tmp_path) != _digest(AS_IT_WAS.replace(old, new), tmp_path)


def test_files_that_are_no_python_count_by_their_bytes(tmp_path: Path) -> None:
    """And so does Python that cannot be read."""
    for name in ("setup.cfg", "broken.py"):
        file = tmp_path / name
        file.write_text("this = = that  # comment\n")
        before = digest_of_file(file)
        file.write_text("this = = that\n")
        assert digest_of_file(file) != before


def _digest(text: str, folder: Path) -> str:
    file = folder / "module.py"
    file.write_text(text, "utf-8")
    return digest_of_file(file)


SEVERAL = """
@decorated(1.5, *rest, named={"a": b"b", **more})
async def several(one, /, two: "text" = u"a", *, three=0x10, **four) -> None:
    match one:
        case [1, *_] | {"key": value} if value is not None:
            return f"{one!r:>{two}} {three:.3f}" f"{{}}" "ä\\U0001fae0"
    async with a as b, c: yield [x async for x in d if (y := x)][::-1]
    try: x = lambda: (yield); del x, y[1:2, ...]
    except (A, B) as error: raise C from error
    else: global z; z @= 1_000j
"""


def test_this_python_writes_what_every_other_writes(tmp_path: Path) -> None:
    """Words of nearly all kinds; the digest is the one that Python 3.10 to 3.13 make of them."""
    assert _digest(SEVERAL, tmp_path)[:16] == "bb22aa786eb37a8e"


def test_every_python_writes_the_same(tmp_path: Path) -> None:
    """All sources of the engine and of the labs, by each Python that is here."""
    script = tmp_path / "script.py"
    script.write_text(
        f"import sys\nsys.path.insert(0, {str(Path(normal.__file__).parent)!r})\n"
        "import normal\nfrom pathlib import Path\n"
        f"folders = {str(code_of('roslings') / 'experiment')!r}, {str(root() / 'labs')!r}\n"
        "files = [file for folder in folders for file in Path(folder).rglob('*.py')]\n"
        "print(normal.digest_of_files([(str(file), file) for file in files]))\n"
    )
    others = (python for minor in range(10, 15) for python in other_pythons(f"python3.{minor}"))
    pythons = [sys.executable, *filter(_runs, others)]
    said = {python: _output(python, script) for python in pythons}
    assert len(set(said.values())) == 1, said


def _runs(python: str) -> bool:
    return subprocess.run([python, "-c", ""], capture_output=True, check=False).returncode == 0


def _output(python: str, script: Path) -> str:
    words = [python, "-I", str(script)]
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


# --- what measures -----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def now() -> MeasuringCode:
    """Of the course as it is."""
    return measuring()


@pytest.fixture
def copy(tmp_path: Path) -> Iterator[Path]:
    """The engine, to change something in it."""
    ignored = shutil.ignore_patterns("__pycache__")
    for folder in ("packages", "graders"):
        shutil.copytree(root() / folder, tmp_path / folder, ignore=ignored)
    yield tmp_path


def tree(course: Path) -> ModuleTree:
    """The modules of a copy."""
    return ModuleTree(tuple(sources(course)), course / "graders")


def measured_by(course: Path, labs: tuple[Lab, ...] = tuple(LABS.values())) -> MeasuringCode:
    """What measures, where the engine is another."""
    return MeasuringCode(Modules(tree(course)), labs, root())


def edit(course: Path, module: str, old: str, new: str) -> None:
    """Change one place of a module."""
    file = tree(course).file_of(module)
    assert file
    text = file.read_text("utf-8")
    assert old in text, f"{module} has no {old!r} any more"
    file.write_text(text.replace(old, new), "utf-8")


def does(measuring: MeasuringCode, module: str) -> frozenset[str]:
    """What a module does, statement by statement."""
    return measuring.modules.does(measuring.modules.code(module))


def stale_labs(before: MeasuringCode, after: MeasuringCode) -> set[str]:
    """The labs whose own experiments are others."""
    return {name for name, lab in LABS.items() if before.experiments(lab) != after.experiments(lab)}


@pytest.mark.slow
def test_a_comment_makes_nothing_stale(copy: Path, now: MeasuringCode) -> None:
    """Nor does a docstring, or a blank line."""
    for module in now.shared:
        file = tree(copy).file_of(module)
        assert file
        file.write_text(f"{file.read_text('utf-8')}\n# a word more\n", "utf-8")
    after = measured_by(copy)
    assert after.core == now.core and not stale_labs(now, after)


@pytest.mark.slow
def test_a_module_that_moves_makes_nothing_stale(copy: Path, now: MeasuringCode) -> None:
    """Under another name in another room, with its imports brought up to date."""
    engine = copy / "packages/roslings/src/roslings"
    (engine / "seen/exits.py").rename(engine / "judge/endings.py")
    for file in copy.rglob("*.py"):
        text = file.read_text("utf-8")
        if "roslings.seen.exits" in text:
            file.write_text(text.replace("roslings.seen.exits", "roslings.judge.endings"), "utf-8")
    # The package that it lies in now is loaded with it: it holds nothing here.
    (engine / "judge/__init__.py").write_text("", "utf-8")
    after = measured_by(copy)
    assert does(now, "roslings.seen.exits") == does(after, "roslings.judge.endings")


@pytest.mark.slow
def test_another_thing_of_the_same_name_is_another(copy: Path, now: MeasuringCode) -> None:
    """`same` from elsewhere: no word of the module but its import is another."""
    before = does(now, "roslings.experiment.simulated")
    engine = copy / "packages/roslings/src/roslings"
    other = (engine / "seen/rates.py").read_text("utf-8")
    other = other.replace("STANDARD_ERRORS * statistics", "statistics")
    assert "def place_on_ticks" in other
    other = other.replace("sim_ns if passed else None", "sim_ns if passed else 0")
    (engine / "seen/rates2.py").write_text(other, "utf-8")
    edit(
        copy,
        "roslings.experiment.simulated",
        "from roslings.seen.rates ",
        "from roslings.seen.rates2 ",
    )
    assert does(measured_by(copy), "roslings.experiment.simulated") != before


@pytest.mark.slow
@pytest.mark.parametrize(
    "module",
    [
        "roslings.experiment.simulated",
        "roslings.probe.recorder",
        "roslings.arena.guardian",
        "roslings.workspace.build",
        "roslings.evidence",
        "ros2_on_pip.rates",
    ],
)
def test_a_change_of_what_all_share_is_one_of_the_core(
    module: str, copy: Path, now: MeasuringCode
) -> None:
    """Also in what is only started: the guardian is imported by nobody."""
    file = tree(copy).file_of(module)
    assert file
    file.write_text(f"{file.read_text('utf-8')}\nONE_MORE = 1\n", "utf-8")
    after = measured_by(copy)
    assert after.core != now.core and not stale_labs(now, after)


@pytest.mark.slow
def test_another_text_of_what_all_share_is_one_of_the_core(copy: Path, now: MeasuringCode) -> None:
    """What labs take of it by its name makes none of them stale: a fifth of all is due."""
    old, new = "class Process:\n", "class Process:\n    ONE_MORE = 1\n\n"
    edit(copy, "roslings.arena.process", old, new)
    after = measured_by(copy)
    assert after.core != now.core and not stale_labs(now, after)


@pytest.mark.slow
def test_message_types_that_are_built_anew_are_a_change_of_the_core(copy: Path) -> None:
    """Nodes of students load them."""
    shutil.copy(root() / "constraints.txt", copy)
    labs = tuple(LABS.values())
    before = MeasuringCode(Modules(tree(copy)), labs, copy)
    assert before.core
    built = next(copy.glob(BUILT_TYPES))
    built.write_bytes(built.read_bytes() + b"0")
    after = MeasuringCode(Modules(tree(copy)), labs, copy)
    assert after.core != before.core and not stale_labs(before, after)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "labs"),
    [
        ("roslings.capabilities.actions.act", {"actions"}),
        ("roslings.capabilities.serial.act", {"serial-bridge"}),
        ("roslings.capabilities.camera.act", {"pi-camera"}),
        ("graders.e_stop.player", {"e-stop"}),
        ("ros2_on_pip.launching.actions", {"distance-sensor", "bring-up", "wander"}),
        ("ros2_on_pip.stand_ins.rosbag2_py._reader", {"black-box"}),
        ("graders.black_box.act", {"black-box"}),
        ("graders.pi_camera.projector", {"pi-camera"}),
        ("graders.actions.floor", {"actions"}),
        ("graders.black_box.record", {"black-box"}),
    ],
)
def test_what_one_lab_is_measured_with_makes_that_lab_stale(
    module: str, labs: set[str], copy: Path, now: MeasuringCode
) -> None:
    """For certain, and no other; programs that are started by their path count, too."""
    file = tree(copy).file_of(module)
    assert file
    file.write_text(f"{file.read_text('utf-8')}\nONE_MORE = 1\n", "utf-8")
    after = measured_by(copy)
    assert stale_labs(now, after) == labs and after.core == now.core


@pytest.mark.slow
@pytest.mark.parametrize(
    "module",
    [
        "roslings.judge.demands",
        "roslings.capabilities.topics.demands",
        "graders.black_box.demands",
    ],
)
def test_what_only_judges_makes_nothing_stale(module: str, copy: Path, now: MeasuringCode) -> None:
    """It is tried on every kept proof, each time."""
    file = tree(copy).file_of(module)
    assert file
    file.write_text(f"{file.read_text('utf-8')}\nONE_MORE = 1\n", "utf-8")
    after = measured_by(copy)
    assert after.core == now.core and not stale_labs(now, after)


@pytest.mark.parametrize(
    ("old", "new", "is_stale"),
    [
        (
            "scene.say_sentences(listener, HEARD, count=12)",
            "scene.say_sentences(listener, HEARD, count=13)",
            True,
        ),
        (
            'TALKER, LISTENER = CARD.node("talker"), CARD.node("listener")',
            'LISTENER, TALKER = CARD.node("listener"), CARD.node("talker")',
            True,
        ),
        ("    talking.topic(CHATTER).must(count_up)", "    pass", False),
        ('"""The number goes up by one from message to message."""', '"""It counts."""', False),
    ],
)
def test_of_a_grader_the_experiments_count(
    old: str, new: str, is_stale: bool, tmp_path: Path, now: MeasuringCode
) -> None:
    """And what they use of its file; not its checks."""
    lab = LABS["topics"]
    text = lab.grader.read_text("utf-8")
    assert old in text
    other = replace(lab, grader=tmp_path / lab.grader.name)
    other.grader.write_text(text.replace(old, new), "utf-8")
    assert (now.experiments(other) != now.experiments(lab)) == is_stale


def test_of_a_card_all_counts_but_points_prose_and_comments(tmp_path: Path) -> None:
    """What only judges is tried each time."""
    lab = LABS["topics"]
    other = replace(lab, folder=tmp_path)
    card = tmp_path / "card.yaml"
    text = (lab.folder / "card.yaml").read_text("utf-8")
    card.write_text(f"# a word\n{text}".replace("rate: 14", "rate: 15"), "utf-8")
    assert card_digest(other) == card_digest(lab)
    rate = "        rate: {hz: 2"
    assert rate in text
    card.write_text(text.replace(rate, f"        numbers_within: 0.5\n{rate}"), "utf-8")
    assert card_digest(other) == card_digest(lab)
    card.write_text(f"{text}  - one more word\n", "utf-8")
    assert read_tree(card)["not_judged"][-1] == "one more word"
    assert card_digest(other) == card_digest(lab)
    card.write_text(text.replace(rate, f"        about: how the rover is\n{rate}"), "utf-8")
    assert card_digest(other) == card_digest(lab)
    card.write_text(text.replace("hz: 2", "hz: 3"), "utf-8")
    assert card_digest(other) != card_digest(lab)


# --- which are due -----------------------------------------------------------------------------


def all_kept(folder: Path, now: MeasuringCode, *, cores: dict[str, str] | None = None) -> Folder:
    """Lines for every package of one lab, as if it were measured now, or by these cores."""
    lab, kept = LABS["topics"], Folder(folder)
    for core in dict.fromkeys([*(cores or {}).values(), now.core]):
        kept.note_state(core)
    lines = {
        name: KeptProof(
            package=name,
            content=content_of(package),
            card=card_digest(lab),
            experiments=now.experiments(lab),
            core=(cores or {}).get(name, now.core),
            evidence="",
            checks={},
        )
        for package in packages_of(lab)
        for name in [name_in(lab, package)]
    }
    kept.write(lab, lines, list(lines))
    return kept


def why(folder: Folder, now: MeasuringCode, commit: str = "a") -> dict[str, str]:
    """Package of the lab to the rule by which it is due."""
    lab = LABS["topics"]
    due = Proofs([lab], folder, now).due(commit)
    return {name_in(lab, each.package): each.why for each in due}


def test_solutions_and_starters_are_always_due(tmp_path: Path, now: MeasuringCode) -> None:
    """And twenty more, which the commit draws: another commit, others."""
    folder = all_kept(tmp_path, now)
    found = {commit: why(folder, now, commit) for commit in "ab"}
    for each in found.values():
        assert each.pop("solution") == each.pop("starter") == "at each landing"
        assert list(each.values()) == ["drawn by the commit"] * AT_EACH_LANDING
    assert found["a"].keys() != found["b"].keys()
    assert why(folder, now, "a").keys() - {"solution", "starter"} == found["a"].keys()


def test_where_the_core_is_new_the_oldest_fifth_is_due(tmp_path: Path, now: MeasuringCode) -> None:
    """The oldest first; of one age, each core has others."""
    names = [name_in(LABS["topics"], package) for package in packages_of(LABS["topics"])]
    old = names[5:9]
    folder = all_kept(tmp_path, now, cores=dict.fromkeys(old, "long ago"))
    drawn = {}
    for core in ("one", "two"):
        other = replace(now, labs=now.labs)
        other.__dict__["core"] = core
        found = why(folder, other)
        drawn[core] = {name for name, rule in found.items() if rule == "what measures is another"}
        assert set(old) <= drawn[core] | {"solution", "starter"}
        fifth = -(-len(names) // PART)
        assert fifth - 2 <= len(drawn[core]) <= fifth
    assert drawn["one"] != drawn["two"]


@pytest.mark.parametrize("part", ["content", "card", "experiments"])
def test_what_is_stale_is_due(part: str, tmp_path: Path, now: MeasuringCode) -> None:
    """For certain, and it is said what is another."""
    lab, folder = LABS["topics"], all_kept(tmp_path, now)
    lines = folder.lines(lab)
    name = "mutant rate_1_hz" if "mutant rate_1_hz" in lines else sorted(lines)[0]
    lines[name] = lines[name].model_copy(update={part: "of another time"})
    folder.write(lab, lines, list(lines))
    words = {"content": "package"}.get(part, part)
    assert why(folder, now)[name] == f"another {words}"


def test_what_was_never_measured_is_due(tmp_path: Path, now: MeasuringCode) -> None:
    """Each mutant that has no line."""
    found = why(Folder(tmp_path), now)
    assert len(found) == len(packages_of(LABS["topics"]))
    assert set(found.values()) == {"it was never measured"}


# --- what is kept in this course ---------------------------------------------------------------


@pytest.mark.parametrize("lab", LABS.values(), ids=LABS)
def test_what_is_kept_shows_what_it_must(lab: Lab) -> None:
    """Every line of a lab with its evidence, judged by today's grader."""
    folder = kept_here()
    wrong = [proof.line for proof in judge_kept(lab, folder) if not proof.holds]
    assert not wrong, "\n".join(wrong)
    assert folder.lines(lab), "nothing is kept: ./roslings prove --record"


def test_what_is_kept_is_small_and_names_no_machine() -> None:
    """At most ten megabytes, no file above one."""
    folder = kept_here()
    sizes = [file.stat().st_size for file in folder.path.rglob("*") if file.is_file()]
    assert sum(sizes) <= 10_000_000 and max(sizes) <= 1_000_000
    assert folder.bytes == sum(sizes)


# --- sabotage ----------------------------------------------------------------------------------


@pytest.fixture
def sabotaged(tmp_path: Path) -> Folder:
    """The kept proofs of one lab, to be spoiled."""
    lab, here = LABS["nodes"], kept_here()
    shutil.copytree(here.path / lab.name, tmp_path / lab.name)
    shutil.copy(here.path / f"{lab.name}.jsonl", tmp_path)
    for name in ("measuring.jsonl", f"{lab.name}.kills.json"):
        shutil.copy(here.path / name, tmp_path)
    return Folder(tmp_path)


def wrong_ones(folder: Folder) -> dict[str, str]:
    """What the gate says of them."""
    found: list[Proof] = [each for each in judge_kept(LABS["nodes"], folder) if not each.holds]
    return {each.about: each.problem for each in found}


def wrong_packages(folder: Folder) -> dict[str, str]:
    """The same by package, as lines call it."""
    found = (each for each in judge_kept(LABS["nodes"], folder) if not each.holds)
    return {each.package.removeprefix("nodes: "): each.problem for each in found}


ONE, OTHER = [name for name in kept_here().lines(LABS["nodes"]) if name.startswith("mutant ")][:2]
"""Two of those that are kept."""


def spoil(folder: Folder, name: str, **changes: object) -> None:
    """Change a line."""
    lab = LABS["nodes"]
    lines = folder.lines(lab)
    lines[name] = lines[name].model_copy(update=changes)
    folder.write(lab, lines, list(lines))


def evidence(folder: Folder, name: str) -> bytes:
    """What is kept of a package."""
    found = folder.archives(LABS["nodes"]).evidence(name)
    assert found
    return found


def pack_anew(folder: Folder, name: str, members: Mapping[str, bytes | None]) -> Path:
    """Put these into the archive of a package, or take them out; no line says another word."""
    archives = folder.archives(LABS["nodes"])
    file = archives.file(name)
    there = {**archives.members(file), **members}
    file.write_bytes(packed({each: content for each, content in there.items() if content}))
    return file


def test_evidence_of_another_mutant_is_found(sabotaged: Folder) -> None:
    """Both are whole, and their lines tell of them: what they carry does not fit."""
    one, other = evidence(sabotaged, ONE), evidence(sabotaged, OTHER)
    pack_anew(sabotaged, ONE, {ONE: other})
    pack_anew(sabotaged, OTHER, {OTHER: one})
    lines = sabotaged.lines(LABS["nodes"])
    spoil(sabotaged, ONE, evidence=lines[OTHER].evidence)
    spoil(sabotaged, OTHER, evidence=lines[ONE].evidence)
    found = wrong_ones(sabotaged)
    assert len(found) == 2 and all("another package" in each for each in found.values())


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"evidence": "0" * 64}, "not the one that was judged"),
        ({"core": "0" * 64}, "no line of measuring.jsonl"),
        ({"content": "0" * 64}, "another package"),
        ({"checks": {"runs": "pass 100"}}, "another verdict"),
    ],
)
def test_a_line_that_does_not_fit_its_files_is_found(
    changes: dict[str, object], said: str, sabotaged: Folder
) -> None:
    """Whatever of it was changed."""
    spoil(sabotaged, ONE, **changes)
    ((_, problem),) = wrong_ones(sabotaged).items()
    assert said in problem


def test_a_changed_byte_of_evidence_is_found(sabotaged: Folder) -> None:
    """Packed again, all else of the archive is as it was: one package is wrong."""
    file = pack_anew(sabotaged, ONE, {ONE: evidence(sabotaged, ONE).replace(b"1", b"2", 1)})
    ((package, problem),) = wrong_packages(sabotaged).items()
    assert package == ONE
    assert f"its evidence in nodes/{file.name} is not the one that was judged" in problem


def test_evidence_that_is_none_is_found(sabotaged: Folder) -> None:
    """Also where its line tells of it."""
    file = pack_anew(sabotaged, ONE, {ONE: b"no evidence"})
    spoil(sabotaged, ONE, evidence=digest_of(b"no evidence"))
    ((_, problem),) = wrong_ones(sabotaged).items()
    assert f"its evidence in nodes/{file.name} cannot be read" in problem


def test_renamed_evidence_is_found(sabotaged: Folder) -> None:
    """The line has none, and no line tells of the other name. Each is named with its file."""
    file = pack_anew(sabotaged, ONE, {ONE: None, "stranger": evidence(sabotaged, ONE)})
    found = wrong_ones(sabotaged)
    assert "no line tells of" in found.pop(f"nodes: stranger in {file.name}")
    ((about, problem),) = found.items()
    assert ONE.removeprefix("mutant ") in about and f"is not there, in nodes/{file.name}" in problem


def test_evidence_in_an_archive_of_others_is_found(sabotaged: Folder) -> None:
    """The name of a package says where it is."""
    archives = sabotaged.archives(LABS["nodes"])
    elsewhere = next(
        n for n in sabotaged.lines(LABS["nodes"]) if archives.file(n) != archives.file(ONE)
    )
    file = pack_anew(sabotaged, elsewhere, {ONE: evidence(sabotaged, ONE)})
    (found,) = wrong_ones(sabotaged)
    assert found == f"nodes: {ONE} in {file.name}"


def in_one_archive(folder: Folder) -> tuple[Path, set[str]]:
    """An archive, and the names of its packages."""
    archives = folder.archives(LABS["nodes"])
    file = archives.file(ONE)
    return file, set(archives.members(file))


def one_byte_changed(file: Path) -> None:
    """In the middle."""
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


def cut_short(file: Path) -> None:
    """Its last bytes are gone."""
    file.write_bytes(file.read_bytes()[:-50])


def too_large(file: Path) -> None:
    """By a byte."""
    file.write_bytes(file.read_bytes().ljust(LARGEST_BYTES + 1))


def too_large_unpacked(file: Path) -> None:
    """Of zeros, which take no room as long as they are packed."""
    file.write_bytes(lzma.compress(bytes(MOST_UNPACKED_BYTES + 1), preset=0))


def no_ordinary_file(file: Path) -> None:
    """A link out of the folder is not followed."""
    link = tarfile.TarInfo(ONE)
    link.type, link.linkname = tarfile.SYMTYPE, "/etc/passwd"
    with tarfile.open(file, "w:xz") as archive:
        archive.addfile(link)


def one_twice(file: Path) -> None:
    """Nobody could tell which of both counts."""
    with tarfile.open(file, "w:xz") as archive:
        for _ in range(2):
            archive.addfile(tarfile.TarInfo(ONE))


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (one_byte_changed, "cannot be read"),
        (cut_short, "has no end"),
        (too_large, "has more than 1,000,000 bytes"),
        (too_large_unpacked, "has no end, or unpacked more than 100,000,000 bytes"),
        (no_ordinary_file, "no ordinary file"),
        (one_twice, f"holds {ONE} twice"),
        (Path.unlink, "is not there"),
    ],
)
def test_an_archive_that_is_not_what_it_was_is_found(
    damage: Callable[[Path], None], said: str, sabotaged: Folder
) -> None:
    """All packages in it are named, each with the file; no other is wrong."""
    file, names = in_one_archive(sabotaged)
    damage(file)
    found = wrong_packages(sabotaged)
    assert found.keys() == names
    assert all(said in each and f"nodes/{file.name}" in each for each in found.values())


@pytest.mark.parametrize("name", ["8.tar.xz", "solution.evidence"])
def test_a_file_that_no_package_belongs_into_is_found(name: str, sabotaged: Folder) -> None:
    """A copy of an archive, or what an earlier course kept."""
    file, _ = in_one_archive(sabotaged)
    shutil.copy(file, file.with_name(name))
    assert list(wrong_ones(sabotaged)) == [f"nodes: {name}"]


# --- how evidence is packed --------------------------------------------------------------------


def test_the_same_evidence_makes_the_same_bytes(tmp_path: Path) -> None:
    """In whatever order it came; what one archive holds says nothing of the others."""
    names = [f"mutant {n}" for n in range(60)]
    for folder, order in (("one", names), ("other", names[::-1])):
        archives = Archives(tmp_path / folder)
        for name in order:
            archives.put(name, name.encode())
    one, other = (
        {file.name: file.read_bytes() for file in Archives(tmp_path / folder).files()}
        for folder in ("one", "other")
    )
    assert one == other and len(one) == ARCHIVES
    again = Archives(tmp_path / "one")
    assert [again.evidence(name) for name in names] == [name.encode() for name in names]


def test_one_package_recorded_anew_rewrites_one_file(sabotaged: Folder) -> None:
    """No line of another changes either: each tells of its own evidence."""
    before = {file: file.read_bytes() for file in sabotaged.archives(LABS["nodes"]).files()}
    sabotaged.archives(LABS["nodes"]).put(ONE, b"another")
    after = {file: file.read_bytes() for file in sabotaged.archives(LABS["nodes"]).files()}
    changed = [file for file in after if after[file] != before.get(file)]
    assert changed == [sabotaged.archives(LABS["nodes"]).file(ONE)]
    assert before.keys() == after.keys() and len(wrong_ones(sabotaged)) == 1


def test_evidence_that_makes_an_archive_too_large_is_refused(sabotaged: Folder) -> None:
    """Its file and its size are told, and all is as it was."""
    file, _ = in_one_archive(sabotaged)
    before = file.read_bytes()
    noise = random.Random(1).randbytes(LARGEST_BYTES)
    with pytest.raises(
        ArchiveTooLarge, match=rf"nodes/{file.name} would have 1,0\d\d,\d\d\d bytes"
    ):
        sabotaged.archives(LABS["nodes"]).put(ONE, noise)
    assert file.read_bytes() == before and not wrong_ones(sabotaged)


def test_who_is_ended_while_writing_leaves_what_was_there(
    sabotaged: Folder, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No half archive, and no other file beside it."""
    folder = sabotaged.archives(LABS["nodes"]).folder
    before = {file: file.read_bytes() for file in folder.iterdir()}

    def half(file: Path, content: bytes) -> None:
        with file.open("wb") as opened:
            opened.write(content[: len(content) // 2])
        raise KeyboardInterrupt

    with monkeypatch.context() as patched, pytest.raises(KeyboardInterrupt):
        patched.setattr(Path, "write_bytes", half)
        sabotaged.archives(LABS["nodes"]).put(ONE, b"another")
    assert {file: file.read_bytes() for file in folder.iterdir()} == before


def test_evidence_without_a_line_goes_with_the_next_line(sabotaged: Folder) -> None:
    """From archives of others, and files that are none."""
    lab = LABS["nodes"]
    file = pack_anew(sabotaged, ONE, {"stranger": b"strange"})
    (file.parent / "solution.evidence").write_bytes(b"old")
    lines = sabotaged.lines(lab)
    sabotaged.write(lab, lines, list(lines))
    assert not wrong_ones(sabotaged)
    sabotaged.write(lab, {}, list(lines))
    assert not sabotaged.archives(lab).files()


def test_a_line_whose_evidence_is_lost_is_measured_anew(
    sabotaged: Folder, now: MeasuringCode
) -> None:
    """`--record` mends what `--kept` finds: all other lines stay."""
    lab = LABS["nodes"]
    before = sabotaged.lines(lab)
    file, lost = in_one_archive(sabotaged)
    one_byte_changed(file)
    ProofRecorder(sabotaged, now).judge_anew([lab])
    assert sabotaged.lines(lab).keys() == before.keys() - lost
    stale = Proofs([lab], sabotaged, now).stale()
    never = {name_in(lab, e.package) for e in stale if e.stale == "it was never measured"}
    assert lost <= never
    assert not file.exists() and not wrong_ones(sabotaged)


def test_a_line_of_a_package_that_is_gone_is_found(sabotaged: Folder) -> None:
    """A mutant that was removed leaves no proof."""
    lab = LABS["nodes"]
    lines = sabotaged.lines(lab)
    gone = lines[ONE].model_copy(update={"package": "mutant never_heard_of"})
    sabotaged.write(lab, {**lines, gone.package: gone}, [*lines, gone.package])
    assert "it is gone" in " ".join(wrong_ones(sabotaged).values())
