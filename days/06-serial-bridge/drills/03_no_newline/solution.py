"""Sends an order to the board, which drives both wheels: M 100 100. The port here is
a pair of ends in this program: what is written at one end comes out at the other."""

import os
import select


def board(port):
    """Read whole lines, as the board does; a moment without any ends it."""
    heard = b""
    while b"\n" not in heard and select.select([port], [], [], 0.1)[0]:
        heard += os.read(port, 100)
    line, end, _ = heard.partition(b"\n")
    return line.decode("ascii") if end else "nothing"


def main():
    ours, theirs = os.pipe()
    os.write(theirs, b"M 100 100\n")
    print("the board heard", board(ours))


main()
