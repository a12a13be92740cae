"""`python -m ros_doctor`: the doctor without the rest of the command line."""

import sys

from ros_doctor.cli import main

sys.exit(main(sys.argv[1:]))
