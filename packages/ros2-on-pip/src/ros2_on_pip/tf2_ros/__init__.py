"""The programs of `tf2_ros`, under the names that they have there."""
