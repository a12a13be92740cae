"""Foretell: which line is written? Write it between quotes, for example
"the ball is green", then check."""

ANSWER = None

ENCODING = "bgr8"
NAMES = {"b": "blue", "g": "green", "r": "red"}

pixel = (255, 0, 0)
place = pixel.index(max(pixel))
print("the ball is", NAMES[ENCODING[place]])
