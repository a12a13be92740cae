"""What a card says about actions, and what is said by no card."""

from __future__ import annotations

RESTLESS = 5.0
"""Feedback that is so many times too frequent comes from a loop without a pause."""
