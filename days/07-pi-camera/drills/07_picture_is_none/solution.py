"""A camera gives no picture at first, and then one. It must print "no picture this
time", and then "a picture of 4 x 2"."""

import numpy

GIVEN = [(False, None), (True, numpy.zeros((2, 4, 3), dtype=numpy.uint8))]

for worked, picture in GIVEN:
    if not worked:
        print("no picture this time")
        continue
    height, width, _ = picture.shape
    print(f"a picture of {width} x {height}")
