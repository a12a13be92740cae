"""The student's workspace, read and never run: is it whole, is it built, is it up to date."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
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
from ros_doctor.mends import edit, quoted, shell_name
from ros_doctor.packages import (
    EntryPoint,
    WorkspacePackage,
    defined_names,
    entry_point,
    find_packages,
    imported_packages,
    parse,
)
from ros_doctor.registry import check
from ros_doctor.ros import find_ros, has_package, rclpy_under
from ros_doctor.texts import listed, said

BUILT_FOLDERS = ("build", "install", "log")

# ROS packages of the course, for machines where the doctor cannot ask an installed ROS.
KNOWN_ROS = frozenset(
    [
        "rclpy",
        "std_msgs",
        "std_srvs",
        "sensor_msgs",
        "geometry_msgs",
        "nav_msgs",
        "diagnostic_msgs",
        "example_interfaces",
        "builtin_interfaces",
        "rcl_interfaces",
        "action_msgs",
        "rosbag2_py",
        "rosidl_runtime_py",
        "tf2_geometry_msgs",
        "tf2_msgs",
        "tf2_ros",
        "tf_transformations",
        "launch",
        "launch_ros",
        "cv_bridge",
        "ament_index_python",
        "action_tutorials_interfaces",
    ]
)
# Other imports of the course, with the names that rosdep knows them by.
ROSDEP_KEYS = {
    "numpy": "python3-numpy",
    "serial": "python3-serial",
    "cv2": "python3-opencv",
    "yaml": "python3-yaml",
    "matplotlib": "python3-matplotlib",
}

PackageCheck = Callable[[ExaminedMachine, WorkspacePackage], "Finding | None"]


def each_package(machine: ExaminedMachine, look: PackageCheck, well: str) -> Finding:
    """Return the first finding about a package of the workspace, or that all are well."""
    packages = packages_of(machine)
    if not packages:
        return no_packages(machine)
    for package in packages:
        found = look(machine, package)
        if found:
            return found
    return ok(well)


def packages_of(machine: ExaminedMachine) -> tuple[WorkspacePackage, ...]:
    """Return the packages in the workspace's src, or beside it where there is no src."""
    source = machine.workspace / "src"
    return find_packages(source if exists(source) else machine.workspace)


def no_packages(machine: ExaminedMachine) -> Finding:
    """Return why the workspace cannot be looked at."""
    for folder in (machine.workspace, machine.workspace / "src"):
        if exists(folder) and not may_enter(folder):
            return unknown(
                said(
                    "doctor.workspace.no_packages.unknown",
                    "you may not open {folder}",
                    folder=folder,
                )
            )
    if exists(machine.workspace):
        return not_applicable(
            said(
                "doctor.workspace.no_packages.not_applicable",
                "there is no package in {workspace}/src yet",
                workspace=machine.workspace,
            )
        )
    return not_applicable(
        said(
            "doctor.workspace.no_packages.not_applicable_2",
            "there is no workspace at {workspace} yet",
            workspace=machine.workspace,
        )
    )


def may_enter(folder: Path) -> bool:
    """Tell whether this user may list a folder."""
    effective = os.access in os.supports_effective_ids
    return os.access(folder, os.R_OK | os.X_OK, effective_ids=effective)


def build(machine: ExaminedMachine, *before: str) -> MendStep:
    """Return the step that builds the workspace from its root."""
    lines = [f"cd {quoted(machine.workspace)}", *before, "colcon build"]
    return do("\n".join(lines), said("doctor.workspace.build.do", "Build:"))


def source_again(machine: ExaminedMachine) -> MendStep:
    """Return the step that makes a terminal know what was built."""
    setup = quoted(machine.workspace / "install" / f"setup.{shell_name(machine)}")
    return do(
        f"source {setup}",
        said("doctor.workspace.source_again.do", "Then, in the terminal where you run your nodes:"),
    )


