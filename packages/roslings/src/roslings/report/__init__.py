"""One verdict in, many shapes out: terminal, JSON, HTML; the ROS graph as a PNG.

Nothing here knows how a verdict was measured. Each shape is a module of its own, which brings only
what it needs: who prints a verdict waits for no matplotlib.
"""
