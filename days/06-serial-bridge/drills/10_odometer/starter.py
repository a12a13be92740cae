"""Write a whole node, from the first line to the last.

It is called odometer. On /ticks (std_msgs/msg/Int32) it hears how many ticks a wheel
has made. For each message it publishes the way in metres on /metres, as
std_msgs/msg/Float64.
A turn has 360 ticks, and takes the rover 0.2 m along.
"""