@check(
    "ws-xml",
    "Each package.xml is valid",
    looks_at="package.xml of each package in the workspace",
    lesson="03-topics#package-xml",
)
def valid_xml(machine: ExaminedMachine) -> Finding:
    """colcon builds, and yet 'Package not found' comes."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        path = package.folder / "package.xml"
        problem = package.manifest.problem
        return (
            fault(
                said(
                    "doctor.workspace.valid_xml.fault",
                    "In {path}, {problem}.",
                    path=path,
                    problem=problem,
                ),
                edit(path),
            )
            if problem
            else None
        )

    return each_package(
        machine, look, said("doctor.workspace.manifest.well", "Each package.xml is valid.")
    )


@check(
    "ws-twins",
    "No two packages have one name",
    looks_at="the names in all package.xml files of the workspace",
    lesson="03-topics#package-xml",
)
def twins(machine: ExaminedMachine) -> Finding:
    """colcon stops: 'Duplicate package names not supported'."""
    packages = packages_of(machine)
    if not packages:
        return no_packages(machine)
    first: dict[str, WorkspacePackage] = {}
    for package in packages:
        if package.name in first:
            return fault(
                said(
                    "doctor.workspace.twins.fault",
                    "Two packages are called {name}: {folder} and {folder_2}.",
                    name=package.name,
                    folder=first[package.name].folder,
                    folder_2=package.folder,
                ),
                say(
                    said(
                        "doctor.workspace.twins.say",
                        "Keep the one you work on. Hide the other from colcon:",
                    )
                ),
                do(f"touch {quoted(package.folder / 'COLCON_IGNORE')}"),
            )
        first[package.name] = package
    return ok(said("doctor.workspace.twins.ok", "Each package has a name of its own."))


@check(
    "ws-syntax",
    "Each Python file can be read by Python",
    looks_at="the Python files of the workspace; they are read and not run",
    lesson="03-topics#read-an-error",
)
def syntax(machine: ExaminedMachine) -> Finding:
    """The node ends at once with 'SyntaxError' or 'IndentationError'."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        for path in (*package.modules, *package.folder.glob("setup.py")):
            tree = parse(path)
            if isinstance(tree, SyntaxError):
                return fault(
                    said(
                        "doctor.workspace.syntax.fault",
                        "{path}, line {value}: {msg}.",
                        path=path,
                        value=tree.lineno or 1,
                        msg=tree.msg,
                    ),
                    say(
                        said(
                            "doctor.workspace.syntax.say",
                            "Look at that line and at the one above it.",
                        )
                    ),
                    edit(path, tree.lineno or 1),
                )
        return None

    return each_package(
        machine, look, said("doctor.workspace.syntax.well", "Python can read every file.")
    )


@check(
    "ws-setup-cfg",
    "Each Python package has its setup.cfg",
    looks_at="setup.cfg, which tells where the programs are installed",
    lesson="03-topics#package-files",
    rows=(14,),
)
def setup_cfg(machine: ExaminedMachine) -> Finding:
    """The package builds, and ros2 run says 'No executable found'."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        path = package.folder / "setup.cfg"
        if not package.is_python or f"$base/lib/{package.name}" in read_text(path):
            return None
        place = f"$base/lib/{package.name}"
        silent = "{path} does not say {place}."
        return fault(
            said("doctor.workspace.setup_cfg.silent", silent, path=path, place=place)
            if exists(path)
            else said("doctor.workspace.setup_cfg.missing", "{path} is missing.", path=path),
            do(
                "printf '%s\\n' \\\n"
                f"  '[develop]' 'script_dir={place}' \\\n"
                f"  '[install]' 'install_scripts={place}' \\\n"
                f"  > {quoted(path)}",
                said("doctor.workspace.setup_cfg.do", "Write it:"),
            ),
            build(machine),
        )

    return each_package(
        machine, look, said("doctor.workspace.setup_cfg.well", "Each setup.cfg is right.")
    )


@check(
    "ws-marker",
    "Each package is announced to ROS by its marker file",
    looks_at="resource/NAME, and data_files in setup.py",
    lesson="03-topics#package-files",
    rows=(14,),
)
def marker(machine: ExaminedMachine) -> Finding:
    """The build stops: \"can't copy 'resource/...'\", or ros2 says 'Package not found'."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        if not package.is_python or package.setup is None:
            return None
        path = package.folder / "resource" / package.name
        if not exists(path):
            make = f"mkdir -p {quoted(path.parent)}\ntouch {quoted(path)}"
            return fault(
                said(
                    "doctor.workspace.marker.fault", "The empty file {path} is missing.", path=path
                ),
                do(make, said("doctor.workspace.marker.do", "Make it:")),
                build(machine),
            )
        installed = package.setup.installed
        if installed is not None and f"resource/{package.name}" not in installed:
            return fault(
                said(
                    "doctor.workspace.marker.fault_2",
                    "setup.py of {name} does not install resource/{name}.",
                    name=package.name,
                ),
                say(
                    said("doctor.workspace.marker.say", "Add this line to data_files in setup.py:")
                ),
                do(
                    "('share/ament_index/resource_index/packages',\n"
                    f"    ['resource/{package.name}']),"
                ),
                build(machine),
            )
        return None

    return each_package(
        machine, look, said("doctor.workspace.marker.well", "Each package has its marker.")
    )


