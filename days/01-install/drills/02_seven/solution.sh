# Starts the talker in the domain that the terminal has.

ros2 run demo_nodes_py talker
