"""The port gives bytes in pieces. Print each whole line: "got ticks 1 2", and so on."""

PIECES = [b"tic", b"ks 1 2\nticks 3", b" 4\n"]


def main():
    rest = b""
    for piece in PIECES:
        rest = piece
        for line in rest.split(b"\n"):
            print("got", line.decode("ascii"))


main()
