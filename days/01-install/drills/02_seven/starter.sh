# Starts the talker. Any domain will do, so long as the talker runs and publishes.

export ROS_DOMAIN_ID=seven
ros2 run demo_nodes_py talker
