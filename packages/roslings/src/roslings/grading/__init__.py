"""One check, from a package to its verdict, and what becomes of that.

It calls the rooms in order: read, measure, judge, save. `check`, `watch`, `pack` and the platforms
come to a verdict through it.
"""
