# Starts the talker. The other terminals must be able to hear it. No discovery server
# runs on this computer.

export ROS_DISCOVERY_SERVER=127.0.0.1:11811
ros2 run demo_nodes_py talker
