"""`python -m ros_doctor.breaks`: the exercises without the rest of the command line."""

import sys

from ros_doctor.breaks.cli import main

sys.exit(main(sys.argv[1:]))
