"""Exit codes, and the error that carries one."""

from __future__ import annotations

OK, FAILED, WRONG_USE, INCONCLUSIVE, INTERRUPTED = 0, 1, 2, 3, 130
EXIT_OF_OUTCOME = {"pass": OK, "fail": FAILED, "inconclusive": INCONCLUSIVE}


class RoslingsError(Exception):
    """What a command cannot do, in words for whoever typed it, with the next step.

    `exit_status` is what the shell is told; a narrower kind may have another than the wider one.
    """

    exit_status: int = WRONG_USE
