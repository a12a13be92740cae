# A talker says hello on /chatter. Hear one message of it.
# The drill runs that talker beside this script. By hand, start it first, in another
# terminal: python3 talker.py

ros2 topic echo --once /chater
