# Starts the talker with the usual middleware.

export RMW_IMPLEMENTATION=rmw_fastrtps_cpp
ros2 run demo_nodes_py talker
