"""The checks of the computer: each fault is produced, and each check is silent when all is well."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from clinic import TODAY, Clinic, assert_absent, assert_ill, assert_well, ordinary_user

from ros_doctor.machine import Interpreter
from ros_doctor.surroundings import in_short
from skips import skip_without


def test_ill_system(clinic: Clinic) -> None:
    clinic.no_ros().change(architecture="aarch64").ubuntu("22.04", "jammy")
    assert_ill(clinic.look("system"), "fault", "only for Ubuntu 24.04", "ros:jazzy")


def test_ill_system__a_mac(clinic: Clinic) -> None:
    clinic.no_ros().change(system="Darwin", architecture="arm64", glibc=())
    (clinic.root / "etc/os-release").unlink()
    assert_ill(clinic.look("system"), "fault", "Darwin on arm64", "docker run")


def test_well_system(clinic: Clinic) -> None:
    assert_well(clinic.look("system"))
    clinic.no_ros()
    assert "apt" in clinic.look("system").found
    clinic.ubuntu("22.04", "jammy")
    assert "wheels" in clinic.look("system").found


@pytest.mark.parametrize("version", [(3, 9, 2), (3, 15, 0)])
def test_ill_python(clinic: Clinic, version: tuple[int, int, int]) -> None:
    clinic.change(interpreter=Interpreter(version, Path("/usr/bin/python3"), Path("/usr")))
    assert_ill(clinic.look("python"), "fault", f"{version[0]}.{version[1]}.", "./roslings doctor")


def test_well_python(clinic: Clinic) -> None:
    assert_well(clinic.look("python"))


def test_ill_disk_space(clinic: Clinic) -> None:
    clinic.change(free_bytes=lambda path: 120_000_000)
    assert_ill(clinic.look("disk-space"), "fault", "Only 120 MB", "du ")


def test_ill_disk_space__little(clinic: Clinic) -> None:
    clinic.change(free_bytes=lambda path: 1_200_000_000)
    assert_ill(clinic.look("disk-space"), "advice", "1.2 GB")


def test_well_disk_space(clinic: Clinic) -> None:
    assert_well(clinic.look("disk-space"))


def test_ill_memory(clinic: Clinic) -> None:
    clinic.file("/proc/meminfo", "MemTotal: 1000000 kB\nMemAvailable:  200000 kB\n")
    assert_ill(clinic.look("memory"), "warning", "204 MB", "ps ")


def test_well_memory(clinic: Clinic) -> None:
    assert_well(clinic.look("memory"))


def test_ill_clock(clinic: Clinic) -> None:
    clinic.change(now=86400.0)
    assert_ill(clinic.look("clock"), "fault", "1970", "set-ntp")


def test_ill_clock__files_of_tomorrow(clinic: Clinic) -> None:
    os.utime(clinic.package() / "setup.py", (TODAY + 86400, TODAY + 86400))
    assert_ill(clinic.look("clock"), "warning", "later than now", "timedatectl")


def test_well_clock(clinic: Clinic) -> None:
    for path in clinic.package().rglob("*"):
        os.utime(path, (TODAY, TODAY))
    assert_well(clinic.look("clock"))


def test_ill_shared_memory(clinic: Clinic) -> None:
    clinic.change(free_bytes=lambda path: 4_000_000)
    assert_ill(clinic.look("shared-memory"), "warning", "Only 4 MB", "rm -f /dev/shm/fastrtps_*")


def test_ill_shared_memory__in_a_container(clinic: Clinic) -> None:
    clinic.change(free_bytes=lambda path: 4_000_000).file("/.dockerenv")
    assert_ill(clinic.look("shared-memory"), "warning", "Only 4 MB", "--shm-size")


def test_ill_shared_memory__closed(clinic: Clinic) -> None:
    (clinic.root / "dev/shm").rmdir()
    assert_ill(clinic.look("shared-memory"), "fault", "may not write", "mount")


def test_ill_shared_memory__belongs_to_root(clinic: Clinic) -> None:
    (clinic.root / "dev/shm").chmod(0o555)
    with ordinary_user():
        finding = clinic.look("shared-memory")
    assert_ill(finding, "fault", "may not write", "mode=1777")


def test_well_shared_memory(clinic: Clinic) -> None:
    assert_well(clinic.look("shared-memory"))


@pytest.mark.parametrize(
    ("path", "text", "name"),
    [
        ("/.dockerenv", "", "Docker"),
        ("/run/.containerenv", "", "Podman"),
        ("/proc/1/cgroup", "0::/kubepods/besteffort", "Kubernetes"),
    ],
)
def test_ill_container(clinic: Clinic, path: str, text: str, name: str) -> None:
    clinic.file(path, text)
    assert_ill(clinic.look("container"), "advice", name, "--network=host")


def test_ill_container__work_that_would_be_lost(clinic: Clinic) -> None:
    clinic.file("/.dockerenv")
    clinic.file("/proc/self/mounts", "overlay / overlay rw 0 0\nproc /proc proc rw 0 0\n")
    assert_ill(clinic.look("container"), "advice", "is gone when", "-v roslings:")
    volume = f"/dev/sda1 {clinic.machine.workspace} ext4 rw 0 0\n"
    clinic.file("/proc/self/mounts", f"overlay / overlay rw 0 0\n{volume}")
    assert "gone" not in clinic.look("container").found


def test_ill_container__a_codespace(clinic: Clinic) -> None:
    finding = clinic.file("/.dockerenv") and clinic.look("container", CODESPACES="true")
    assert_ill(finding, "advice", "a codespace", "./roslings lab --no-browser")
    assert "GitHub Codespaces" in in_short(clinic.machine)


def test_well_container(clinic: Clinic) -> None:
    clinic.file("/proc/1/cgroup", "0::/init.scope")
    assert_well(clinic.look("container"))


def test_ill_wsl(clinic: Clinic) -> None:
    clinic.file("/proc/sys/kernel/osrelease", "4.4.0-19041-Microsoft\n")
    finding = clinic.look("wsl", WSL_DISTRO_NAME="Ubuntu-24.04")
    assert_ill(finding, "fault", "WSL 1", "wsl --set-version Ubuntu-24.04 2")


def test_ill_wsl__on_the_disk_of_windows(clinic: Clinic) -> None:
    clinic.file("/proc/sys/kernel/osrelease", "5.15.153.1-microsoft-standard-WSL2\n")
    finding = clinic.change(clone=Path("/mnt/c/Users/Sam/roslings")).look("wsl")
    assert_ill(finding, "advice", "many times slower", "cp -r /mnt/c/Users/Sam/roslings")


def test_well_wsl(clinic: Clinic) -> None:
    clinic.file("/proc/sys/kernel/osrelease", "5.15.153.1-microsoft-standard-WSL2\n")
    assert_well(clinic.look("wsl"))
    clinic.file("/proc/sys/kernel/osrelease", "6.8.0-45-generic\n")
    assert_absent(clinic.look("wsl"))


def test_ill_sandbox(clinic: Clinic) -> None:
    clinic.program("apt")
    assert_ill(clinic.look("sandbox"), "advice", "not installed", "apt install bubblewrap")


def test_ill_sandbox__another_installer(clinic: Clinic) -> None:
    clinic.program("dnf")
    assert_ill(clinic.look("sandbox"), "advice", "not installed", "sudo dnf install bubblewrap")


def test_ill_sandbox__apparmor(clinic: Clinic) -> None:
    clinic.program("bwrap", "echo 'bwrap: setting up uid map: Permission denied'; exit 1")
    clinic.file("/proc/sys/kernel/apparmor_restrict_unprivileged_userns", "1\n")
    assert_ill(clinic.look("sandbox"), "advice", "AppArmor", "bwrap-userns-restrict")


def test_ill_sandbox__no_namespaces(clinic: Clinic) -> None:
    clinic.program("bwrap", "exit 1")
    clinic.file("/proc/sys/user/max_user_namespaces", "0\n")
    assert_ill(clinic.look("sandbox"), "advice", "namespaces", "max_user_namespaces=10000")


def test_ill_sandbox__for_an_unknown_reason(clinic: Clinic) -> None:
    clinic.program("bwrap", "echo 'bwrap: the moon is full'; exit 1")
    assert_ill(clinic.look("sandbox"), "advice", "the moon is full")


def test_well_sandbox(clinic: Clinic) -> None:
    clinic.program("bwrap", 'test "$1" = --unshare-user')
    assert_well(clinic.look("sandbox"))


def test_a_real_small_disk_is_seen(clinic: Clinic) -> None:
    """The figure is the kernel's: a disk of 8 MB, where this kernel lets us make one."""
    script = (
        "mount -t tmpfs -o size=8m none /mnt && python3 -c "
        "'import shutil; print(shutil.disk_usage(\"/mnt\").free)'"
    )
    skip_without("small disk")
    ran = subprocess.run(
        ["unshare", "-Urm", "sh", "-c", script], capture_output=True, text=True, check=True
    )
    free = int(ran.stdout)
    clinic.change(free_bytes=lambda path: free)
    assert_ill(clinic.look("disk-space"), "fault", "Only 8 MB")
