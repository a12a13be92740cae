"""`python -m roslings_desk WORD...`: the command of this package alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from ros2_on_pip.errors import INTERRUPTED, RoslingsError
from roslings_desk.commands import desk


def main(words: Sequence[str]) -> int:
    """Run it; its exit code."""
    parser = argparse.ArgumentParser(prog="roslings_desk", allow_abbrev=False)
    desk.add_options(parser)
    try:
        return desk.run(parser.parse_args(words))
    except KeyboardInterrupt:
        return INTERRUPTED
    except RoslingsError as error:
        print(f"roslings: {error}", file=sys.stderr)
        return error.exit_status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
