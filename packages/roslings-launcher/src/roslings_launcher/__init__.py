"""Makes the environment that roslings runs in.

Standard library only; imports no other package of ours.

The script `./roslings` runs this folder when the environment is missing, stale or broken:

    python .../roslings_launcher ready COMMAND GROUP...   make the environment ready
    python .../roslings_launcher wheels DIR [GROUP...]    fill a folder with wheels
    python .../roslings_launcher pins                     write the pins and sizes again
"""

__version__ = "0.1.0"
