"""Run as a folder: puts `src` where this folder stands on the path, then hands over."""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[2])

from roslings.bootstrap.commands import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
