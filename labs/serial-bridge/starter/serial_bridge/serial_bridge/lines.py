"""The lines on the cable.

    $BODY*CRC and a new line

CRC is the checksum of BODY (CRC-16/XMODEM): four capital hexadecimal digits.
In Python, binascii.crc_hqx(BODY, 0) computes it from bytes.
"""

LONGEST_LINE = 60


def frame(body):
    """Make the whole line, as bytes, for a body that is a text."""
    # TODO 3: make the line, with the dollar sign, the checksum and the new line.
    #         Try it: the body M,1,100,-100 has the checksum 7AC2.
    return b''


def unframe(line):
    """Take the body out of a line, or return None when the line is not whole.

    The line has no dollar sign and no new line any more: b'M,1,100,-100*7AC2'.
    """
    # TODO 4: cut the line at the star. Compute the checksum of what stands before
    #         it, and compare it with what stands behind it. Return the body as a
    #         text only when both are equal.
    return None


class LineReader:
    """Puts lines together from pieces of any size. This part is complete."""

    def __init__(self):
        self.line = None

    def feed(self, piece):
        """Return the bodies of all good lines that end in this piece."""
        bodies = []
        for byte in piece:
            letter = bytes([byte])
            if letter == b'$':
                self.line = b''
            elif letter == b'\n' and self.line is not None:
                bodies.append(unframe(self.line))
                self.line = None
            elif self.line is not None:
                self.line += letter
                if len(self.line) > LONGEST_LINE:
                    self.line = None
        return [body for body in bodies if body is not None]
