"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "learners",
        "desk",
        "drive, topics, curves and services in a browser",
        "roslings_desk.commands.desk",
    ),
)
