"""Launch files in XML and YAML: read into a tree, and from there into the same actions."""

from ros2_on_pip.launching.markup.building import description_of

__all__ = ["description_of"]
