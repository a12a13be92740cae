"""A picture of two pixels is to be 20 levels lighter. It must print [[120 255]]."""

import numpy

picture = numpy.array([[100, 250]], dtype=numpy.uint8)

lighter = picture + numpy.uint8(20)
print(lighter)
