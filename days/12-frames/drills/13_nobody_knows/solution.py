"""A beam goes over three squares, and hits a wall in the fourth one. Print the row of
six squares as a map has them: "0 0 0 100 -1 -1"."""

FREE, OCCUPIED, UNKNOWN = 0, 100, -1


def row(width, hit):
    squares = [UNKNOWN] * width
    squares[:hit] = [FREE] * hit
    squares[hit] = OCCUPIED
    return squares


def main():
    print(*row(width=6, hit=3))


main()
