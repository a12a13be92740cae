"""Three lines came, and one of them has lost some bytes on its way. Print the others:
"left 10 right 12" and "left 11 right 13"."""

LINES = ["ticks 10 12", "ticks 1", "ticks 11 13"]


def read(line):
    """Left and right. Raises ValueError."""
    _, left, right = line.split()
    return int(left), int(right)


def main():
    for line in LINES:
        try:
            left, right = read(line)
        except ValueError:
            continue
        print(f"left {left} right {right}")


main()
