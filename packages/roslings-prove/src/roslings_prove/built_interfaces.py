"""Builds the course's own message types for every Python, so that students need no compiler.

    ./roslings ready generators
    .venv/bin/python -m roslings_prove.built_interfaces

It takes the generators that constraints.txt pins, and the C and C++ compiler of this machine. What
is made is packed into `interfaces/built/` of the rover; commit it. A test makes it anew, and holds
both against each other.

The C code is compiled against Python's stable ABI (`stable_abi.h`). Nothing of this machine is left
in what is packed. There is no path, and no symbol of a libc or a libstdc++ newer than the wheels of
ROS ask for. The same compiler and the same Python make the same bytes.
"""

from __future__ import annotations

import gzip
import io
import re
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.built_interfaces import (
    PYTHON,
    BuiltPackage,
    archive_of,
    digest_of_file,
    origin_of,
)
from roslings_launcher.errors import LauncherTrouble, say
from roslings_launcher.interface_build import InterfaceBuild
from roslings_launcher.interface_sources import packages_of
from roslings_launcher.interfaces import GENERATORS
from roslings_launcher.machine import OLDEST_GLIBC
from roslings_launcher.place import CoursePlace
from roslings_launcher.virtual import Virtual

ROOT = Path(__file__).resolve().parents[4]
HEADER = Path(__file__).with_name("stable_abi.h")
BUILT = Path("packages/roslings-rover/src/roslings_rover/interfaces/built")
NEWEST = {"GLIBC": OLDEST_GLIBC, "GLIBCXX": (3, 4, 25), "CXXABI": (1, 3, 11)}
"""Of the symbols of libc and libstdc++: what manylinux_2_28 has, as the wheels of ROS need it."""
PLAIN_PYTHON = "/opt/python/cp312-cp312/include/python3.12"
PLAIN_NUMPY = "/opt/python/cp312-cp312/lib/python3.12/site-packages/numpy/_core/include"
"""What the files of the wheels say: the launcher puts this machine's paths there."""
SCRIPTS = ("package.*", "local_setup.*", "environment", "hook")
"""What `source install/setup.bash` reads, and the manifest, which lies with the sources."""
OF_A_BUILD = ("parent_prefix_path",)
"""Where the packages lay that a package was built with."""
UNUSED = (".pyc", ".c")
"""What the code was compiled from, and what each Python makes by itself."""
NEEDED_VERSION = re.compile(r"\bName: (GLIBC|GLIBCXX|CXXABI)_([\d.]+)\b")


@dataclass(frozen=True)
class Maker:
    """Makes what comes built, by the environment `virtual` of the course in `root`."""

    root: Path
    virtual: Virtual

    @property
    def place(self) -> CoursePlace:
        """Of the course."""
        return CoursePlace(self.root, self.virtual.folder.name)

    @property
    def build(self) -> InterfaceBuild:
        """By the wheels' generators."""
        return InterfaceBuild(self.place, self.virtual, sourced=False)

    def make(self, to: Path) -> list[BuiltPackage]:
        """Build all packages of types, and pack each into the folder `to`.

        Raises LauncherTrouble where something that builds is missing, or where what was built fits
        this machine alone.
        """
        self._require_generators()
        self.build.require_compiler()
        self.build.require_headers()
        self.build.prepare()
        to.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="roslings-") as made:
            scratch = Path(made).resolve()
            install = self.build.build(packages_of(self.root), scratch, self._settings(scratch))
            self._forget_this_machine(install, scratch)
            return [self._packed(source, install, to) for source in packages_of(self.root)]

    def _require_generators(self) -> None:
        if not (self.virtual.folder / "share/rosidl_default_generators").is_dir():
            raise LauncherTrouble(
                "This environment has no generators of message types.",
                f"./roslings ready {GENERATORS}",
            )

    def _settings(self, scratch: Path) -> list[str]:
        plain = f"-ffile-prefix-map={scratch}=. -ffile-prefix-map={self.virtual.folder}=."
        headers = self.build.headers()
        stable = f"-I{headers.python} -include {HEADER} -Werror=implicit-function-declaration"
        link = "-s -Wl,--build-id=none"
        return [
            f"-DCMAKE_C_FLAGS={plain} {stable}",
            f"-DCMAKE_CXX_FLAGS={plain}",
            f"-DCMAKE_SHARED_LINKER_FLAGS={link}",
            f"-DCMAKE_MODULE_LINKER_FLAGS={link}",
            "-DCMAKE_SKIP_RPATH=ON",
        ]

    # --- what was built, for every machine -----------------------------------------------------

    def _forget_this_machine(self, install: Path, scratch: Path) -> None:
        headers = self.build.headers()
        plain = {headers.numpy: PLAIN_NUMPY, headers.python: PLAIN_PYTHON}
        for file in install.glob("share/*/cmake/*.cmake"):
            text = file.read_text("utf-8")
            for ours, theirs in plain.items():
                text = text.replace(ours, theirs)
            file.write_text(text, "utf-8")

    def _packed(self, source: Path, install: Path, to: Path) -> BuiltPackage:
        files = dict(sorted(files_of_package(install, source.name)))
        guilty = [*self._told_of_this_machine(files), *too_new(files)]
        if guilty:
            raise LauncherTrouble(
                f"Not packed, since it fits this machine alone: {'; '.join(guilty)}"
            )
        archive = archive_of(to, source.name)
        pack(files, archive)
        origin = origin_of(source, self.place.constraints)
        made = BuiltPackage(archive, origin, digest_of_file(archive), made_with())
        made.tell()
        return made

    def _told_of_this_machine(self, files: dict[str, Path]) -> Iterator[str]:
        headers = self.build.headers()
        ours = (tempfile.gettempdir(), str(self.root), headers.python, sys.prefix, sys.base_prefix)
        for name, file in files.items():
            content = file.read_bytes()
            found = [path for path in ours if len(path) > 4 and f"{path}/".encode() in content]
            yield from (f"{name} names {path}" for path in found)


