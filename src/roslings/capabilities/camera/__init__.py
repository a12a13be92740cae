"""Cameras: pictures that a node publishes, and pictures that a node looks at."""
