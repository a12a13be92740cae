"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "learners",
        "ros2",
        "the ros2 commands, where the real ones are not installed",
        "ros2_on_pip.cli:main",
    ),
    ("", "rqt", "", "ros2_on_pip.window_commands:rqt"),
    ("", "rqt_console", "", "ros2_on_pip.window_commands:rqt_console"),
    ("", "rqt_image_view", "", "ros2_on_pip.window_commands:rqt_image_view"),
    ("", "rqt_plot", "", "ros2_on_pip.window_commands:rqt_plot"),
    ("", "rqt_publisher", "", "ros2_on_pip.window_commands:rqt_publisher"),
    ("", "rqt_reconfigure", "", "ros2_on_pip.window_commands:rqt_reconfigure"),
    ("", "rqt_topic", "", "ros2_on_pip.window_commands:rqt_topic"),
    ("", "rviz2", "", "ros2_on_pip.absent:rviz2"),
)
