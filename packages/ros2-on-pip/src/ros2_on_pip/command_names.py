"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    ("learners", "ros2", "the ros2 commands, where the real ones are not installed",
     "ros2_on_pip.cli:main"),
    ("", "rqt", "", "ros2_on_pip.absent:rqt"),
    ("", "rqt_console", "", "ros2_on_pip.absent:rqt_console"),
    ("", "rqt_plot", "", "ros2_on_pip.absent:rqt_plot"),
    ("", "rviz2", "", "ros2_on_pip.absent:rviz2"),
)  # fmt: skip
