"""Bags: rosbag2's folders, as Jazzy writes them, on top of the package `rosbags`.

`ros2 bag` and the module `rosbag2_py` of these machines both stand on this room. It starts no node.
"""
