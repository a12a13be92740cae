"""The ball is at x 5 and y 1 of a small picture. It must print "the ball is 200"."""

import numpy

WIDTH, HEIGHT = 8, 3
x, y = 5, 1

picture = numpy.zeros((HEIGHT, WIDTH), dtype=numpy.uint8)
picture[1, 5] = 200

print("the ball is", picture[x, y])
