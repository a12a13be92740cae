"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "learners",
        "explain",
        "three changes in your own package: which check fails?",
        "roslings_changes.commands.explain",
    ),
)
