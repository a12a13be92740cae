"""Sums over what was seen: rates, ends, stretches of time, the name that was probably meant.

A leaf: it reads evidence and the card, and runs nothing. What measures asks it whether enough was
seen, and what judges does the same sum.
"""
