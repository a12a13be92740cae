"""Commands of the script `./roslings` itself: it runs them before any Python is chosen."""

COMMANDS = (
    (
        "learners",
        "ready",
        "install what a command needs, and run nothing",
        "roslings_launcher.cli.of_the_script",
    ),
    (
        "teachers",
        "wheels",
        "fetch every package into a folder, for a lab without a network",
        "roslings_launcher.cli.of_the_script",
    ),
)