@check(
    "ws-entry-points",
    "Each program in setup.py leads to a function",
    looks_at="entry_points in setup.py, and the functions in your Python files",
    lesson="03-topics#entry-points",
    rows=(14,),
)
def entry_points(machine: ExaminedMachine) -> Finding:
    """ros2 run says 'No executable found', or the program ends with 'AttributeError'."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        if not package.is_python or package.setup is None:
            return None
        path = package.folder / "setup.py"
        if package.setup.problem:
            return fault(
                said(
                    "doctor.workspace.entry_points.fault",
                    "In {path}, {problem}.",
                    path=path,
                    problem=package.setup.problem,
                ),
                edit(path),
            )
        for point in package.setup.entry_points or ():
            wrong = leads_nowhere(package, point)
            if wrong:
                mend = say(
                    said(
                        "doctor.workspace.entry_points.say",
                        "Mend the line in setup.py, or the name in your file.",
                    )
                )
                return fault(wrong, mend, build(machine))
        return None

    return each_package(
        machine,
        look,
        said("doctor.workspace.entry_points.well", "Each program leads to a function."),
    )


def leads_nowhere(package: WorkspacePackage, point: EntryPoint) -> str:
    """Return what is wrong with one program of setup.py, or ""."""
    if not point.name:
        text = "setup.py: '{text}' must look like '{right}'."
        right = f"talker = {package.name}.talker:main"
        return said("doctor.workspace.leads_nowhere", text, text=point.text, right=right)
    path = module_file(package, point.module)
    if path is None:
        here = [str(one.relative_to(package.folder)) for one in package.modules]
        wanted = point.module.replace(".", "/") + ".py"
        text = "setup.py: '{text}' wants the file {wanted}."
        wants = said("doctor.workspace.no_file", text, text=point.text, wanted=wanted)
        return f"{wants}{_near(wanted, here)}"
    tree = parse(path)
    names = None if isinstance(tree, SyntaxError) else defined_names(tree)
    first = point.function.partition(".")[0]
    if names is None or first in names:
        return ""
    text, file, function = (
        "setup.py: '{text}', but {file} has no {function}.",
        path.name,
        f"{first}()",
    )
    lacks = said(
        "doctor.workspace.no_function", text, text=point.text, file=file, function=function
    )
    return f"{lacks}{_near(first, names)}"


def module_file(package: WorkspacePackage, module: str) -> Path | None:
    """Return the file of a dotted module name, or None."""
    base = package.folder / module.replace(".", "/")
    for path in (base.with_name(base.name + ".py"), base / "__init__.py"):
        if exists(path):
            return path
    return None


def _near(wanted: str, known: list[str] | set[str]) -> str:
    import difflib

    close = difflib.get_close_matches(wanted, sorted(known), n=1, cutoff=0.6)
    if not close:
        return ""
    return f" {said('doctor.workspace.near', 'There is {name}: a spelling?', name=close[0])}"


@check(
    "ws-depends",
    "package.xml names what the code imports",
    looks_at="the imports in your Python files, and the depend lines of package.xml",
    lesson="03-topics#package-xml",
    rows=(16,),
)
def depends(machine: ExaminedMachine) -> Finding:
    """It works for you. On another computer: 'ModuleNotFoundError'."""
    local = {package.name for package in packages_of(machine)}

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        missing = sorted(_missing(machine, package, local))
        if not missing:
            return None
        lines = "\n".join(f"<depend>{name}</depend>" for name in missing)
        return warning(
            said(
                "doctor.workspace.depends.warning",
                "{name} imports {names}, but package.xml does not say so.",
                name=package.name,
                names=listed(missing),
            ),
            do(
                lines,
                said(
                    "doctor.workspace.depends.do",
                    "Add to {folder}, below <license>:",
                    folder=package.folder / "package.xml",
                ),
            ),
        )

    return each_package(
        machine, look, said("doctor.workspace.depends.well", "Each import is in package.xml.")
    )


def _missing(machine: ExaminedMachine, package: WorkspacePackage, local: set[str]) -> Iterator[str]:
    trees = [tree for tree in map(parse, package.modules) if not isinstance(tree, SyntaxError)]
    imported = {name for tree in trees for name in imported_packages(tree)}
    for name in imported - {package.name} - set(sys.stdlib_module_names):
        key = ROSDEP_KEYS.get(name, name)
        ours = name in local or name in KNOWN_ROS or name in ROSDEP_KEYS
        if key not in package.manifest.depends and (ours or has_package(machine, name)):
            yield key


@check(
    "ws-launch",
    "Launch files are installed",
    looks_at="files named *.launch.py, .xml or .yaml, and data_files in setup.py",
    lesson="05-actions#launch",
    rows=(15,),
)
def launch(machine: ExaminedMachine) -> Finding:
    """ros2 launch says: 'file ... was not found in the share directory'."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        setup = package.setup
        if not package.is_python or setup is None or setup.installed is None:
            return None
        names = [str(path.relative_to(package.folder)) for path in package.launch_files]
        missing = [name for name in names if name not in setup.installed]
        if not missing:
            return None
        return fault(
            said(
                "doctor.workspace.launch.fault",
                "{name}: setup.py does not install {missing}.",
                name=package.name,
                missing=missing[0],
            ),
            say(said("doctor.workspace.launch.say", "Add this line to data_files in setup.py:")),
            do(f"('share/{package.name}/launch', ['{missing[0]}']),"),
            build(machine),
        )

    return each_package(
        machine, look, said("doctor.workspace.launch.well", "Every launch file is installed.")
    )


