"""The `ros2` words that the lessons use, for machines where the real command line is missing.

`rclpy` is imported only by the verbs that need it, when they run. Nothing imports this room.
"""
