"""Makes the environment that roslings runs in. Standard library only; imports no other room.

The script `./roslings` runs this folder when the environment is missing, stale or broken:

    python src/roslings/bootstrap ready COMMAND GROUP...   make the environment ready
    python src/roslings/bootstrap wheels DIR [GROUP...]    fill a folder with wheels
    python src/roslings/bootstrap pins                     write the pins and sizes again
"""
