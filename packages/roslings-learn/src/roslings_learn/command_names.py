"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    ("learners", "lab", "open the day's lesson in JupyterLab", "roslings_learn.commands.lab"),
    (
        "learners",
        "drill",
        "a tiny program to mend: the next one, or check it",
        "roslings_learn.commands.drill",
    ),
    ("learners", "quiz", "a day's questions, in the terminal", "roslings_learn.commands.quiz"),
    (
        "learners",
        "watch",
        "today's drill or lab: check at every save",
        "roslings_learn.commands.watch",
    ),
)
