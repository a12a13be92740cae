"""Find message types by their names, as `rosidl_runtime_py.utilities` does on a full ROS."""
