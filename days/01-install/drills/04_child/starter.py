"""Foretell: which line comes last? Write it between quotes, for example
"the terminal says up", then check."""

import os
import subprocess

ANSWER = None

os.environ["ROBOT"] = "left"
subprocess.run(["bash", "-c", "export ROBOT=right; echo the program says $ROBOT"])
print("the terminal says", os.environ["ROBOT"])
