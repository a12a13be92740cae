"""The doctor: is this machine ready, and if not, what to type.

It runs wherever Python runs: before ROS is installed, in a shell that is not sourced, without a
network. It changes nothing. One small function a check stands in `checks/`; `registry` collects
them, `examine` runs them, `screen` and `document` show what they found.
"""
