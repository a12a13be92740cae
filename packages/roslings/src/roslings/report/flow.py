"""A text of several lines, told in one line or in paragraphs.

Our sentences are broken where a terminal is narrow; a line that begins with a space is one of a
list.
"""

from __future__ import annotations


def paragraphs(text: str) -> list[str]:
    """Its sentences together, and each line of a list by itself."""
    told: list[str] = []
    in_list = True
    for line in filter(str.strip, text.splitlines()):
        begins = line.startswith(" ")
        if begins or in_list:
            told.append(line.strip())
        else:
            told[-1] += f" {line.strip()}"
        in_list = begins
    return told


def one_line(text: str) -> str:
    """All of it; the lines of a list with commas between them."""
    words = ""
    before = ""
    for line in filter(str.strip, text.splitlines()):
        both_listed = line.startswith(" ") and before.startswith(" ")
        comma = "," if both_listed and not words.endswith((".", ",", ";")) else ""
        words = f"{words}{comma} {line.strip()}"
        before = line
    return words.strip()
