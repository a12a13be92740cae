"""`python -m roslings`: the command line."""

import sys

from roslings.cli import main

sys.exit(main(sys.argv[1:]))
