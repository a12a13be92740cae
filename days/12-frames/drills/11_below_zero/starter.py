"""A map has squares of 0.05 m, and column 0 begins at x 0. Print the columns of four
places: "columns -2 -1 0 1"."""

PLACES_M = [-0.07, -0.02, 0.02, 0.07]
SQUARE_M = 0.05


def column(x):
    return int(x / SQUARE_M)


def main():
    print("columns", *(column(x) for x in PLACES_M))


main()
