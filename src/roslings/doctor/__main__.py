"""`python -m roslings.doctor`: the doctor without the rest of the command line."""

import sys

from roslings.doctor.cli import main

sys.exit(main(sys.argv[1:]))
