"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "teachers",
        "new-lab",
        "make a small lab that works, to change it",
        "roslings_prove.commands.new_lab",
    ),
    (
        "teachers",
        "prove",
        "show that a lab's checks catch what they should",
        "roslings_prove.commands.prove",
    ),
)
