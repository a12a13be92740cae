"""A page in the browser that does the work of rqt: drive, topics, curves, services."""
