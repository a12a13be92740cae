"""The words that the script `./roslings` gives to this folder, and what comes of them."""

import sys
from collections.abc import Sequence
from pathlib import Path

from roslings_launcher.environment import EnvironmentRequest, make_ready
from roslings_launcher.errors import LauncherTrouble, of_the_disk, say
from roslings_launcher.paths import absolute_variables
from roslings_launcher.pins import write_pins
from roslings_launcher.place import CoursePlace
from roslings_launcher.wheels import fill

ROOT = Path(__file__).resolve().parents[4]


def main(words: Sequence[str]) -> int:
    """Runs one of the bootstrap's commands and returns the exit code."""
    absolute_variables()
    try:
        return _run(words)
    except LauncherTrouble as trouble:
        say(str(trouble))
        return 2
    except OSError as error:
        say(str(of_the_disk(error, ROOT)))
        return 2
    except KeyboardInterrupt:
        say("\nInterrupted. Run the same command again: it goes on from here.")
        return 130


def _run(words: Sequence[str]) -> int:
    verb, *rest = words
    if verb == "ready":
        make_ready(ROOT, EnvironmentRequest(command=rest[0], groups=tuple(rest[1:])))
    elif verb == "wheels":
        fill(CoursePlace(ROOT), rest)
    elif verb == "pins":
        write_pins(CoursePlace(ROOT), upgrade="--upgrade" in rest)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
