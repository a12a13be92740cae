# Starts the talker, which says hello on /chatter.

ros2 run demo_nodes_py talkr
