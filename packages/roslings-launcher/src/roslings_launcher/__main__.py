"""Run as a folder: puts the folder above it where it stands on the path, then hands over."""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])

from roslings_launcher.commands import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
