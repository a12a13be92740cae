# Starts the talker. Any domain will do, so long as the talker runs and publishes.

ros2 run demo_nodes_py talker
