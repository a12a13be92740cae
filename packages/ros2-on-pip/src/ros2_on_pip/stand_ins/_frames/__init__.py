"""What `tf2_ros`, `tf2_geometry_msgs` and `tf_transformations` of this folder stand on.

No package of ROS has this name: programs import those.
"""
