"""`python -m roslings.doctor.breaks`: the exercises without the rest of the command line."""

import sys

from roslings.doctor.breaks.cli import main

sys.exit(main(sys.argv[1:]))
