"""Foretell: a byte of this line was spoilt on its way. Which line is written? Write it
between quotes, then check."""

ANSWER = "ticks 15"

LINE = b"ticks 1\xff5"

print(LINE.decode("ascii", errors="ignore"))
