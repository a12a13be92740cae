"""A picture of two pixels is to be 20 levels lighter. It must print [[120 255]]."""

import numpy

picture = numpy.array([[100, 250]], dtype=numpy.uint8)

lighter = numpy.clip(picture.astype(int) + 20, 0, 255).astype(numpy.uint8)
print(lighter)
