"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    ("learners", "start", "put a lab's starter into your workspace", "roslings.commands.start"),
    ("learners", "check", "run what you built, and say what to do next", "roslings.commands.check"),
    ("learners", "status", "which days and labs are done", "roslings.commands.status"),
    ("learners", "diff", "what you changed since the starter", "roslings.commands.diff"),
    ("learners", "pack", "make the zip file to hand in", "roslings.commands.pack"),
    (
        "learners",
        "graph",
        "show the running graph, or save a picture of it",
        "roslings.commands.graph",
    ),
    ("", "rqt_graph", "", "roslings.commands.rqt_graph:main"),
    ("", "", "what is next", "roslings.commands.today"),
    ("learners", "site", "the lessons, words and quizzes as a website", "roslings.commands.site"),
    ("teachers", "test", "run the tests of roslings", "roslings.commands.test"),
)
