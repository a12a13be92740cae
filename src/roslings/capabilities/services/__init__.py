"""Services: one node asks, another answers."""
