"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    ("learners", "doctor", "is this machine ready?", "ros_doctor.cli:main"),
    (
        "learners",
        "break",
        "ten small faults to find and mend with the doctor",
        "ros_doctor.breaks.cli:main",
    ),
)
