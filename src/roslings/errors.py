"""Exit codes, the error that carries one, and what a command says when it meets it."""

from __future__ import annotations

import sys

OK, FAILED, WRONG_USE, INCONCLUSIVE, INTERRUPTED = 0, 1, 2, 3, 130
EXIT_OF_OUTCOME = {"pass": OK, "fail": FAILED, "inconclusive": INCONCLUSIVE}


class RoslingsError(Exception):
    """What a command cannot do, in words for whoever typed it, with the next step.

    `exit_status` is what the shell is told; a narrower kind may have another than the wider one.
    """

    exit_status: int = WRONG_USE


def explain(error: Exception) -> int:
    """Say what went wrong; the exit code tells whose fault it is. Raises what nobody expects."""
    code = exit_code_of(error)
    if code is None:
        raise error
    print(f"roslings: {error}", file=sys.stderr)
    return code


def exit_code_of(error: Exception) -> int | None:
    """The exit code for what went wrong; None for what nobody expected."""
    if isinstance(error, RoslingsError):
        return error.exit_status
    return WRONG_USE if isinstance(error, FileExistsError | NotADirectoryError) else None
