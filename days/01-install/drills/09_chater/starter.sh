# Beside this script, a talker says hello on /chatter. Hear one message of it.

ros2 topic echo --once /chater
