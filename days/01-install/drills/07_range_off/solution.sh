# Starts the talker. The other terminals must be able to hear it.

ros2 run demo_nodes_py talker
