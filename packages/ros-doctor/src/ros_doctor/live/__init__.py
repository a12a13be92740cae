"""Real ROS processes that the doctor starts, each a small program that always ends."""
