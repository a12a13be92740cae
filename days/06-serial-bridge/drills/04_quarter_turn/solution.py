"""Foretell: which line is written? Write it between quotes, for example
"z 0.5 w 0.5", then check."""

from math import cos, pi, sin

ANSWER = "z 1.0 w 0.0"


def main():
    yaw = pi
    z = sin(yaw / 2)
    w = cos(yaw / 2)
    print(f"z {z:.1f} w {w:.1f}")


main()
