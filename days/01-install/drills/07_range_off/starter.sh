# Starts the talker. The other terminals must be able to hear it.

export ROS_AUTOMATIC_DISCOVERY_RANGE=OFF
ros2 run demo_nodes_py talker
