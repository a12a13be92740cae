"""Sentences that nobody can know before they are said."""

from __future__ import annotations

import random


def sentence_by(chance: random.Random) -> str:
    """Three words and a number."""
    words = chance.sample(WORDS, 3)
    return f"{' '.join(words)} {chance.randrange(1000, 10000)}"


WORDS = (
    "amber",
    "anchor",
    "apple",
    "autumn",
    "bridge",
    "candle",
    "canyon",
    "cedar",
    "cherry",
    "cobalt",
    "comet",
    "copper",
    "coral",
    "cotton",
    "crystal",
    "desert",
    "ember",
    "falcon",
    "feather",
    "forest",
    "garden",
    "ginger",
    "glacier",
    "granite",
    "harbour",
    "hazel",
    "island",
    "ivory",
    "jasmine",
    "lantern",
    "lemon",
    "maple",
    "marble",
    "meadow",
    "mirror",
    "mountain",
    "ocean",
    "olive",
    "orchid",
    "pebble",
    "pepper",
    "planet",
    "prairie",
    "purple",
    "rainbow",
    "river",
    "saffron",
    "scarlet",
    "silver",
    "summer",
    "sunset",
    "thunder",
    "timber",
    "velvet",
    "violet",
    "walnut",
    "willow",
    "winter",
)
