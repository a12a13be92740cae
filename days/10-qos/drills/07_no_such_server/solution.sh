# Starts the talker. The other terminals must be able to hear it. No discovery server
# runs on this computer.

ros2 run demo_nodes_py talker