def files_of_package(install: Path, package: str) -> Iterator[tuple[str, Path]]:
    """What colcon has installed of a package: its name in the archive, and the file."""
    (site,) = install.glob("lib/python3*/*-packages")
    for top in (install / "include" / package, install / "share" / package):
        yield from _files_below(top, install, SCRIPTS)
    for file in install.glob(f"lib/lib{package}__*.so"):
        yield f"lib/{file.name}", file
    for pattern in (f"share/ament_index/*/*/{package}", f"share/colcon-core/packages/{package}"):
        for file in install.glob(pattern):
            if file.parent.name not in OF_A_BUILD:
                yield file.relative_to(install).as_posix(), file
    for name, file in _files_below(site / package, site):
        yield f"{PYTHON}/{name}", file


def _files_below(top: Path, above: Path, but: Sequence[str] = ()) -> Iterator[tuple[str, Path]]:
    left = {each for pattern in but for each in top.glob(pattern)}
    for file in top.rglob("*"):
        if file.is_file() and file.suffix not in UNUSED and not left & {file, *file.parents}:
            yield file.relative_to(above).as_posix(), file


def too_new(files: dict[str, Path]) -> Iterator[str]:
    """Libraries that ask for symbols newer than the oldest machine of the wheels has."""
    for name, file in files.items():
        for library, version in needed_versions(file) if file.suffix == ".so" else ():
            if version > NEWEST[library]:
                yield f"{name} asks for {library} {'.'.join(map(str, version))}"


def needed_versions(library: Path) -> set[tuple[str, tuple[int, ...]]]:
    """The versions of libc's and libstdc++'s symbols that it asks for."""
    words = ["readelf", "--version-info", "--wide", str(library)]
    said = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    found = NEEDED_VERSION.findall(said)
    return {(name, tuple(map(int, version.split(".")))) for name, version in found}


def pack(files: dict[str, Path], archive: Path) -> None:
    """The same files make the same archive: nobody's, and of no time."""
    with (
        archive.open("wb") as raw,
        gzip.GzipFile("", "wb", compresslevel=9, fileobj=raw, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as tar,
    ):
        for name, file in files.items():
            content = file.read_bytes()
            entry = tarfile.TarInfo(name)
            entry.size, entry.mode = len(content), 0o644
            tar.addfile(entry, io.BytesIO(content))


def made_with() -> str:
    """The compiler and the Python, as they call themselves."""
    said = subprocess.run(["c++", "--version"], capture_output=True, text=True, check=True).stdout
    return f"{said.splitlines()[0]}, Python {sys.version.split()[0]}"


def main() -> int:
    """Make them anew where they lie in the course."""
    try:
        for package in Maker(ROOT, Virtual(Path(sys.prefix))).make(ROOT / BUILT):
            size_kb = package.archive.stat().st_size / 1e3
            say(f"{package.archive.relative_to(ROOT)}: {size_kb:.0f} kB, by {package.made_with}")
    except LauncherTrouble as trouble:
        say(str(trouble))
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
