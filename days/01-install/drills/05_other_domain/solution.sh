# Starts the talker. The other terminals must be able to hear it: they have not
# changed their domain.

ros2 run demo_nodes_py talker
