"""What each command does: call the rooms in order, and print what they return."""
