"""Packages of ROS that have no wheels, by their own names: programs import them as on any ROS.

This folder comes last on the path of the environments that `./roslings` makes (`roslings.pth`). So
a real package of the same name, which a sourced ROS has on PYTHONPATH, goes before it.
"""
