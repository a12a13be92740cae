"""The listener: logs every text that it hears on a topic.

Go on here when the talker talks.
"""

# TODO 11: import what talker.py imports.


# TODO 12: make this class a Node, as in talker.py.
class Listener:
    """Subscribes to the talker's topic."""

    # TODO 13: write __init__. Give the node its name from the card, and create
    #          a subscription: message type, topic, self.hear, queue length 10.

    def hear(self, message):
        """Log one text; called once for each message that comes in."""
        # TODO 14: log the line that the card asks for, with the text that
        #          came in: it stands in the field "data" of the message.


def main(args=None):
    """Run the node until Ctrl-C."""
    # TODO 15: the same as in talker.py, for the Listener.


if __name__ == '__main__':
    main()
