"""A small package that greets, for the break-it exercises."""
