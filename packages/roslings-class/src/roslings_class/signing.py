"""The key of a class, and what it signs: the evidence that was measured for this gradebook.

A signature holds for one submission, its content, one try and one lab. So evidence that was
edited, or brought from somewhere else, is seen. It holds off who can write the gradebook, or hands
in evidence, and cannot read the key; who can read the key can sign.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import os
import secrets
import stat
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings.report.whole_file import CannotWriteFile
from roslings_class.errors import BatchError

FILE = "class.key"
BYTES = 32
FORM = 1
"""What is signed, and how: another number, another signature."""
PUT_BACK = "Put the key back that was there, from a backup."
OPEN_TO_OTHERS = stat.S_IRWXG | stat.S_IRWXO
ANEW = "Without one, grade the submissions into a new folder: --out DIR"


class BadKey(BatchError):
    """The key that lies beside a gradebook is none, or is not there."""


@dataclass(frozen=True)
class EvidenceOrigin:
    """What a piece of evidence belongs to."""

    lab: str
    submission: str
    digest: str
    attempt: int


@dataclass(frozen=True)
class ClassKey:
    """Signs what was measured here, and knows its own signatures."""

    secret: bytes

    @property
    def name(self) -> str:
        """Tells this key from others, and nothing of its secret."""
        return hashlib.sha256(b"roslings class key\0" + self.secret).hexdigest()[:16]

    def sign(self, origin: EvidenceOrigin, content: bytes) -> bytes:
        """The signature of `content` as evidence for this one try."""
        words = [FORM, origin.lab, origin.submission, origin.digest, origin.attempt]
        signed = hmac.new(self.secret, json.dumps(words).encode() + b"\0", hashlib.sha256)
        signed.update(content)
        return signed.digest()

    def has_signed(self, origin: EvidenceOrigin, content: bytes, signature: bytes) -> bool:
        """Whether this very content was signed for this very try."""
        return hmac.compare_digest(self.sign(origin, content), signature)


def make_key(folder: Path) -> ClassKey:
    """A new key in `folder`, for its owner alone; whole or not at all. Raises CannotWriteFile."""
    key = ClassKey(secrets.token_bytes(BYTES))
    part = folder / f".{FILE}-{os.getpid()}.part"
    try:
        with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(key.secret.hex().encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())
        part.replace(folder / FILE)
    except OSError as error:
        raise CannotWriteFile(folder / FILE, error) from error
    finally:
        part.unlink(missing_ok=True)
    return key


def read_key(folder: Path) -> ClassKey | None:
    """The key in `folder`; None where there is none. Raises BadKey."""
    file = folder / FILE
    step = f"{PUT_BACK}\n{ANEW}"
    try:
        content = os.fdopen(os.open(file, os.O_RDONLY | os.O_NOFOLLOW), "rb").read(4 * BYTES)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise BadKey(f"{from_here(file)} cannot be read: {error.strerror}.", step) from error
    try:
        secret = bytes.fromhex(content.decode("ascii"))
    except ValueError:
        secret = b""
    if len(secret) != BYTES:
        raise BadKey(f"{from_here(file)} is no key: it was changed, or cut off.", step)
    return ClassKey(secret)


def close_to_others(folder: Path) -> list[str]:
    """See to it that nobody else can read the key; what an instructor has to know."""
    file = folder / FILE
    if not _is_open(file):
        return []
    try:
        file.chmod(0o600)
    except OSError as error:
        return [_still_open(file, error.strerror or "it is not yours")]
    if _is_open(file):
        return [_still_open(file, "this file system has no permissions")]
    return [
        f"{from_here(file)} could be read by others on this machine. Now it cannot.\n"
        "Who has read it can sign evidence. In doubt, grade into a new folder: --out DIR"
    ]


def _is_open(file: Path) -> bool:
    return bool(file.stat().st_mode & OPEN_TO_OTHERS)


def _still_open(file: Path, reason: str) -> str:
    return (
        f"{from_here(file)} can be read by others, and cannot be closed here ({reason}).\n"
        "Who reads it can sign evidence. Give a place that is yours alone: --out ~/grades"
    )
