"""Actions: goals that take a while, with feedback, and can be cancelled."""
