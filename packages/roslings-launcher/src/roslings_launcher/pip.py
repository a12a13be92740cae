"""pip, run for us: its progress as one line, its failures as one sentence."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher.errors import LauncherTrouble, disk_full

# Settings of the user's own shell that would send packages elsewhere than into the environment.
_LEADING_ASTRAY = ("PIP_TARGET", "PIP_PREFIX", "PIP_ROOT", "PIP_USER", "PIP_REQUIRE_VIRTUALENV")

_UNREACHABLE = re.compile(
    r"NewConnectionError|ConnectTimeout|NameResolutionError|ReadTimeout|Connection (broken|refused"
    r"|reset|aborted)|IncompleteDownload|incomplete-download|Max retries exceeded|ProxyError"
    r"|Could not fetch URL|from versions: none|Network is unreachable|RemoteDisconnected|SSLError"
)
_DISK_FULL = re.compile(r"No space left on device|Errno 28|Disk quota exceeded|Errno 122")
# pip says the second where a pinned version is not among those found.
_NO_WHEEL = re.compile(r"(?:No matching distribution found for|ERROR: Cannot install) ([\w.=-]+)")
_FORBIDDEN = re.compile(r"Errno (?:13|30)\] [^:]+: '?([^'\n]+)")


@dataclass(frozen=True)
class Pip:
    """One way to run pip: `command` is what stands before its verb."""

    command: tuple[str, ...]
    log: Path
    keeps_downloads: bool = True  # in pip's own place for them
    wheels: Path | None = None  # the only source of packages, where given
    sees_path: bool = False  # keeps PYTHONPATH: the packages of a sourced ROS

    def run(self, *words: str, cwd: Path) -> Iterator[str]:
        """Runs `pip words...` and yields its lines, to the last.

        Raises:
            LauncherTrouble: pip failed.
        """
        lines: list[str] = []
        with _started([*self.command, *words, *self._options()], cwd, self.environment()) as pip:
            assert pip.stdout is not None
            for line in pip.stdout:
                lines.append(line)
                yield line.rstrip()
        if pip.returncode != 0:
            raise self._trouble("".join(lines))

    def _options(self) -> list[str]:
        options = ["--disable-pip-version-check", "--no-input", "--log", str(self.log)]
        if not self.keeps_downloads:
            options += ["--no-cache-dir"]
        if self.wheels:
            options += ["--no-index", "--find-links", str(self.wheels)]
        return options

    def environment(self) -> dict[str, str]:
        """The variables that pip runs with."""
        left_out = {*_LEADING_ASTRAY, *(() if self.sees_path else ("PYTHONPATH",)), "PYTHONHOME"}
        kept = {name: value for name, value in os.environ.items() if name not in left_out}
        # pip needs none of ROS's libraries, and must not start a second time for them.
        return kept | {"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1", "PYTHONUNBUFFERED": "1"}

    def _trouble(self, output: str) -> LauncherTrouble:
        if _DISK_FULL.search(output):
            return disk_full(self.log.parent)
        if self.wheels and (found := _NO_WHEEL.search(output)):
            return _no_wheel(found[1], self.wheels)
        if _UNREACHABLE.search(output):
            return _unreachable()
        if found := _FORBIDDEN.search(output):
            return LauncherTrouble(
                f"This cannot be written: {found[1]}", "Give it to your own user with chown."
            )
        return LauncherTrouble(
            f"pip could not install the packages. {_last_error(output)}".rstrip(),
            f"Read its report: {self.log}",
        )


class _Ended(subprocess.Popen[str]):
    """A process that does not outlive the block it was started for."""

    def __exit__(self, *exc: object) -> None:
        if self.poll() is None and exc[0] is not None:
            self.terminate()
        super().__exit__(*exc)  # type: ignore[arg-type]


def _started(command: Sequence[str], cwd: Path, environment: dict[str, str]) -> _Ended:
    """pip keeps our lock open, so that nothing else changes the environment while it works."""
    return _Ended(
        command,
        cwd=cwd,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        close_fds=False,
    )


def _no_wheel(name: str, folder: Path) -> LauncherTrouble:
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    return LauncherTrouble(
        f"The folder {folder} has no wheel of {name} for Python {version}.",
        f"On a machine with a network, with Python {version}: ./roslings wheels {folder}",
    )


def _unreachable() -> LauncherTrouble:
    return LauncherTrouble(
        "The package index cannot be reached, or the connection broke.",
        "Look at your network, then run the same command again: it goes on where it stopped.",
        "With no network: ROSLINGS_WHEELS=DIR ./roslings (README: without a network)",
    )


def _last_error(output: str) -> str:
    errors = [line for line in output.splitlines() if line.lower().lstrip().startswith("error:")]
    return errors[-1] if errors else ""
