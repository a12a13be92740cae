"""Driving by keys, under the name that it has in every guide."""
