"""Each word that students read, and those that nothing explains.

A word is explained by its entry in `glossary/`. What needs none stands in `everyday_words.txt`. A
word that is neither is one that somebody on the third day of ROS may not know.
"""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

from roslings_learn.lessons import Glossary
from roslings_learn.lessons.rules import Lesson
from roslings_learn.lessons.rules.prose import CODE, blocks_of

EVERYDAY = Path(__file__).with_name("everyday_words.txt")
WORD = re.compile(
    r"(?<![\w/.~$<{=@-])(?:[A-Za-z][a-z]+|[A-Z]{2,})(?:'[a-z]+)?(?![\w=/(}@]|[.:/_]\w)"
)
"""Letters that stand alone: no part of a path, an address or a call, and no NameOfAClass."""
NOT_READ = re.compile(r"\]\([^)]*\)|<[^>]*>|\{[^}]*\}|https?://\S+")
"""Targets of links, tags, fields of a template, addresses."""
ENDINGS = ("'s", "s", "es", "d", "ed", "r", "er", "st", "est", "ly", "ing")

Texts = Mapping[str, Iterable[str]]
"""Where it stands, to what is read there."""


def texts_of(root: Path, lessons: Iterable[Lesson]) -> dict[str, list[str]]:
    """Lessons, quizzes, drills, labs, verdicts, and what the doctor says."""
    found: dict[str, list[str]] = defaultdict(list)
    for lesson in lessons:
        found[lesson.day.id] += [p.block.text for p in lesson.parts if p.block.kind != "code"]
    for pattern in ("days/*/*.md", "labs/*/task.md", "packages/ros-doctor/src/**/pages/*.md"):
        for path in sorted(root.glob(pattern)):
            found[str(path.relative_to(root))] += prose(path.read_text("utf-8"))
    for pattern in ("days/*/quiz.yaml", "labs/*/hints.yaml", "days/*/drills/*/drill.yaml"):
        for path in sorted(root.glob(pattern)):
            said = sentences_of(yaml.safe_load(path.read_text("utf-8")))
            found[str(path.relative_to(root))] += [each for text in said for each in prose(text)]
    for path in sorted(root.glob("packages/*/src/**/*.py")):
        if {"faults", "faults.py", "checks"} & set(path.parts):  # of verdicts, and the doctor's
            found[str(path.relative_to(root))] += strings_of(path.read_text("utf-8"))
    return dict(found)


def prose(markdown: str) -> list[str]:
    """What is no code; lines that are indented are code in hints."""
    flat = "\n".join(line for line in markdown.splitlines() if not line.startswith("    "))
    return [block.text for block in blocks_of(flat) if block.kind != "code"]


def sentences_of(content: Any) -> Iterator[str]:
    """The texts of a YAML file that have more than one word."""
    if isinstance(content, str):
        yield from [content] if " " in content else []
    elif isinstance(content, (dict, list)):
        for each in content.values() if isinstance(content, dict) else content:
            yield from sentences_of(each)


def strings_of(code: str) -> list[str]:
    """The sentences in a program: its strings with a space, but no docstring."""
    nodes = list(ast.walk(ast.parse(code)))
    docstrings = {id(each.value) for each in nodes if isinstance(each, ast.Expr)}
    return [
        each.value
        for each in nodes
        if isinstance(each, ast.Constant)
        and isinstance(each.value, str)
        and " " in each.value
        and id(each) not in docstrings
    ]


def everyday_words(path: Path = EVERYDAY) -> set[str]:
    """The words that need no entry; a line that begins with # is a comment."""
    lines = path.read_text("utf-8").splitlines()
    return {word for line in lines if not line.startswith("#") for word in line.split()}


def unexplained(texts: Texts, glossary: Glossary, everyday: set[str]) -> dict[str, list[str]]:
    """Each word without an entry that is no everyday word, with the places that use it."""
    spelt = sorted(glossary.senses_of, key=len, reverse=True)
    entries = re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, spelt))})(?!\w)", re.IGNORECASE)
    known = everyday | {each for each in spelt if each.isalpha()}
    found: dict[str, list[str]] = defaultdict(list)
    for place, said in texts.items():
        for text in said:
            rest = entries.sub(" ", NOT_READ.sub(" ", CODE.sub(" ", text)))
            for word in {each.lower() for each in WORD.findall(rest)}:
                if not known & set(forms(word)) and place not in found[word]:
                    found[word].append(place)
    return {word: found[word] for word in sorted(found) if found[word]}


def forms(word: str) -> Iterator[str]:
    """The word itself, and what it may be a form of: `stopped` of `stop`, `tries` of `try`."""
    yield word
    for ending in ENDINGS:
        stem = word.removesuffix(ending)
        if stem == word or len(stem) < 2:
            continue
        yield stem
        yield stem + "e"
        if stem[-1] == "i":
            yield stem[:-1] + "y"
        if len(stem) > 2 and stem[-1] == stem[-2]:
            yield stem[:-1]
