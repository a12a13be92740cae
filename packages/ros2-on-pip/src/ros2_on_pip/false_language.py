"""The false language: English of which each letter has an accent, and each word is a third longer.

It is made from the English while a program runs. A text that stays plain in it was not asked for by
an id. What has no room for it has none for German or Finnish. What is no prose stays as it is:
code, fields in braces, links and addresses, tags, and names of ROS.
"""

from __future__ import annotations

import re
from functools import lru_cache

PLAIN = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
ACCENTED = "åƀçðéƒĝĥîĵķļɱñöþǫŕšţûṽŵẋýžÅƁÇÐÉƑĜĤÎĴĶĻṀÑÖÞǪŔŠŢÛṼŴẊÝŽ"
ACCENTS = str.maketrans(PLAIN, ACCENTED)
EVERY = 3
"""A letter in so many is written twice; of what is left at a word's end, the last one."""
NAMES = re.compile(
    "ROS|QoS|DDS|TF|URDF|SDF|rclpy|rclcpp|colcon|ament|rqt|rviz|rosbag|roslings|gazebo|bash|Jazzy"
    "|Python|Linux|Ubuntu|Debian|Windows|Docker|Podman|Jupyter|Sphinx|Anki"
    "|Hz|kHz|MHz|kB|MB|GB|ms|µs|px|cm|mm|XML|YAML|JSON|HTML|SVG"
)
"""Names that are not told by their form. They are the same in each language."""

CODE_LINE = r"(?m:^ {4,}[^\n]*$)"
KEPT = re.compile(
    "|".join(
        (
            r"```.*?```|``[^`]+``|`[^`\n]*`",  # code
            CODE_LINE,
            r"\{\{.*?\}\}|\{[^{}\n]*\}(?: [smhV]\b)?",  # fields with units, attributes of MyST
            r"\b\d[\d.,]* [smhV]\b",
            r"\]\([^()\s]*(?:\([^()\s]*\)[^()\s]*)*\)",  # where a link leads
            r"<[^<>\n]+>|&#?\w+;",  # tags, addresses in brackets, HTML's own signs
            r"\w+://[^\s)\]>`\"']+",
            # `./roslings check` and `ros2 topic list`, typed in a text without quotes for code
            r"(?:\./roslings|(?<![\w/.-])(?:ros2|sudo|pip))(?: (?:--?)?[\w./:=-]*[\w/=-])+",
            r"(?<![\w/.-])colcon (?:build|test|list)\b(?: --\S+)*",
            r"%\([^)]*\)\w|%[sd]",  # fields of Sphinx's own texts
            r"[\w.+-]+(?:[/_:@]+[\w.~+-]+)+/?|\w*_\w*",  # names and paths
            r"[~/][\w/.-]+|\w+(?:\.\w+)+(?:\(\))?|\w+\(\)",  # ~/x, /x, setup.py, rclpy.spin()
            r"\w*\d\w*|\w+=[\w.'\"]*|Ctrl-\w\b",
            r"\\.",
        )
    ),
    re.DOTALL,
)
WORD = re.compile(r"[^\W\d_]+")
CAMEL = re.compile(r"[A-Z][a-z]+(?:[A-Z][a-z]*)+|[a-z]+[A-Z]\w*")
"""`JupyterLab`, `rosMaster`: a name, whatever it stands for."""


@lru_cache(maxsize=4096)
def false(english: str) -> str:
    """The text in the false language; one that is in it already stays as it is."""
    parts, at = [], 0
    for kept in KEPT.finditer(english):
        parts += [_accented(english[at : kept.start()]), kept[0]]
        at = kept.end()
    return "".join([*parts, _accented(english[at:])])


def is_name(word: str) -> bool:
    """Whether a word of letters alone is a name, which no language changes."""
    return any(each.fullmatch(word) for each in (NAMES, CAMEL))


def plain_words(text: str) -> list[str]:
    """The words of a text that are no names, and have a letter without an accent.

    One letter alone is a unit, or a name in an example.
    """
    return [
        word
        for part in KEPT.split(text)
        for word in WORD.findall(part)
        if not is_name(word) and not set(word).isdisjoint(PLAIN) and (word in "aAI" or word[1:])
    ]


def _accented(prose: str) -> str:
    return WORD.sub(lambda word: _longer(word[0]), prose)


def _longer(word: str) -> str:
    if is_name(word) or set(word).isdisjoint(PLAIN):
        return word
    ends = range(EVERY - 1, len(word), EVERY)
    doubled = {*ends, len(word) - 1} if len(word) % EVERY else set(ends)
    return "".join(
        letter * (2 if at in doubled else 1) for at, letter in enumerate(word.translate(ACCENTS))
    )
