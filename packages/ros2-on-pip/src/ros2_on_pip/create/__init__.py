"""`ros2 pkg create`: what goes into a new ament_python package, and writing it."""
