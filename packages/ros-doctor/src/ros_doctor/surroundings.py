"""What kind of machine this is: distribution, container, WSL, virtual machine, Raspberry Pi."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.machine import ExaminedMachine, exists

JAZZY_UBUNTU = "24.04"  # REP 2000: Jazzy's apt packages are made for Ubuntu 24.04 (noble)


@dataclass(frozen=True)
class Release:
    """The distribution, from /etc/os-release; empty texts where there is none."""

    id: str
    version: str
    codename: str
    name: str

    @property
    def has_jazzy_in_apt(self) -> bool:
        """True where `apt install ros-jazzy-...` can work."""
        return self.id == "ubuntu" and self.version == JAZZY_UBUNTU


def release(machine: ExaminedMachine) -> Release:
    """Return which distribution this is."""
    found = dict(re.findall(r'^(\w+)="?([^"\n]*)"?$', machine.read("/etc/os-release"), re.M))
    return Release(
        found.get("ID", ""),
        found.get("VERSION_ID", ""),
        found.get("VERSION_CODENAME", ""),
        found.get("PRETTY_NAME", machine.system),
    )


def container(machine: ExaminedMachine) -> str:
    """Return the kind of container that this is (`Docker`, `Podman`), or ""."""
    if codespace(machine):
        return CODESPACE
    if exists(machine.path("/.dockerenv")):
        return "Docker"
    if exists(machine.path("/run/.containerenv")):
        return "Podman"
    kind = machine.env.get("container", "")
    inside = re.search("|".join(CONTAINERS), machine.read("/proc/1/cgroup"))
    return CONTAINERS.get(kind, kind) or (CONTAINERS[inside.group()] if inside else "")


def codespace(machine: ExaminedMachine) -> bool:
    """Tell whether this is a container on a computer of GitHub's.

    https://docs.github.com/en/codespaces, "Default environment variables for your codespace".
    """
    return machine.env.get("CODESPACES") == "true"


def outlives(machine: ExaminedMachine, folder: Path) -> bool:
    """Tell whether a folder lies outside of the container: on a volume, or a folder of the host."""
    mounts = [line.split()[1] for line in machine.read("/proc/self/mounts").splitlines() if line]
    return any(Path(mount) in (folder, *folder.parents) for mount in mounts if mount != "/")


CODESPACE = "GitHub Codespaces"
CONTAINERS = {
    "docker": "Docker",
    "podman": "Podman",
    "lxc": "LXC",
    "kubepods": "Kubernetes",
    "containerd": "containerd",
}


def wsl(machine: ExaminedMachine) -> int:
    """Return the version of WSL, 1 or 2, or 0 on any other machine.

    Microsoft's kernels name themselves: `...-Microsoft` is WSL 1, `...-microsoft-standard-WSL2`.
    """
    kernel = machine.read("/proc/sys/kernel/osrelease")
    if "microsoft" not in kernel.lower():
        return 0
    return 2 if "WSL2" in kernel or "microsoft-standard" in kernel else 1


def virtual_machine(machine: ExaminedMachine) -> str:
    """Return the program that runs this virtual machine, or "" on real hardware."""
    text = machine.read("/sys/class/dmi/id/sys_vendor") + machine.read(
        "/sys/class/dmi/id/product_name"
    )
    for mark, name in VIRTUAL.items():
        if mark in text:
            return name
    return ""


VIRTUAL = {
    "VirtualBox": "VirtualBox",
    "VMware": "VMware",
    "QEMU": "QEMU",
    "Parallels": "Parallels",
    "Virtual Machine": "Hyper-V",
    "UTM": "UTM",
}


def pi_model(machine: ExaminedMachine) -> str:
    """Return the model of a Raspberry Pi (`Raspberry Pi 5 Model B Rev 1.0`), or ""."""
    model = machine.read("/proc/device-tree/model").strip()
    return model if model.startswith("Raspberry Pi") else ""


def in_short(machine: ExaminedMachine) -> str:
    """Return the machine in a few words, for the first line of the report."""
    version = ".".join(str(part) for part in machine.interpreter.version)
    inside = [container(machine), f"WSL {wsl(machine)}" if wsl(machine) else ""]
    words = [release(machine).name, *inside, machine.architecture, f"Python {version}"]
    return ", ".join(word for word in words if word)
