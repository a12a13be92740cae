"""`ros2 launch`: one model of actions for launch files in Python, XML and YAML, and what runs it.

The names are those of Jazzy's packages `launch` and `launch_ros`, and so is what they do.
`provided.py` offers them to launch files under the names that these import.
"""
