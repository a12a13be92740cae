"""A bag holds six messages. Print the longest gap between two messages that follow each
other: "longest gap 0.50 s". It lies between 0.2 s and 0.7 s."""

CAME_AT_S = [0.0, 0.1, 0.2, 0.7, 0.8, 0.9]


def main():
    gaps_s = []
    before_s = CAME_AT_S[0]
    for time_s in CAME_AT_S[1:]:
        gaps_s.append(time_s - before_s)
        before_s = time_s
    print(f"longest gap {max(gaps_s):.2f} s")


main()
