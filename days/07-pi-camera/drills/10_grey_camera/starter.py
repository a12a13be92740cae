"""Write a whole node, from the first line to the last.

It is called grey_camera. On /grey (sensor_msgs/msg/Image) it publishes a black
picture, 10 times a second: 4 pixels wide, 2 high, encoding mono8. Its header names the
frame mast.
"""
