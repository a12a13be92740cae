"""Fingerprints of a package's code, to find submissions that are nearly the same.

Source: S. Schleimer, D. S. Wilkerson and A. Aiken, "Winnowing: Local Algorithms for Document
Fingerprinting", SIGMOD 2003. Of the hashes of all runs of K tokens, the smallest in each window of
W hashes is kept. Whatever two texts share in W + K - 1 tokens leaves a common mark, and no run
shorter than K tokens ever does.

Names, numbers and texts each count as one kind of token, so that renaming hides nothing; comments
and blank lines do not count.
"""

from __future__ import annotations

import hashlib
import io
import keyword
import tokenize
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, takewhile
from pathlib import Path

from roslings.workspace.sources import files

K, W = 12, 8
LARGEST_FILE_BYTES = 500_000
MOST_TOKENS = 100_000
LONGEST_LINE = 2_000
KINDS = {tokenize.NAME: "n", tokenize.NUMBER: "0", tokenize.STRING: "s"}
UNSEEN = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.ENCODING,
    tokenize.ENDMARKER,
    tokenize.NEWLINE,
}


@dataclass(frozen=True)
class Fingerprint:
    """What is kept of a package's code."""

    whole: str
    """Of all tokens, names and texts included: equal where the code is equal."""
    marks: frozenset[int]


def fingerprint(package: Path, note: Callable[[str], object] = str) -> Fingerprint:
    """The fingerprint of the Python files of a package, setup.py and tests left out.

    `note` is told the name of each file before it is read.
    """
    exact, marks = hashlib.sha256(), set[int]()
    for name, path in sorted(files(package).items()):
        if not _counts(name) or path.stat().st_size > LARGEST_FILE_BYTES:
            continue
        note(name)
        tokens = list(islice(_tokens(path.read_bytes()), MOST_TOKENS))
        exact.update("\0".join(token.string for token in tokens).encode("utf-8", "replace"))
        marks |= set(winnowed([_kind(token) for token in tokens]))
    return Fingerprint(exact.hexdigest()[:32], frozenset(marks))


def _counts(name: str) -> bool:
    return name.endswith(".py") and name != "setup.py" and not name.startswith(("test/", "tests/"))


def _tokens(text: bytes) -> Iterator[tokenize.TokenInfo]:
    """The tokens up to the first place that is no Python."""
    try:
        for token in tokenize.tokenize(_short_lines(text).__next__):
            if token.type not in UNSEEN:
                yield token
    except (SyntaxError, ValueError, tokenize.TokenError):
        return


def _short_lines(text: bytes) -> Iterator[bytes]:
    """Up to the first line that nobody writes: Python's own reader takes the square of it."""
    return takewhile(lambda line: len(line) <= LONGEST_LINE, io.BytesIO(text))


def _kind(token: tokenize.TokenInfo) -> str:
    if token.type == tokenize.NAME and keyword.iskeyword(token.string):
        return token.string
    if token.type in (tokenize.INDENT, tokenize.DEDENT):
        return tokenize.tok_name[token.type]
    return KINDS.get(token.type, token.string)


def winnowed(tokens: Sequence[str]) -> Iterator[int]:
    """The marks of a run of tokens, the rightmost of the smallest in each window."""
    hashes = [_hash(tokens[start : start + K]) for start in range(len(tokens) - K + 1)]
    for start in range(max(len(hashes) - W + 1, min(len(hashes), 1))):
        yield min(hashes[start : start + W])


def _hash(run: Iterable[str]) -> int:
    digest = hashlib.blake2b("\0".join(run).encode("utf-8", "replace"), digest_size=6)
    return int.from_bytes(digest.digest(), "big")
