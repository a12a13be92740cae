# Starts the talker in the domain that the terminal has.

export ROS_DOMAIN_ID=seven
ros2 run demo_nodes_py talker
