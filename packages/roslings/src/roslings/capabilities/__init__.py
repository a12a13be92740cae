"""What a robot program can do: a room for each kind of thing, with all that is known of it."""
