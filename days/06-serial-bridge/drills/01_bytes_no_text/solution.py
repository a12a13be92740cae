"""The board has sent one line. Print it as "left 10 right 12"."""

LINE = b"ticks 10 12\n"


def main():
    word, left, right = LINE.decode("ascii").strip().split(" ")
    print(f"left {left} right {right}")


main()
