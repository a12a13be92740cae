"""`python -m roslings_rover rover|board|camera WORD...`: the commands of this package alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module

from ros2_on_pip.errors import INTERRUPTED, RoslingsError
from roslings_rover.command_names import COMMANDS


def main(words: Sequence[str]) -> int:
    """Run one of them; its exit code."""
    parser = argparse.ArgumentParser(prog="roslings_rover", allow_abbrev=False)
    verbs = parser.add_subparsers(metavar="COMMAND", required=True)
    for _, name, about, place in COMMANDS:
        module = import_module(place)
        verb = verbs.add_parser(name, description=about, help=about, allow_abbrev=False)
        verb.set_defaults(run=module.run)
        module.add_options(verb)
    options = parser.parse_args(words)
    try:
        status: int = options.run(options)
        return status
    except KeyboardInterrupt:
        return INTERRUPTED
    except RoslingsError as error:
        print(f"roslings: {error}", file=sys.stderr)
        return error.exit_status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