@check(
    "ws-owner",
    "All files of the workspace are yours",
    looks_at="the owner of src, build, install, log and what is directly in them",
    lesson="03-topics#build",
    rows=(11,),
)
def owner(machine: ExaminedMachine) -> Finding:
    """colcon build stops: 'PermissionError: [Errno 13] Permission denied'."""
    if not exists(machine.workspace):
        return no_packages(machine)
    if machine.user == 0:
        return not_applicable(
            said(
                "doctor.workspace.owner.not_applicable",
                "you are root, and root may change every file",
            )
        )
    for path in _near_the_top(machine.workspace):
        if path.lstat().st_uid == 0:
            return fault(
                said(
                    "doctor.workspace.owner.fault", "{path} belongs to root, not to you.", path=path
                ),
                do(
                    f'sudo chown -R "$USER": {quoted(machine.workspace)}',
                    said("doctor.workspace.owner.do", "Make it yours again:"),
                ),
                say(said("doctor.workspace.owner.say", "Never type sudo before colcon.")),
            )
    return ok(said("doctor.workspace.owner.ok", "The files are yours."))


def _near_the_top(workspace: Path) -> Iterator[Path]:
    for folder in (workspace, *(workspace / name for name in ("src", *BUILT_FOLDERS))):
        if folder.is_dir() and may_enter(folder):
            yield folder
            yield from sorted(folder.iterdir())


@check(
    "ws-in-src",
    "The workspace was built from its root",
    looks_at="folders build, install and log that colcon made inside src",
    lesson="03-topics#build",
    rows=(12,),
)
def in_src(machine: ExaminedMachine) -> Finding:
    """You built, and nothing changed: you built in the wrong folder."""
    source = machine.workspace / "src"
    if not exists(source):
        return no_packages(machine)
    for folder in (source, *(path for path in sorted(source.iterdir()) if path.is_dir())):
        made = [folder / name for name in BUILT_FOLDERS if _made_by_colcon(folder / name)]
        if made:
            gone = " ".join(quoted(path) for path in made)
            return warning(
                said(
                    "doctor.workspace.in_src.warning",
                    "colcon was run inside {folder}.",
                    folder=folder,
                ),
                do(
                    f"rm -rf {gone}",
                    said("doctor.workspace.in_src.do", "Delete what it made there:"),
                ),
                build(machine),
            )
    return ok(said("doctor.workspace.in_src.ok", "Nothing was built inside src."))


def _made_by_colcon(folder: Path) -> bool:
    marks = ("COLCON_IGNORE", "local_setup.sh", ".built_by")
    return any(exists(folder / mark) for mark in marks)


@check(
    "ws-built",
    "Every package is built",
    looks_at="the folders of your packages in install",
    lesson="03-topics#build",
    rows=(8,),
)
def built(machine: ExaminedMachine) -> Finding:
    """ros2 run says 'Package not found'."""
    packages = packages_of(machine)
    if not packages:
        return no_packages(machine)
    missing = sorted(each.name for each in packages if not installed_as(machine, each))
    if not missing:
        return ok(said("doctor.workspace.built.ok", "Every package is built."))
    names = listed(missing)
    return advice(
        said("doctor.workspace.built.one", "{names} is not built yet.", names=names)
        if len(missing) == 1
        else said("doctor.workspace.built.several", "{names} are not built yet.", names=names),
        build(machine),
        source_again(machine),
    )


