"""Many submissions: strangers' code in, a gradebook out.

Each submission is graded in a process of its own, by the same path as `check`. What came of it
is written down the moment it exists; whatever ends the command, the same command goes on.
Knows no single check.
"""
