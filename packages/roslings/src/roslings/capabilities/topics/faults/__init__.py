"""What can be wrong with messages: their rhythm, their text, and what is made of their values."""
