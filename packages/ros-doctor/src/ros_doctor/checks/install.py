"""ROS itself: is Jazzy here, is it the right one, can this Python use it, can colcon build."""

from __future__ import annotations

import datetime
import re
from pathlib import Path

from ros_doctor.finding import (
    Finding,
    Step,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import Machine, exists, read_text
from ros_doctor.mends import (
    APT_SOURCE,
    install_package,
    install_program,
    install_ros,
    new_terminal,
    quoted,
    rebuild_environment,
    shell_name,
    source,
    unset,
)
from ros_doctor.openpgp import NotAKey, key_ends
from ros_doctor.registry import check
from ros_doctor.ros import DISTRO, Ros, find_ros, has_library
from ros_doctor.surroundings import release

KEYRING = "/usr/share/keyrings"
NO_COURSE = "there is no folder of the roslings course here"
BESIDE_ROS = ".venv-apt"  # the course's environment where a ROS is sourced
SETUPTOOLS_LIMIT = 80  # colcon-core#696: 80 dropped what `--symlink-install` calls


@check(
    "ros-found",
    "ROS 2 Jazzy is installed, and this terminal knows it",
    looks_at="ROS_DISTRO, /opt/ros/jazzy, the course's environment .venv",
    lesson="01-install#source",
    rows=(1,),
)
def ros_found(machine: Machine) -> Finding:
    """'ros2: command not found', or 'ModuleNotFoundError: No module named rclpy'."""
    ros = find_ros(machine)
    if ros is None:
        return fault("There is no ROS 2 Jazzy on this machine.", *install_ros(machine))
    if ros.ready:
        return ok(f"ROS 2 Jazzy ({ros.kind}) in {ros.prefix}.")
    if ros.kind == "wheels":
        return advice(
            "ROS 2 Jazzy is in the course's environment. ./roslings finds it by itself, but"
            " ros2 and python3 in this terminal do not."
            if machine.has_course
            else f"ROS 2 Jazzy is in {ros.prefix}, and this terminal does not know it.",
            *source(machine, ros),
        )
    return fault(
        "ROS 2 Jazzy is installed, but this terminal does not know it.", *source(machine, ros)
    )


@check(
    "one-ros",
    "Only one ROS is in this terminal, and it is Jazzy",
    looks_at="ROS_DISTRO and the folders of /opt/ros in the path variables",
    lesson="01-install#source",
    rows=(2,),
)
def one_ros(machine: Machine) -> Finding:
    """Strange errors: 'undefined symbol', or messages whose types do not match."""
    from ros_doctor.checks.shell import startup_lines

    found = _distributions(machine)
    other = sorted(found - {DISTRO})
    if not other:
        return ok("Jazzy alone." if found else "No other ROS.")
    lines = [line for line in startup_lines(machine) if any(name in line.text for name in other)]
    where = tuple(say(f"Delete line {one.number} of {one.file}:  {one.text}") for one in lines)
    names = " and ".join(sorted(found))
    setup = do(f"source /opt/ros/{DISTRO}/setup.{shell_name(machine)}", "There, source Jazzy:")
    if DISTRO not in found:
        return fault(
            f"This terminal uses {names}. The course is for Jazzy.", *where, new_terminal()
        )
    return fault(f"This terminal mixes {names}.", *where, new_terminal(), setup)


def _distributions(machine: Machine) -> set[str]:
    names = {machine.env["ROS_DISTRO"]} if machine.env.get("ROS_DISTRO") else set()
    for variable in ("AMENT_PREFIX_PATH", "PATH", "PYTHONPATH", "LD_LIBRARY_PATH"):
        names |= set(re.findall(r"/opt/ros/(\w+)", machine.env.get(variable, "")))
    return names


@check(
    "apt-key",
    "The key of ROS's apt packages is valid",
    looks_at="the last day of the key in /usr/share/keyrings",
    lesson="01-install#apt",
    rows=(4,),
)
def apt_key(machine: Machine) -> Finding:
    """apt update says: 'EXPKEYSIG F42ED6FBAB17C654 Open Robotics'."""
    files = sorted(machine.path(KEYRING).glob("ros*-archive-keyring.gpg"))
    if not files:
        return not_applicable("apt knows no ROS on this machine")
    ends = {path: _ends(path) for path in files}
    good = [path for path, end in ends.items() if end is None or end > machine.now]
    if good:
        return ok(f"{good[-1].name} is valid.")
    last = max(end or 0.0 for end in ends.values())
    day = datetime.datetime.fromtimestamp(last, datetime.timezone.utc).date()
    old = " ".join(f"{KEYRING}/{path.name}" for path in files)
    return fault(
        f"The key that signs ROS's packages ended on {day}." if last else "The key is unreadable.",
        do(f"sudo rm -f /etc/apt/sources.list.d/ros2.list \\\n  {old}", "Remove the old key:"),
        *APT_SOURCE,
    )


def _ends(path: Path) -> float | None:
    try:
        return key_ends(path.read_bytes())
    except (NotAKey, OSError):
        return 0.0


@check(
    "apt-release",
    "apt looks for packages of this Ubuntu",
    looks_at="/etc/apt/sources.list.d/ros2*, and the codename in /etc/os-release",
    lesson="01-install#apt",
    rows=(3,),
)
def apt_release(machine: Machine) -> Finding:
    """'Unable to locate package ros-jazzy-desktop', or 'unmet dependencies'."""
    here = release(machine).codename
    folder = machine.path("/etc/apt/sources.list.d")
    lists = {path: _suites(read_text(path)) for path in sorted(folder.glob("ros2*"))}
    suites = {suite for found in lists.values() for suite in found}
    if not suites:
        return not_applicable("apt knows no ROS on this machine")
    if here in suites:
        return ok(f"apt looks for ROS packages of {here}.")
    files = " ".join(f"/etc/apt/sources.list.d/{path.name}" for path in lists)
    asks = f"apt looks for ROS packages of {', '.join(sorted(suites))}. This system is {here}."
    if not release(machine).has_jazzy_in_apt:
        return warning(asks, do(f"sudo rm {files}", "Remove that list:"), *install_ros(machine))
    return fault(asks, do(f"sudo rm {files}", "Remove that list:"), *APT_SOURCE)


def _suites(text: str) -> set[str]:
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    plain = "\n".join(lines)
    return set(re.findall(r"ros2?/ubuntu/?\s+(\w+)", plain)) | {
        suite for line in re.findall(r"^Suites:(.*)$", plain, re.M) for suite in line.split()
    }


@check(
    "rclpy-python",
    "Python is the one that rclpy was built for",
    looks_at="the compiled file of rclpy, and the version of python3",
    lesson="01-install#python",
    rows=(5,),
    needs=("ros-found",),
)
def rclpy_python(machine: Machine) -> Finding:
    """'ModuleNotFoundError: No module named rclpy._rclpy_pybind11'."""
    ros = find_ros(machine)
    if ros is None:
        return not_applicable("ROS 2 Jazzy is not installed")
    built = _built_for(ros.rclpy)
    if not built:
        return fault(
            "rclpy has no compiled part: the installation is broken.", *_again(machine, ros)
        )
    used = _python_version(machine, ros)
    if used is None:
        return unknown(f"{ros.python} does not say its version.")
    if used in built:
        return ok(f"rclpy and python3 are both {_dotted(used)}.")
    return fault(
        f"rclpy was built for Python {_dotted(sorted(built)[0])}, but python3 is {_dotted(used)}.",
        *_right_python(machine, ros),
    )


def _built_for(rclpy: Path) -> set[tuple[int, int]]:
    names = [path.name for path in rclpy.glob("_rclpy_pybind11.*")]
    found = [re.search(r"cpython-3(\d+)", name) for name in names]
    return {(3, int(match.group(1))) for match in found if match}


def _python_version(machine: Machine, ros: Ros) -> tuple[int, int] | None:
    """Return the version from the environment's note, or by asking the program itself."""
    note = re.search(r"^version\w* *= *3\.(\d+)", read_text(ros.prefix / "pyvenv.cfg"), re.M)
    if note:
        return 3, int(note.group(1))
    ran = machine.run("python3", "-S", "-c", "import sys; print(*sys.version_info[:2])")
    words = ran.output.split() if ran and ran.code == 0 else []
    return (int(words[0]), int(words[1])) if len(words) == 2 else None


def _dotted(version: tuple[int, int]) -> str:
    return f"{version[0]}.{version[1]}"


def _again(machine: Machine, ros: Ros) -> tuple[Step, ...]:
    if ros.kind == "wheels":
        return rebuild_environment(machine)
    return (do("sudo apt install --reinstall ros-jazzy-rclpy", "Install it again:"),)


def _right_python(machine: Machine, ros: Ros) -> tuple[Step, ...]:
    if ros.kind == "wheels":
        return rebuild_environment(machine)
    return (
        say("Ubuntu's own Python is the right one. See which one answers in this terminal:"),
        do("type -a python3"),
        say("Leave the environment that comes first (deactivate, or remove it from PATH)."),
    )


@check(
    "middleware",
    "The middleware of ROS is installed",
    looks_at="the file librmw_fastrtps_cpp.so, or the one that RMW_IMPLEMENTATION names",
    lesson="01-install#middleware",
    rows=(20,),
    needs=("ros-found",),
)
def middleware(machine: Machine) -> Finding:
    """'failed to load shared library librmw_...', or the node ends with exit code 102."""
    wanted = machine.env.get("RMW_IMPLEMENTATION", "")
    name = wanted or "rmw_fastrtps_cpp"
    if find_ros(machine) is None:
        return not_applicable("ROS 2 Jazzy is not installed")
    if has_library(machine, name):
        return ok(f"{name} is installed.")
    dashed = name.replace("_", "-")
    if not wanted:
        return fault(
            f"The middleware {name} is missing.",
            *install_package(machine, f"ros-jazzy-{dashed}", "ros-rmw-fastrtps-cpp==8.4.3"),
        )
    return fault(
        f"RMW_IMPLEMENTATION is {wanted}, but that middleware is not installed.",
        say("Use the standard one. All computers of one robot must have the same."),
        *unset(machine, "RMW_IMPLEMENTATION"),
    )


@check(
    "conda",
    "conda is not active",
    looks_at="CONDA_PREFIX and PATH",
    lesson="01-install#python",
    rows=(6,),
)
def conda(machine: Machine) -> Finding:
    """colcon build fails: 'No module named catkin_pkg', or rclpy is not found."""
    prefix = machine.env.get("CONDA_PREFIX", "")
    python3 = machine.which("python3")
    inside = python3 is not None and any("conda" in part for part in python3.parts)
    if not prefix and not inside:
        return ok("No conda in this terminal.")
    return fault(
        f"conda is active, and python3 is {python3}." if inside else "conda is active.",
        do("conda deactivate", "Repeat this until (base) is gone from your prompt:"),
        do("conda config --set auto_activate_base false", "And for every new terminal:"),
    )


@check(
    "empy",
    "The template program em is the right one",
    looks_at="the file em.py or the folder em beside the other Python packages",
    lesson="04-services#interfaces",
    rows=(7,),
)
def empy(machine: Machine) -> Finding:
    """A build of messages fails: 'module em has no attribute Interpreter' (or BUFFERED_OPT)."""
    ros = find_ros(machine)
    folders = [
        *_user_packages(machine),
        *([ros.packages] if ros else []),
        *_system_packages(machine),
    ]
    for folder in folders:
        for path in (folder / "em.py", folder / "em" / "__init__.py"):
            if exists(path):
                return _judge_em(path, ros)
    return not_applicable("em is not installed; only a build of messages needs it")


@check(
    "compiler",
    "A C++ compiler is installed",
    looks_at="the programs cc and c++ on PATH",
    lesson="05-actions#an-interface-of-your-own",
)
def compiler(machine: Machine) -> Finding:
    """A build of message types says that there is no C and C++ compiler."""
    names = (("cc", "gcc", "clang"), ("c++", "g++", "clang++"))
    found = [next(filter(None, map(machine.which, each)), None) for each in names]
    if all(found):
        return ok(f"{found[1]} is there.")
    return advice(
        f"There is no C++ compiler. {_who_needs_one(machine)}",
        *install_program(machine, "build-essential" if machine.which("apt") else "gcc-c++"),
    )


def _who_needs_one(machine: Machine) -> str:
    ros = find_ros(machine)
    if ros and ros.kind != "wheels":
        return "Message types need one: those of day 5, which your ROS builds, and your own."
    return "Only message types of your own need one; no lab does."


def _user_packages(machine: Machine) -> list[Path]:
    return sorted((machine.home / ".local/lib").glob("python3*/site-packages"))


def _system_packages(machine: Machine) -> list[Path]:
    return [
        *sorted(machine.path("/usr/local/lib").glob("python3*/dist-packages")),
        machine.path("/usr/lib/python3/dist-packages"),
    ]


def _judge_em(path: Path, ros: Ros | None) -> Finding:
    text = read_text(path)
    venv = str(ros.python) if ros and ros.kind == "wheels" else "python3"
    flag = "" if ros and ros.kind == "wheels" else "--user --break-system-packages "
    remove = do(f"{venv} -m pip uninstall -y em empy", "Remove it:")
    right = do(f"{venv} -m pip install {flag}'empy==3.3.4'", "Install the right one:")
    if "class Interpreter" not in text:
        return fault("em is another program of the same name. ROS needs empy.", remove, right)
    newer = re.search(r"^__version__ = ['\"]4", text, re.M)
    if newer and not _takes_empy_4(ros):
        return warning("em is empy 4. This ROS builds messages with empy 3.", remove, right)
    return ok("em is empy.")


def _takes_empy_4(ros: Ros | None) -> bool:
    """Newer releases of Jazzy's rosidl_adapter take both (ros2/rosidl#779)."""
    if ros is None:
        return True
    adapter = ros.packages / "rosidl_adapter" / "resource" / "__init__.py"
    return not exists(adapter) or "Configuration" in read_text(adapter)


@check(
    "colcon",
    "colcon, which builds packages, is installed",
    looks_at="the program colcon, and the part of it that knows ROS packages",
    lesson="03-topics#build",
    needs=("ros-found",),
)
def colcon(machine: Machine) -> Finding:
    """'colcon: command not found', or colcon says 'Summary: 0 packages finished'."""
    ros = find_ros(machine)
    program = machine.which("colcon") or (ros.prefix / "bin/colcon" if ros else None)
    if program is None or not exists(program):
        return _no_colcon(machine)
    folders = [
        *([ros.packages] if ros else []),
        *_user_packages(machine),
        *_system_packages(machine),
    ]
    if any(exists(folder / "colcon_ros") for folder in folders):
        return ok(f"colcon is {program}.")
    return warning(
        "colcon is here, but not the part that knows ROS packages (colcon-ros).",
        *install_package(machine, "python3-colcon-ros", "colcon-ros"),
    )


def _no_colcon(machine: Machine) -> Finding:
    """Beside a sourced ROS, `./roslings` has brought one of its own, for itself."""
    install = install_package(
        machine, "python3-colcon-common-extensions", "colcon-common-extensions"
    )
    if machine.has_course and exists(machine.clone / BESIDE_ROS / "bin/colcon"):
        return advice(
            "./roslings builds with a colcon of its own. To type colcon yourself, this terminal"
            " needs one.",
            *install,
        )
    return fault("colcon is not installed.", *install)


@check(
    "setuptools",
    "setuptools is older than 80",
    looks_at="the version of setuptools beside rclpy and in your own packages",
    lesson="03-topics#build",
)
def setuptools(machine: Machine) -> Finding:
    """colcon build --symlink-install fails: 'error: option --editable not recognized'."""
    ros = find_ros(machine)
    own = [ros.packages] if ros and ros.kind == "wheels" else []
    for folder in [*own, *_user_packages(machine), *_system_packages(machine)]:
        for note in sorted(folder.glob("setuptools-*.dist-info")):
            return _judge_setuptools(machine, folder, note.name)
    return not_applicable("setuptools is not installed yet")


def _judge_setuptools(machine: Machine, folder: Path, note: str) -> Finding:
    version = note.removeprefix("setuptools-").removesuffix(".dist-info")
    if int(version.split(".")[0]) < SETUPTOOLS_LIMIT:
        return ok(f"setuptools {version}.")
    ros = find_ros(machine)
    if ros and ros.kind == "wheels":
        mend = install_package(machine, "", "setuptools<80")
    else:
        remove = "python3 -m pip uninstall -y --break-system-packages setuptools"
        mend = (do(remove, "Remove yours. The system has one that fits:"),)
    return warning(f"setuptools is {version}, in {folder}. colcon needs one below 80.", *mend)


@check(
    "environment",
    "The Python environment belongs to this folder",
    looks_at="VIRTUAL_ENV, and the paths written inside .venv",
    lesson="01-install#wheels",
)
def environment(machine: Machine) -> Finding:
    """You change a file and nothing changes, or 'bad interpreter: No such file or directory'."""
    if not machine.has_course:
        return not_applicable(NO_COURSE)
    active = machine.env.get("VIRTUAL_ENV", "")
    own = machine.clone / ".venv"
    ours = (own, machine.clone / BESIDE_ROS)
    if active and not exists(Path(active)):
        return fault(f"The active environment {active} is gone.", new_terminal())
    if active and Path(active) not in ours and exists(Path(active).parent / "roslings"):
        return fault(
            f"The active environment is that of another copy of the course: {active}.",
            do(f"deactivate\nsource {quoted(own.parent / 'setup.bash')}", "Leave it for this one:"),
        )
    if exists(own) and not _made_here(own):
        return fault(
            "The course's folder was moved or copied after its set-up.",
            *rebuild_environment(machine),
        )
    return ok("The environment is this folder's own." if exists(own) else "No other environment.")


def _made_here(venv: Path) -> bool:
    """A script inside an environment names the folder in which it was made."""
    written = re.search(r"VIRTUAL_ENV=['\"]?(.+?)['\"]?$", read_text(venv / "bin/activate"), re.M)
    if written is None or "$" in written.group(1):
        return True
    return Path(written.group(1)) == venv or Path(written.group(1)).resolve() == venv.resolve()


@check(
    "course-path",
    "The course's folder has a plain path",
    looks_at="the path of the course's folder",
    lesson="01-install#wheels",
)
def course_path(machine: Machine) -> Finding:
    """colcon fails: 'bad interpreter', or setup.bash says 'No such file or directory'."""
    if not machine.has_course:
        return not_applicable(NO_COURSE)
    odd = sorted({letter for letter in str(machine.clone) if letter.isspace() or ord(letter) > 126})
    if not odd:
        return ok("The path has no space and no special letter.")
    named = ", ".join("a space" if letter.isspace() else f"'{letter}'" for letter in odd)
    return fault(
        f"The path of the course holds {named}: {machine.clone}",
        do(f"mv {quoted(machine.clone)} ~/roslings", "Move the folder to a plain place:"),
    )
