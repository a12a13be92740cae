"""What these tests share with those that span packages."""

from workspaces import card, package, topics, with_little_room, without_rights, workspace

__all__ = ["card", "package", "topics", "with_little_room", "without_rights", "workspace"]
