"""The lines on the cable: `$BODY*CRC`, where CRC is CRC-16/XMODEM of BODY."""

import binascii

LONGEST_LINE = 60


def frame(body):
    """Make the whole line for a body."""
    raw = body.encode('ascii')
    return b'$%s*%04X\n' % (raw, binascii.crc_hqx(raw, 0))


def unframe(line):
    """Take the body out of a line, or return None when the line is not whole."""
    body, star, crc = line.partition(b'*')
    if star and crc == b'%04X' % binascii.crc_hqx(body, 0):
        return body.decode('ascii')
    return None


class LineReader:
    """Puts lines together from pieces of any size."""

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
