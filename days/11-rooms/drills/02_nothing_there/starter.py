"""Six beams of a laser. Print the mean of the distances that were measured:
"mean 1.10 m". inf is "nothing there", -inf is "too near", and nan is "failed":
they are no distances."""

import math

BEAMS_M = [1.0, math.inf, 1.2, math.nan, -math.inf, 1.1]


def main():
    known = [distance for distance in BEAMS_M if not math.isinf(distance)]
    print(f"mean {sum(known) / len(known):.2f} m")


main()
