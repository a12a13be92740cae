"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "learners",
        "my-rover",
        "one robot of all the parts that you have built",
        "roslings_my_rover.commands.my_rover",
    ),
)
