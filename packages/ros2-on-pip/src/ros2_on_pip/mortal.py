"""Becomes a program that ends when the process PID, its parent, does: `launch.py PID WORD...`.

A kernel that is killed cannot tidy up. Linux does it: PR_SET_PDEATHSIG. Done here and not between
fork and exec in the kernel, whose other threads may hold locks. Standard library alone: 20 ms.
"""

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1

if __name__ == "__main__":
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != int(sys.argv[1]):  # it ended before we could ask for that
        sys.exit(1)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # whoever ignores Ctrl-C hands that on
    os.execvp(sys.argv[2], sys.argv[2:])
