"""Which package a path means."""

from __future__ import annotations

import shlex
import shutil
import tarfile
import zipfile
from pathlib import Path

import pytest
from hardship import Run

from roslings.workspace import errors as trouble
from roslings.workspace.packages import DEEPEST, MOST_FOLDERS, find_package


@pytest.mark.parametrize("path", [".", "..", "../..", "chatter", "resource", "figures"])
def test_a_package_is_found_from_within_and_from_above(package: Path, path: str) -> None:
    """The package itself, its parent, the workspace, and folders of the package mean it."""
    assert find_package(package / path, "chatter") == package


def test_a_linked_package_is_found_as_colcon_finds_it(package: Path, tmp_path: Path) -> None:
    """A package that lies elsewhere and is linked into src/ counts once."""
    elsewhere = shutil.move(package, tmp_path / "elsewhere")
    package.symlink_to(elsewhere)
    (package.parent / "again").symlink_to(elsewhere)
    assert find_package(package.parent, "chatter") == Path(elsewhere)


@pytest.mark.parametrize("name", ["build", "install", "log", ".hidden", "venv", "unseen", "deep"])
def test_copies_in_folders_that_colcon_ignores_do_not_count(package: Path, name: str) -> None:
    """Built folders, hidden ones, virtual environments and ignored ones hold no packages."""
    copy = package.parent / name / "chatter"
    if name == "deep":
        copy = package.parent.joinpath(*"d" * (DEEPEST + 1), "chatter")
    shutil.copytree(package, copy)
    (package.parent / "venv").mkdir(exist_ok=True)
    (package.parent / "venv" / "pyvenv.cfg").touch()
    (package.parent / "unseen").mkdir(exist_ok=True)
    (package.parent / "unseen" / "COLCON_IGNORE").touch()
    assert find_package(package.parent, "chatter") == package


def test_a_loop_of_links_ends(package: Path) -> None:
    """A link to a folder above itself is followed once."""
    (package.parent / "loop").symlink_to(package.parent)
    (package.parent / "dead").symlink_to("dead")
    assert find_package(package.parent, "chatter") == package


def test_two_packages_of_one_name_are_both_named(package: Path) -> None:
    """Nobody guesses which one is meant."""
    shutil.copytree(package, package.parent / "old")
    with pytest.raises(trouble.TwoPackages, match=r"src/chatter[\s\S]*src/old"):
        find_package(package.parent, "chatter")


def test_a_package_named_otherwise_is_named(package: Path) -> None:
    """The name that was found stands beside the one that was asked for."""
    xml = package / "package.xml"
    xml.write_text(
        xml.read_text().replace("<name>chatter<", "<!-- <name>chatter</name> -->\n<name> chater <")
    )
    with pytest.raises(trouble.NamedOtherwise, match=r"'chatter'.*\n.*'chater'"):
        find_package(package, "chatter")


def test_a_package_without_setup_py_is_told_so(package: Path) -> None:
    """A package for C++ is told what it is."""
    (package / "setup.py").rename(package / "CMakeLists.txt")
    with pytest.raises(trouble.NoSetupPy, match=r"C\+\+"):
        find_package(package, "chatter")


def test_a_folder_without_package_xml_is_no_package(package: Path) -> None:
    """With a setup.py in it the missing file is named, else the folder."""
    (package / "package.xml").unlink()
    with pytest.raises(trouble.NoPackageXml, match=r"chatter has no package\.xml"):
        find_package(package.parent.parent, "chatter")
    (package / "setup.py").unlink()
    with pytest.raises(trouble.NoPackage, match="roslings start"):
        find_package(package, "chatter")


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "AMENT_IGNORE"])
@pytest.mark.parametrize("at", ["chatter", "."])
def test_a_package_that_colcon_passes_by_is_told_so(package: Path, marker: str, at: str) -> None:
    """It is there, so nobody says that it is not; the file to delete is named."""
    (package.parent / at / marker).touch()
    for path in (package.parent, package.parent.parent):
        with pytest.raises(trouble.IgnoredByColcon, match=marker) as told:
            find_package(path, "chatter")
        assert f"rm {shlex.quote(str(package.parent / at / marker))}" in told.value.next_step


def test_a_package_means_itself_below_an_ignored_folder(package: Path) -> None:
    """What is built is a copy of the package alone."""
    (package.parent / "COLCON_IGNORE").touch()
    assert find_package(package, "chatter") == package


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("type: cmake\nname: other", "type 'cmake' and name 'other'"),
        ("type: ros.ament_python", "name None"),
        ("- a list", "cannot read it"),
        (": [", "cannot read it"),
        ("type: ros.ament_python\nname: chatter", None),
        ("hooks: []", None),
        ("", None),
    ],
)
def test_a_colcon_pkg_that_says_otherwise_is_told(
    package: Path, text: str, told: str | None
) -> None:
    """colcon believes it; one that says the same, or nothing of that, is no fault."""
    (package / "colcon.pkg").write_text(text)
    if told is None:
        assert find_package(package, "chatter") == package
    else:
        with pytest.raises(trouble.OtherwiseForColcon, match=told):
            find_package(package, "chatter")


def test_an_empty_folder_and_a_packed_one_are_named(tmp_path: Path) -> None:
    """What is there is said, not only what is not."""
    with pytest.raises(trouble.EmptyFolder, match="is empty"):
        find_package(tmp_path, "chatter")
    (tmp_path / "work.tar.gz").write_bytes(b"\x1f\x8b\x08")
    with pytest.raises(trouble.OnlyPacked, match=r"but a gz file: work\.tar\.gz"):
        find_package(tmp_path, "chatter")


def test_a_path_that_is_not_there_is_named(package: Path) -> None:
    """So is a link that leads nowhere, and a path no system would take."""
    (package / "dangling").symlink_to("nowhere")
    for path in ("chater", "dangling", "setup.py/x", "x" * 5000):
        with pytest.raises(trouble.NoSuchPath, match="Look at the spelling"):
            find_package(package / path, "chatter")


def test_a_file_is_no_folder(package: Path) -> None:
    """The student is told which folder to give."""
    with pytest.raises(trouble.NotAFolder, match=r"package\.xml"):
        find_package(package / "setup.py", "chatter")


def test_a_packed_package_is_to_be_unpacked(package: Path, tmp_path: Path) -> None:
    """Whatever the file is called."""
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as packed:
        packed.write(package / "package.xml")
    with tarfile.open(tmp_path / "work", "w:gz") as tar:
        tar.add(package / "package.xml")
    for name in ("a.zip", "work"):
        with pytest.raises(trouble.Archive, match="Unpack it"):
            find_package(tmp_path / name, "chatter")


def test_a_search_without_end_is_given_up(tmp_path: Path) -> None:
    """A home folder with everything in it."""
    for number in range(MOST_FOLDERS + 1):
        (tmp_path / str(number)).mkdir()
    with pytest.raises(trouble.TooManyFolders, match="as PATH"):
        find_package(tmp_path, "chatter")


def test_a_closed_folder_is_told(package: Path, without_rights: Run) -> None:
    """A folder that cannot be read is named; one beside the package does not matter."""
    closed = package.parent / "closed"
    closed.mkdir(mode=0)
    find = """
        import sys
        from pathlib import Path
        from roslings.workspace.packages import find_package
        try:
            print(find_package(Path(sys.argv[1]), "chatter").name)
        except Exception as error:
            print(type(error).__name__)
    """
    assert without_rights(find, closed) == "CannotRead"
    assert without_rights(find, closed / "further") == "CannotRead"
    assert without_rights(find, package.parent) == "chatter"
    closed.chmod(0o700)
