"""The talker and the listener that every guide starts with, under the names they have there."""
