"""Drives of a rover as a bag would hold them: made from a seed, healthy or with planted faults.

Nothing here knows ROS: a message is a few numbers, a time and a stamp. So the truth about a drive
is reckoned from the very numbers that are written into its bag.
"""
