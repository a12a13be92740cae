"""A map of three rows with four squares each, all in one list. There is a nail in row
1, column 2. Print the rows, the one with the nail so: "row 1: ..#."."""

WIDTH, HEIGHT = 4, 3


def index(row, column):
    return column * WIDTH + row


def main():
    data = [0] * (WIDTH * HEIGHT)
    data[index(row=1, column=2)] = 100
    for row in range(HEIGHT):
        squares = data[row * WIDTH : (row + 1) * WIDTH]
        print(f"row {row}:", "".join("#" if each else "." for each in squares))


main()
