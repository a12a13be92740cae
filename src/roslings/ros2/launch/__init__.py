"""`ros2 launch` for XML and YAML files: read, plan, run."""
