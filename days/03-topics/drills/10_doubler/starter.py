"""Write a whole node, from the first line to the last.

It is called doubler. It hears numbers on /number, and publishes each one times two
on /doubled. Both topics carry std_msgs/msg/Float64.
"""
