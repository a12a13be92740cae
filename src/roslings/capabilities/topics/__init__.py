"""Topics: what messages say, how often they come, and what a node makes of them."""
