"""Foretell: three rovers look 90 degrees past a wall, and turn back to it. Their gains
are too small, right, and too large. Each line shows the error, scan by scan. Which line
is written for the third one? Write it as a text, then check."""

ANSWER = None

SCAN_S = 0.2  # a command holds until the next scan


def curve(gain):
    error, errors = 90.0, []
    for _ in range(4):
        errors.append(f"{error:.0f}")
        turn = gain * error
        error = error - turn * SCAN_S
    return " ".join(errors)


def main():
    for gain in (1.0, 5.0, 10.0):
        print(curve(gain))


main()
