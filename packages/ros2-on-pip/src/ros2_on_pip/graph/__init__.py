"""The graph of nodes and topics: what is seen of it, in words, and as a picture."""
