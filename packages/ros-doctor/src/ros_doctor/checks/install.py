"""ROS itself: is Jazzy here, is it the right one, can this Python use it, can colcon build."""

from __future__ import annotations

import datetime
import re
from pathlib import Path

from ros_doctor.finding import (
    Finding,
    MendStep,
    advice,
    do,
    fault,
    not_applicable,
    ok,
    say,
    unknown,
    warning,
)
from ros_doctor.machine import ExaminedMachine, exists, read_text
from ros_doctor.mends import (
    apt_source,
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
from ros_doctor.texts import DoctorText, listed, said

KEYRING = "/usr/share/keyrings"
NO_COURSE = DoctorText(
    "doctor.examine.one.not_applicable", "there is no folder of the roslings course here"
)
BESIDE_ROS = ".venv-apt"  # the course's environment where a ROS is sourced
SETUPTOOLS_LIMIT = 80  # colcon-core#696: 80 dropped what `--symlink-install` calls


@check(
    "ros-found",
    "ROS 2 Jazzy is installed, and this terminal knows it",
    looks_at="ROS_DISTRO, /opt/ros/jazzy, the course's environment .venv",
    lesson="01-install#source",
    rows=(1,),
)
def ros_found(machine: ExaminedMachine) -> Finding:
    """'ros2: command not found', or 'ModuleNotFoundError: No module named rclpy'."""
    ros = find_ros(machine)
    if ros is None:
        return fault(
            said("doctor.install.ros_found.fault", "There is no ROS 2 Jazzy on this machine."),
            *install_ros(machine),
        )
    if ros.ready:
        return ok(
            said(
                "doctor.install.ros_found.ok",
                "ROS 2 Jazzy ({kind}) in {prefix}.",
                kind=ros.kind,
                prefix=ros.prefix,
            )
        )
    if ros.kind == "wheels":
        return advice(
            said(
                "doctor.install.ros_found.advice_if",
                "ROS 2 Jazzy is in the course's environment. ./roslings finds it by "
                "itself, but ros2 and python3 in this terminal do not.",
            )
            if machine.has_course
            else said(
                "doctor.install.ros_found.advice_else",
                "ROS 2 Jazzy is in {prefix}, and this terminal does not know it.",
                prefix=ros.prefix,
            ),
            *source(machine, ros),
        )
    return fault(
        said(
            "doctor.install.ros_found.fault_2",
            "ROS 2 Jazzy is installed, but this terminal does not know it.",
        ),
        *source(machine, ros),
    )


@check(
    "one-ros",
    "Only one ROS is in this terminal, and it is Jazzy",
    looks_at="ROS_DISTRO and the folders of /opt/ros in the path variables",
    lesson="01-install#source",
    rows=(2,),
)
def one_ros(machine: ExaminedMachine) -> Finding:
    """Strange errors: 'undefined symbol', or messages whose types do not match."""
    from ros_doctor.checks.shell import startup_lines

    found = _distributions(machine)
    other = sorted(found - {DISTRO})
    if not other:
        return ok(
            said("doctor.install.one_ros.ok_if", "Jazzy alone.")
            if found
            else said("doctor.install.one_ros.ok_else", "No other ROS.")
        )
    lines = [line for line in startup_lines(machine) if any(name in line.text for name in other)]
    where = tuple(
        say(
            said(
                "doctor.install.one_ros.say",
                "Delete line {number} of {file}:  {text}",
                number=one.number,
                file=one.file,
                text=one.text,
            )
        )
        for one in lines
    )
    names = listed(sorted(found))
    setup = do(
        f"source /opt/ros/{DISTRO}/setup.{shell_name(machine)}",
        said("doctor.install.one_ros.do", "There, source Jazzy:"),
    )
    if DISTRO not in found:
        return fault(
            said(
                "doctor.install.one_ros.fault",
                "This terminal uses {names}. The course is for Jazzy.",
                names=names,
            ),
            *where,
            new_terminal(),
        )
    return fault(
        said("doctor.install.one_ros.fault_2", "This terminal mixes {names}.", names=names),
        *where,
        new_terminal(),
        setup,
    )


def _distributions(machine: ExaminedMachine) -> set[str]:
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
def apt_key(machine: ExaminedMachine) -> Finding:
    """apt update says: 'EXPKEYSIG F42ED6FBAB17C654 Open Robotics'."""
    files = sorted(machine.path(KEYRING).glob("ros*-archive-keyring.gpg"))
    if not files:
        return not_applicable(
            said("doctor.install.apt_key.not_applicable", "apt knows no ROS on this machine")
        )
    ends = {path: _ends(path) for path in files}
    good = [path for path, end in ends.items() if end is None or end > machine.now]
    if good:
        return ok(said("doctor.install.apt_key.ok", "{name} is valid.", name=good[-1].name))
    last = max(end or 0.0 for end in ends.values())
    day = datetime.datetime.fromtimestamp(last, datetime.timezone.utc).date()
    old = " ".join(f"{KEYRING}/{path.name}" for path in files)
    return fault(
        said(
            "doctor.install.apt_key.fault_if",
            "The key that signs ROS's packages ended on {day}.",
            day=day,
        )
        if last
        else said("doctor.install.apt_key.fault_else", "The key is unreadable."),
        do(
            f"sudo rm -f /etc/apt/sources.list.d/ros2.list \\\n  {old}",
            said("doctor.install.apt_key.do", "Remove the old key:"),
        ),
        *apt_source(),
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
def apt_release(machine: ExaminedMachine) -> Finding:
    """'Unable to locate package ros-jazzy-desktop', or 'unmet dependencies'."""
    here = release(machine).codename
    folder = machine.path("/etc/apt/sources.list.d")
    lists = {path: _suites(read_text(path)) for path in sorted(folder.glob("ros2*"))}
    suites = {suite for found in lists.values() for suite in found}
    if not suites:
        return not_applicable(
            said("doctor.install.apt_release.not_applicable", "apt knows no ROS on this machine")
        )
    if here in suites:
        return ok(
            said(
                "doctor.install.apt_release.ok", "apt looks for ROS packages of {here}.", here=here
            )
        )
    files = " ".join(f"/etc/apt/sources.list.d/{path.name}" for path in lists)
    asks = said(
        "doctor.install.apt_release.asks",
        "apt looks for ROS packages of {suites}. This system is {here}.",
        suites=", ".join(sorted(suites)),
        here=here,
    )
    if not release(machine).has_jazzy_in_apt:
        return warning(
            asks,
            do(f"sudo rm {files}", said("doctor.install.apt_release.do", "Remove that list:")),
            *install_ros(machine),
        )
    return fault(
        asks,
        do(f"sudo rm {files}", said("doctor.install.apt_release.do_2", "Remove that list:")),
        *apt_source(),
    )


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
def rclpy_python(machine: ExaminedMachine) -> Finding:
    """'ModuleNotFoundError: No module named rclpy._rclpy_pybind11'."""
    ros = find_ros(machine)
    if ros is None:
        return not_applicable(
            said("doctor.install.rclpy_python.not_applicable", "ROS 2 Jazzy is not installed")
        )
    built = _built_for(ros.rclpy)
    if not built:
        return fault(
            said(
                "doctor.install.rclpy_python.fault",
                "rclpy has no compiled part: the installation is broken.",
            ),
            *_again(machine, ros),
        )
    used = _python_version(machine, ros)
    if used is None:
        return unknown(
            said(
                "doctor.install.rclpy_python.unknown",
                "{python} does not say its version.",
                python=ros.python,
            )
        )
    if used in built:
        return ok(
            said(
                "doctor.install.rclpy_python.ok",
                "rclpy and python3 are both {used}.",
                used=_dotted(used),
            )
        )
    return fault(
        said(
            "doctor.install.rclpy_python.fault_2",
            "rclpy was built for Python {built}, but python3 is {used}.",
            built=_dotted(sorted(built)[0]),
            used=_dotted(used),
        ),
        *_right_python(machine, ros),
    )


def _built_for(rclpy: Path) -> set[tuple[int, int]]:
    names = [path.name for path in rclpy.glob("_rclpy_pybind11.*")]
    found = [re.search(r"cpython-3(\d+)", name) for name in names]
    return {(3, int(match.group(1))) for match in found if match}


def _python_version(machine: ExaminedMachine, ros: Ros) -> tuple[int, int] | None:
    """Return the version from the environment's note, or by asking the program itself."""
    note = re.search(r"^version\w* *= *3\.(\d+)", read_text(ros.prefix / "pyvenv.cfg"), re.M)
    if note:
        return 3, int(note.group(1))
    ran = machine.run("python3", "-S", "-c", "import sys; print(*sys.version_info[:2])")
    words = ran.output.split() if ran and ran.code == 0 else []
    return (int(words[0]), int(words[1])) if len(words) == 2 else None


def _dotted(version: tuple[int, int]) -> str:
    return f"{version[0]}.{version[1]}"


def _again(machine: ExaminedMachine, ros: Ros) -> tuple[MendStep, ...]:
    if ros.kind == "wheels":
        return rebuild_environment(machine)
    return (
        do(
            "sudo apt install --reinstall ros-jazzy-rclpy",
            said("doctor.install.again.do", "Install it again:"),
        ),
    )


def _right_python(machine: ExaminedMachine, ros: Ros) -> tuple[MendStep, ...]:
    if ros.kind == "wheels":
        return rebuild_environment(machine)
    return (
        say(
            said(
                "doctor.install.right_python.say",
                "Ubuntu's own Python is the right one. See which one answers in this terminal:",
            )
        ),
        do("type -a python3"),
        say(
            said(
                "doctor.install.right_python.say_2",
                "Leave the environment that comes first (deactivate, or remove it from PATH).",
            )
        ),
    )


@check(
    "middleware",
    "The middleware of ROS is installed",
    looks_at="the file librmw_fastrtps_cpp.so, or the one that RMW_IMPLEMENTATION names",
    lesson="01-install#middleware",
    rows=(20,),
    needs=("ros-found",),
)
def middleware(machine: ExaminedMachine) -> Finding:
    """'failed to load shared library librmw_...', or the node ends with exit code 102."""
    wanted = machine.env.get("RMW_IMPLEMENTATION", "")
    name = wanted or "rmw_fastrtps_cpp"
    if find_ros(machine) is None:
        return not_applicable(
            said("doctor.install.middleware.not_applicable", "ROS 2 Jazzy is not installed")
        )
    if has_library(machine, name):
        return ok(said("doctor.install.middleware.ok", "{name} is installed.", name=name))
    dashed = name.replace("_", "-")
    if not wanted:
        return fault(
            said("doctor.install.middleware.fault", "The middleware {name} is missing.", name=name),
            *install_package(machine, f"ros-jazzy-{dashed}", "ros-rmw-fastrtps-cpp==8.4.3"),
        )
    return fault(
        said(
            "doctor.install.middleware.fault_2",
            "RMW_IMPLEMENTATION is {wanted}, but that middleware is not installed.",
            wanted=wanted,
        ),
        say(
            said(
                "doctor.install.middleware.say",
                "Use the standard one. All computers of one robot must have the same.",
            )
        ),
        *unset(machine, "RMW_IMPLEMENTATION"),
    )


@check(
    "conda",
    "conda is not active",
    looks_at="CONDA_PREFIX and PATH",
    lesson="01-install#python",
    rows=(6,),
)
def conda(machine: ExaminedMachine) -> Finding:
    """colcon build fails: 'No module named catkin_pkg', or rclpy is not found."""
    prefix = machine.env.get("CONDA_PREFIX", "")
    python3 = machine.which("python3")
    inside = python3 is not None and any("conda" in part for part in python3.parts)
    if not prefix and not inside:
        return ok(said("doctor.install.conda.ok", "No conda in this terminal."))
    return fault(
        said(
            "doctor.install.conda.fault_if",
            "conda is active, and python3 is {python3}.",
            python3=python3,
        )
        if inside
        else said("doctor.install.conda.fault_else", "conda is active."),
        do(
            "conda deactivate",
            said("doctor.install.conda.do", "Repeat this until (base) is gone from your prompt:"),
        ),
        do(
            "conda config --set auto_activate_base false",
            said("doctor.install.conda.do_2", "And for every new terminal:"),
        ),
    )


@check(
    "empy",
    "The template program em is the right one",
    looks_at="the file em.py or the folder em beside the other Python packages",
    lesson="04-services#interfaces",
    rows=(7,),
)
def empy(machine: ExaminedMachine) -> Finding:
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
    return not_applicable(
        said(
            "doctor.install.empy.not_applicable",
            "em is not installed; only a build of messages needs it",
        )
    )


@check(
    "compiler",
    "A C++ compiler is installed",
    looks_at="the programs cc and c++ on PATH",
    lesson="05-actions#an-interface-of-your-own",
)
def compiler(machine: ExaminedMachine) -> Finding:
    """A build of message types says that there is no C and C++ compiler."""
    names = (("cc", "gcc", "clang"), ("c++", "g++", "clang++"))
    found = [next(filter(None, map(machine.which, each)), None) for each in names]
    if all(found):
        return ok(said("doctor.install.compiler.ok", "{found} is there.", found=found[1]))
    return advice(
        said(
            "doctor.install.compiler.advice",
            "There is no C++ compiler. {machine}",
            machine=_who_needs_one(machine),
        ),
        *install_program(machine, "build-essential" if machine.which("apt") else "gcc-c++"),
    )


def _who_needs_one(machine: ExaminedMachine) -> str:
    ros = find_ros(machine)
    if ros and ros.kind != "wheels":
        text = "Message types need one: those of day 5, which your ROS builds, and your own."
        return said("doctor.install.who_needs_one.sourced", text)
    text = "Only message types of your own need one; no lab does."
    return said("doctor.install.who_needs_one", text)


def _user_packages(machine: ExaminedMachine) -> list[Path]:
    return sorted((machine.home / ".local/lib").glob("python3*/site-packages"))


def _system_packages(machine: ExaminedMachine) -> list[Path]:
    return [
        *sorted(machine.path("/usr/local/lib").glob("python3*/dist-packages")),
        machine.path("/usr/lib/python3/dist-packages"),
    ]


def _judge_em(path: Path, ros: Ros | None) -> Finding:
    text = read_text(path)
    venv = str(ros.python) if ros and ros.kind == "wheels" else "python3"
    flag = "" if ros and ros.kind == "wheels" else "--user --break-system-packages "
    remove = do(
        f"{venv} -m pip uninstall -y em empy", said("doctor.install.judge_em.do", "Remove it:")
    )
    right = do(
        f"{venv} -m pip install {flag}'empy==3.3.4'",
        said("doctor.install.judge_em.do_2", "Install the right one:"),
    )
    if "class Interpreter" not in text:
        return fault(
            said(
                "doctor.install.judge_em.fault",
                "em is another program of the same name. ROS needs empy.",
            ),
            remove,
            right,
        )
    newer = re.search(r"^__version__ = ['\"]4", text, re.M)
    if newer and not _takes_empy_4(ros):
        return warning(
            said(
                "doctor.install.judge_em.warning",
                "em is empy 4. This ROS builds messages with empy 3.",
            ),
            remove,
            right,
        )
    return ok(said("doctor.install.judge_em.ok", "em is empy."))


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
def colcon(machine: ExaminedMachine) -> Finding:
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
        return ok(said("doctor.install.colcon.ok", "colcon is {program}.", program=program))
    return warning(
        said(
            "doctor.install.colcon.warning",
            "colcon is here, but not the part that knows ROS packages (colcon-ros).",
        ),
        *install_package(machine, "python3-colcon-ros", "colcon-ros"),
    )


def _no_colcon(machine: ExaminedMachine) -> Finding:
    """Beside a sourced ROS, `./roslings` has brought one of its own, for itself."""
    install = install_package(
        machine, "python3-colcon-common-extensions", "colcon-common-extensions"
    )
    if machine.has_course and exists(machine.clone / BESIDE_ROS / "bin/colcon"):
        return advice(
            said(
                "doctor.install.no_colcon.advice",
                "./roslings builds with a colcon of its own. To type colcon yourself, "
                "this terminal needs one.",
            ),
            *install,
        )
    return fault(said("doctor.install.no_colcon.fault", "colcon is not installed."), *install)


@check(
    "setuptools",
    "setuptools is older than 80",
    looks_at="the version of setuptools beside rclpy and in your own packages",
    lesson="03-topics#build",
)
def setuptools(machine: ExaminedMachine) -> Finding:
    """colcon build --symlink-install fails: 'error: option --editable not recognized'."""
    ros = find_ros(machine)
    own = [ros.packages] if ros and ros.kind == "wheels" else []
    for folder in [*own, *_user_packages(machine), *_system_packages(machine)]:
        for note in sorted(folder.glob("setuptools-*.dist-info")):
            return _judge_setuptools(machine, folder, note.name)
    return not_applicable(
        said("doctor.install.setuptools.not_applicable", "setuptools is not installed yet")
    )


def _judge_setuptools(machine: ExaminedMachine, folder: Path, note: str) -> Finding:
    version = note.removeprefix("setuptools-").removesuffix(".dist-info")
    if int(version.split(".")[0]) < SETUPTOOLS_LIMIT:
        return ok(
            said("doctor.install.judge_setuptools.ok", "setuptools {version}.", version=version)
        )
    ros = find_ros(machine)
    if ros and ros.kind == "wheels":
        mend = install_package(machine, "", "setuptools<80")
    else:
        remove = "python3 -m pip uninstall -y --break-system-packages setuptools"
        mend = (
            do(
                remove,
                said(
                    "doctor.install.judge_setuptools.do",
                    "Remove yours. The system has one that fits:",
                ),
            ),
        )
    return warning(
        said(
            "doctor.install.judge_setuptools.warning",
            "setuptools is {version}, in {folder}. colcon needs one below 80.",
            version=version,
            folder=folder,
        ),
        *mend,
    )


@check(
    "environment",
    "The Python environment belongs to this folder",
    looks_at="VIRTUAL_ENV, and the paths written inside .venv",
    lesson="01-install#wheels",
)
def environment(machine: ExaminedMachine) -> Finding:
    """You change a file and nothing changes, or 'bad interpreter: No such file or directory'."""
    if not machine.has_course:
        return not_applicable(str(NO_COURSE))
    active = machine.env.get("VIRTUAL_ENV", "")
    own = machine.clone / ".venv"
    ours = (own, machine.clone / BESIDE_ROS)
    if active and not exists(Path(active)):
        return fault(
            said(
                "doctor.install.environment.fault",
                "The active environment {active} is gone.",
                active=active,
            ),
            new_terminal(),
        )
    if active and Path(active) not in ours and exists(Path(active).parent / "roslings"):
        return fault(
            said(
                "doctor.install.environment.fault_2",
                "The active environment is that of another copy of the course: {active}.",
                active=active,
            ),
            do(
                f"deactivate\nsource {quoted(own.parent / 'setup.bash')}",
                said("doctor.install.environment.do", "Leave it for this one:"),
            ),
        )
    if exists(own) and not _made_here(own):
        return fault(
            said(
                "doctor.install.environment.fault_3",
                "The course's folder was moved or copied after its set-up.",
            ),
            *rebuild_environment(machine),
        )
    return ok(
        said("doctor.install.environment.ok_if", "The environment is this folder's own.")
        if exists(own)
        else said("doctor.install.environment.ok_else", "No other environment.")
    )


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
def course_path(machine: ExaminedMachine) -> Finding:
    """colcon fails: 'bad interpreter', or setup.bash says 'No such file or directory'."""
    if not machine.has_course:
        return not_applicable(str(NO_COURSE))
    odd = sorted({letter for letter in str(machine.clone) if letter.isspace() or ord(letter) > 126})
    if not odd:
        return ok(
            said("doctor.install.course_path.ok", "The path has no space and no special letter.")
        )
    space = said("doctor.install.course_path.space", "a space")
    named = ", ".join(space if letter.isspace() else f"'{letter}'" for letter in odd)
    return fault(
        said(
            "doctor.install.course_path.fault",
            "The path of the course holds {named}: {clone}",
            named=named,
            clone=machine.clone,
        ),
        do(
            f"mv {quoted(machine.clone)} ~/roslings",
            said("doctor.install.course_path.do", "Move the folder to a plain place:"),
        ),
    )
