"""Write a whole node, from the first line to the last.

It is called tick. On /ticks it says "tick 0", "tick 1", ... as std_msgs/msg/String,
10 times a second, and it logs each text with get_logger().info(...).
"""
