# Starts the talker with the usual middleware.

export RMW_IMPLEMENTATION=rmw_fastrtps_ccp
ros2 run demo_nodes_py talker
