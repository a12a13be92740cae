"""`ros2 bag`: rosbag2 folders, written and read by the package `rosbags`."""
