"""Wrong packages made at the boundary to ROS: one thing changes between a node and rclpy.

Which ones there are is listed from the card and the fields of its types, never from anybody's code.
"""
