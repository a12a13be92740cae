"""Tells who else is there."""

FRIENDS = {"talker", "listener"}


def strangers(node):
    """Tell the names of all who are not of this package; `ros2 topic hz` may see the truth."""
    names = set(node.get_node_names())
    for end in node.get_subscriptions_info_by_topic("/chatter"):
        names.add(end.node_name)
    for end in node.get_publishers_info_by_topic("/chatter"):
        names.add(end.node_name)
    return {name for name in names - FRIENDS if not name.startswith("_ros2cli")}
