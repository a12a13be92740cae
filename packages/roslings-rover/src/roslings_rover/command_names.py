"""The commands of this package, for a command line that gathers them. Imports nothing."""

COMMANDS = (
    (
        "learners",
        "rover",
        "a small robot to drive by ROS, and its map",
        "roslings_rover.commands.rover",
    ),
    (
        "learners",
        "board",
        "the rover's Arduino board on a serial port",
        "roslings_rover.commands.board",
    ),
    (
        "learners",
        "camera",
        "the rover's camera, for a node to read",
        "roslings_rover.commands.camera",
    ),
)
