"""One build for packages of equal content, and for a lab's own that differ in modules alone."""

from __future__ import annotations

import os
import shutil
import threading
from contextlib import ExitStack
from pathlib import Path

import pytest

from few import few_labs
from roslings.arena import ArenaPlace, Installed, choose_isolation
from roslings.course import Lab, lab
from roslings.evidence import BuildSeen
from roslings.workspace import shared_build as building
from roslings.workspace.build_cache import modules_of, shared_setup_of
from roslings.workspace.shared_build import shared_build

TOPICS = lab("topics")
LONGEST_BUILD_S = 180.0


def built_in(
    person: Path, source: Path, builds: Path | None = None, from_cache: bool = False
) -> tuple[BuildSeen, Installed | None]:
    """Build `source` with a home and a room of a person's own."""
    home, room = person / "home", person / "room"
    for folder in (home, room):
        folder.mkdir(parents=True, exist_ok=True)
    place = ArenaPlace("domain", home, person, choose_isolation().sandbox)
    return shared_build(
        builds or person / "builds", source, room, place, LONGEST_BUILD_S, from_cache
    )


def test_one_build_a_processor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The next one waits for its turn, but not for ever: those before it may be endless."""
    entered = threading.Event()

    def enter() -> None:
        with building._turn(tmp_path):
            entered.set()

    with ExitStack() as others:
        for _ in os.sched_getaffinity(0):
            others.enter_context(building._turn(tmp_path))
        monkeypatch.setattr(building, "WAITS_FOR_ITS_TURN_S", 0.0)
        enter()
        assert entered.is_set()
        entered.clear()
        monkeypatch.setattr(building, "WAITS_FOR_ITS_TURN_S", 1e6)
        waiting = threading.Thread(target=enter)
        waiting.start()
        assert not entered.wait(1.0)
    waiting.join()
    assert entered.is_set()


def test_equal_packages_share_a_build(tmp_path: Path) -> None:
    """The second is there at once, with a home of its own; another content is built anew."""
    builds = tmp_path / "builds"
    found = []
    for name in ("anna", "ben", "cleo"):
        source = tmp_path / name / "chatter"
        shutil.copytree(TOPICS.solution, source)
        if name == "cleo":
            (source / "setup.py").write_text("raise SystemExit('no')")
        found.append(built_in(tmp_path / name, source, builds))
    (anna, first), (ben, second), (cleo, third) = found
    assert anna.succeeded and ben.succeeded and not cleo.succeeded
    assert first and second and third is None
    assert first.programs == second.programs
    assert (ben.seconds, ben.executables) == (0.0, anna.executables)
    assert second.environment["HOME"] == str(tmp_path / "ben" / "home")
    assert first.environment["HOME"] == str(tmp_path / "anna" / "home")


def tree(folder: Path, built: Path) -> dict[str, tuple[int, bytes]]:
    """Each file below `folder`: its rights and content, with `built` left out of it.

    Bytecode is left out where it is made at the first import; it tells when it was made.
    """
    files = [path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc"]
    return {
        str(path.relative_to(folder)): (
            path.stat().st_mode,
            path.read_bytes().replace(os.fsencode(built), b""),
        )
        for path in files
    }


def compiled(folder: Path) -> set[str]:
    """The modules that have bytecode."""
    return {path.name.partition(".")[0] for path in folder.rglob("*.pyc")}


@few_labs("one")
def test_kin_is_installed_as_colcon_does(one: Lab, tmp_path: Path) -> None:
    """Another module, no colcon: each file is what colcon would have installed."""
    package = one.card.package
    first = tmp_path / "first" / package
    shutil.copytree(one.solution, first)
    second = tmp_path / "second" / package
    shutil.copytree(one.solution, second)
    module = next(iter(sorted(modules_of(second))))
    (second / module).write_text("def main():\n    print('another')\n")
    built = {
        folder: built_in(tmp_path / folder, source, from_cache=from_cache)
        for folder, source, from_cache in (("alone", second, False), ("eldest", first, True))
    }
    built["kin"] = built_in(tmp_path / "eldest", second, from_cache=True)
    (alone, by_colcon), (_, by_eldest), (seen, by_cache) = built.values()
    assert by_colcon and by_eldest and by_cache and seen.seconds == 0.0
    assert (seen.succeeded, seen.executables) == (True, alone.executables)
    assert tree(by_cache.folder, by_cache.folder) == tree(by_colcon.folder, by_colcon.folder)
    assert tree(by_cache.folder, by_cache.folder) != tree(by_eldest.folder, by_eldest.folder)
    assert compiled(by_cache.folder) >= {path.stem for path in modules_of(second)}
    assert str(by_eldest.folder) not in str(by_cache)
    paths = by_cache.environment["AMENT_PREFIX_PATH"].split(os.pathsep)
    assert str(by_cache.folder / package) in paths


@pytest.mark.parametrize(
    "file", ["setup.py", "chatter/__init__.py", "package.xml", "chatter/more.py"]
)
def test_who_else_differs_is_no_kin(file: str, tmp_path: Path) -> None:
    """Whatever may change how a package is built has it built."""
    first = tmp_path / "first" / "chatter"
    shutil.copytree(TOPICS.solution, first)
    second = tmp_path / "second" / "chatter"
    shutil.copytree(TOPICS.solution, second)
    with (second / file).open("a") as end:
        end.write("\n")
    with shared_setup_of(tmp_path, first, "") as family:
        family.remember(first)
        assert family.eldest == first
    with shared_setup_of(tmp_path, second, "") as other:
        assert other.eldest is None


def test_a_module_that_is_no_python_is_built(tmp_path: Path) -> None:
    """Its build says so; and nobody is installed like it."""
    package = tmp_path / "chatter"
    shutil.copytree(TOPICS.solution, package)
    assert modules_of(package) == {Path("chatter/talker.py"), Path("chatter/listener.py")}
    (package / "chatter" / "talker.py").write_text("def\n")
    assert modules_of(package) == frozenset()
