"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    ("teachers", "grade", "grade many submissions", "roslings_class.commands.grade"),
    (
        "teachers",
        "regrade",
        "judge saved evidence again; runs nothing",
        "roslings_class.commands.regrade",
    ),
    (
        "teachers",
        "override",
        "give a score by hand, with its reason",
        "roslings_class.commands.override",
    ),
    (
        "teachers",
        "forget",
        "delete what is kept of one submission",
        "roslings_class.commands.forget",
    ),
    (
        "teachers",
        "overview",
        "all labs of a class in one table",
        "roslings_class.commands.overview",
    ),
    (
        "teachers",
        "export",
        "what a grading platform needs for a lab",
        "roslings_class.commands.export",
    ),
    (
        "teachers",
        "cluster",
        "a scheduler or worker for grade --dask",
        "roslings_class.commands.cluster",
    ),
    (
        "teachers",
        "release",
        "make the students' edition, without solutions",
        "roslings_class.commands.release",
    ),
    (
        "teachers",
        "serve",
        "hand out the course in a room without the internet",
        "roslings_class.commands.serve",
    ),
)
