"""JupyterLab: does its kernel have ROS."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.finding import Finding, do, fault, not_applicable, ok, warning
from ros_doctor.machine import ExaminedMachine, exists, read_text
from ros_doctor.mends import quoted, rebuild_environment
from ros_doctor.registry import check
from ros_doctor.ros import environments, find_ros, rclpy_under
from ros_doctor.texts import said


@dataclass(frozen=True)
class Kernel:
    """A kernel that JupyterLab offers: its name and the Python that it starts."""

    name: str
    python: str
    note: Path


def kernels(machine: ExaminedMachine) -> list[Kernel]:
    """Return the Python kernels that this user's JupyterLab offers, as their notes say."""
    found = []
    for folder in _kernel_folders(machine):
        for note in sorted(folder.glob("*/kernel.json")):
            words = _command(note)
            if "ipykernel_launcher" in words or "ipykernel" in words:
                found.append(Kernel(note.parent.name, words[0], note))
    return found


def _kernel_folders(machine: ExaminedMachine) -> Iterator[Path]:
    for path in machine.variable_paths("JUPYTER_PATH"):
        yield path / "kernels"
    yield machine.home / ".local/share/jupyter/kernels"
    yield machine.home / "Library/Jupyter/kernels"
    for venv in environments(machine):
        yield venv / "share/jupyter/kernels"
    yield machine.path("/usr/local/share/jupyter/kernels")
    yield machine.path("/usr/share/jupyter/kernels")


def _command(note: Path) -> list[str]:
    try:
        words = json.loads(read_text(note)).get("argv", [])
    except (ValueError, AttributeError):
        return []
    return [str(word) for word in words] if isinstance(words, list) else []


@check(
    "jupyter",
    "JupyterLab is the one of the course's environment",
    looks_at="the program jupyter that this terminal would start",
    lesson="01-install#notebook",
    rows=(30,),
)
def jupyter(machine: ExaminedMachine) -> Finding:
    """A cell says 'ModuleNotFoundError: No module named rclpy'."""
    program = machine.which("jupyter-lab") or machine.which("jupyter")
    ros = find_ros(machine)
    if program is None or ros is None or ros.kind != "wheels":
        return not_applicable(
            said(
                "doctor.notebook.jupyter.not_applicable",
                "./roslings lab starts JupyterLab by itself",
            )
        )
    if program.parent == ros.prefix / "bin":
        return ok(said("doctor.notebook.jupyter.ok", "It is the one of the course."))
    return warning(
        said(
            "doctor.notebook.jupyter.warning",
            "jupyter in this terminal is {program}. It does not know rclpy.",
            program=program,
        ),
        do(
            f"cd {quoted(machine.clone)}\n./roslings lab",
            said("doctor.notebook.jupyter.do", "Start JupyterLab through the course:"),
        ),
    )


@check(
    "kernel",
    "The notebook's kernel has rclpy",
    looks_at="the kernels that JupyterLab offers, and the Python that each one starts",
    lesson="01-install#notebook",
    rows=(30,),
)
def kernel(machine: ExaminedMachine) -> Finding:
    """The kernel does not start, or a cell says 'No module named rclpy'."""
    offered = kernels(machine)
    if not offered:
        return not_applicable(
            said(
                "doctor.notebook.kernel.not_applicable",
                "JupyterLab is not installed yet; ./roslings lab installs it",
            )
        )
    dead = [one for one in offered if one.python.startswith("/") and not exists(Path(one.python))]
    if dead:
        return fault(
            said(
                "doctor.notebook.kernel.fault",
                "The kernel '{name}' starts a Python that is gone: {python}",
                name=dead[0].name,
                python=dead[0].python,
            ),
            do(
                f"rm -r {quoted(dead[0].note.parent)}",
                said("doctor.notebook.kernel.do", "Remove it:"),
            ),
            do(
                f"cd {quoted(machine.clone)}\n./roslings lab",
                said("doctor.notebook.kernel.do_2", "Start JupyterLab through the course:"),
            ),
        )
    able = [one for one in offered if _has_rclpy(machine, one)]
    if able:
        return ok(
            said("doctor.notebook.kernel.ok", "The kernel '{name}' has rclpy.", name=able[0].name)
        )
    return warning(
        said(
            "doctor.notebook.kernel.warning",
            "None of the kernels ({names}) has rclpy.",
            names=", ".join(sorted({one.name for one in offered})),
        ),
        *rebuild_environment(machine),
        do(
            "./roslings lab",
            said("doctor.notebook.kernel.do_3", "Then start JupyterLab through the course:"),
        ),
    )


def _has_rclpy(machine: ExaminedMachine, one: Kernel) -> bool:
    """A kernel without a full path uses the Python of the JupyterLab that starts it."""
    if not one.python.startswith("/"):
        return rclpy_under(one.note.parents[4]) is not None or _sourced(machine)
    return rclpy_under(Path(one.python).parent.parent) is not None or _sourced(machine)


def _sourced(machine: ExaminedMachine) -> bool:
    """A sourced ROS is on PYTHONPATH, which every kernel started from this shell inherits."""
    return any(exists(path / "rclpy") for path in machine.variable_paths("PYTHONPATH"))