def installed_as(machine: ExaminedMachine, package: WorkspacePackage) -> Path | None:
    """Return the prefix into which a package was installed, or None."""
    install = machine.workspace / "install"
    for prefix in (install / package.name, install):
        if exists(prefix / "share" / package.name / "package.xml"):
            return prefix
    return None


@check(
    "ws-stale",
    "What is installed is what you wrote",
    looks_at="your files in src, compared with their copies in install",
    lesson="03-topics#build",
    rows=(13,),
)
def stale(machine: ExaminedMachine) -> Finding:
    """You changed the code, and the node still does the old thing."""

    def look(machine: ExaminedMachine, package: WorkspacePackage) -> Finding | None:
        prefix = installed_as(machine, package)
        changed = next(_changed(prefix, package), "") if prefix else ""
        if not changed:
            return None
        return warning(
            said(
                "doctor.workspace.stale.warning",
                "{changed} of {name} was changed after the last build.",
                changed=changed,
                name=package.name,
            ),
            build(machine),
            source_again(machine),
            say(
                said(
                    "doctor.workspace.stale.say",
                    "With colcon build --symlink-install, Python files need no new build.",
                )
            ),
        )

    return each_package(
        machine,
        look,
        said("doctor.workspace.stale.well", "The installed files are the same as yours."),
    )


def _changed(prefix: Path, package: WorkspacePackage) -> Iterator[str]:
    """Yield the files whose installed copies differ; contents are compared, not times."""
    share = prefix / "share" / package.name
    if _differs(package.folder / "package.xml", share / "package.xml"):
        yield "package.xml"
    for path in package.launch_files:
        if _differs(path, share / "launch" / path.name):
            yield path.name
    for site in prefix.glob("lib/python3*/site-packages"):
        yield from _changed_modules(site, package)
        if _new_programs(site, package):
            yield said("doctor.workspace.entry_points", "entry_points in setup.py")


def _changed_modules(site: Path, package: WorkspacePackage) -> Iterator[str]:
    if not exists(site / package.name):
        return  # a build with --symlink-install has no copies
    for path in package.modules:
        if _differs(path, site / path.relative_to(package.folder), missing=True):
            yield str(path.relative_to(package.folder))


def _differs(mine: Path, copy: Path, missing: bool = False) -> bool:
    if not exists(copy):
        return missing
    return read_text(mine) != read_text(copy)


def _new_programs(site: Path, package: WorkspacePackage) -> bool:
    """Tell whether setup.py names other programs than those that were installed."""
    wanted = package.setup.entry_points if package.setup else None
    notes = [read_text(path) for path in site.glob("*.egg-info/entry_points.txt")]
    if wanted is None or not notes:
        return False
    lines = [entry_point(line) for note in notes for line in note.splitlines()]
    installed = {(one.name, one.module, one.function) for one in lines if one.name}
    return {(one.name, one.module, one.function) for one in wanted if one.name} != installed


@check(
    "ws-python",
    "The workspace was built with today's Python",
    looks_at="the folder lib/python3.N in install",
    lesson="03-topics#build",
    rows=(5,),
)
def ws_python(machine: ExaminedMachine) -> Finding:
    """ros2 run ends with 'PackageNotFoundError: No package metadata was found'."""
    found = {path.name for path in machine.workspace.glob("install/*/lib/python3*")}
    ros = find_ros(machine)
    rclpy = rclpy_under(ros.prefix) if ros else None
    if not found or rclpy is None:
        return not_applicable(
            said(
                "doctor.workspace.ws_python.not_applicable",
                "nothing is built yet, or ROS 2 Jazzy is not installed",
            )
        )
    now = rclpy.parent.parent.name
    if found == {now}:
        return ok(said("doctor.workspace.ws_python.ok", "It was built with {now}.", now=now))
    other = sorted(found - {now})[0]
    return warning(
        said(
            "doctor.workspace.ws_python.warning",
            "Something in install was built with {other}, but ROS uses {now}.",
            other=other,
            now=now,
        ),
        build(machine, "rm -rf build install log"),
        source_again(machine),
    )
