"""The gradebook: one SQLite file, one transaction a result. What it holds survives everything."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from roslings.batch.errors import BadGradebook
from roslings.batch.result import Result

FILE = "gradebook.sqlite"
SCHEMA_VERSION = 1
SCHEMA = """
CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE results (
    id INTEGER PRIMARY KEY,
    submission TEXT NOT NULL,
    digest TEXT NOT NULL,
    attempt INTEGER NOT NULL,
    word TEXT NOT NULL,
    score REAL,
    result TEXT NOT NULL,
    written TEXT NOT NULL,
    UNIQUE (submission, digest, attempt)
);
CREATE TABLE evidence (
    submission TEXT NOT NULL,
    digest TEXT NOT NULL,
    attempt INTEGER NOT NULL,
    content BLOB NOT NULL,
    PRIMARY KEY (submission, digest)
);
CREATE TABLE overrides (
    id INTEGER PRIMARY KEY,
    submission TEXT NOT NULL,
    score REAL NOT NULL,
    reason TEXT NOT NULL,
    by TEXT NOT NULL,
    written TEXT NOT NULL
);
CREATE VIEW latest AS
    SELECT * FROM results WHERE id IN (SELECT max(id) FROM results GROUP BY submission);
"""
WAIT_S = 30.0


@dataclass(frozen=True)
class Override:
    """A score that a person gave, and why."""

    submission: str
    score: float
    reason: str
    by: str
    written: str


class Gradebook:
    """All that is known of the submissions to one lab."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection

    def write(self, result: Result, evidence: bytes | None = None) -> None:
        """Put down one result, with its evidence, in one transaction. The same one twice is one."""
        key = (result.submission, result.digest, result.attempt)
        words = (result.word, result.score, result.model_dump_json(by_alias=True), _now())
        with self._transaction() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO results"
                " (submission, digest, attempt, word, score, result, written)"
                " VALUES (?, ?, ?, ?, ?, ?, ?)",
                (*key, *words),
            )
            if evidence is not None:
                connection.execute("INSERT OR REPLACE INTO evidence VALUES (?, ?, ?, ?)",
                                   (*key, evidence))  # fmt: skip

    def latest(self) -> dict[str, Result]:
        """Submission to the newest result of it, by name."""
        rows = self._connection.execute("SELECT result FROM latest ORDER BY submission")
        results = (Result.model_validate_json(text) for (text,) in rows)
        return {result.submission: result for result in results}

    def attempts(self, submission: str, digest: str) -> int:
        """How often this very content was tried."""
        query = "SELECT coalesce(max(attempt), 0) FROM results WHERE submission=? AND digest=?"
        (count,) = self._connection.execute(query, (submission, digest)).fetchone()
        return int(count)

    def evidence(self, result: Result) -> bytes | None:
        """The packed evidence that a result was judged from; None where none was kept."""
        query = "SELECT content FROM evidence WHERE submission=? AND digest=?"
        row = self._connection.execute(query, (result.submission, result.digest)).fetchone()
        return bytes(row[0]) if row else None

    def override(self, submission: str, score: float, reason: str, by: str) -> None:
        """Put a person's score beside the measured one, which stays."""
        with self._transaction() as connection:
            connection.execute(
                "INSERT INTO overrides (submission, score, reason, by, written)"
                " VALUES (?, ?, ?, ?, ?)",
                (submission, score, reason, by, _now()),
            )

    def overrides(self) -> dict[str, Override]:
        """Submission to the newest score that a person gave."""
        rows = self._connection.execute(
            "SELECT submission, score, reason, by, written FROM overrides ORDER BY id"
        )
        return {row[0]: Override(*row) for row in rows}

    def about(self, key: str) -> str | None:
        """A fact about the whole, e.g. `lab`."""
        row = self._connection.execute("SELECT value FROM about WHERE key=?", (key,)).fetchone()
        return str(row[0]) if row else None

    def note(self, key: str, value: str) -> None:
        """Put down a fact about the whole."""
        with self._transaction() as connection:
            connection.execute("INSERT OR REPLACE INTO about VALUES (?, ?)", (key, value))

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            yield self._connection
        except BaseException:
            self._connection.execute("ROLLBACK")
            raise
        self._connection.execute("COMMIT")


@contextmanager
def gradebook(folder: Path, lab: str) -> Iterator[Gradebook]:
    """The gradebook of a lab in `folder`, made where there is none. Raises BadGradebook."""
    file = folder / FILE
    try:
        with closing(sqlite3.connect(file, timeout=WAIT_S, isolation_level=None)) as connection:
            book = _prepared(connection, file)
            if book.about("lab") is None:
                book.note("lab", lab)
            _insist_on_lab(book, lab, file)
            yield book
    except sqlite3.DatabaseError as error:
        step = "Give another folder with --out, or look at the file: is the disk full?"
        raise BadGradebook(f"{file}: {error}.", step) from error


def lab_of(folder: Path) -> str | None:
    """The lab whose gradebook lies in `folder`; None where none does."""
    if not (folder / FILE).is_file():
        return None
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return Gradebook(connection).about("lab")


def _prepared(connection: sqlite3.Connection, file: Path) -> Gradebook:
    """A power cut loses nothing that was committed: WAL, and synchronous to the full."""
    connection.execute("PRAGMA journal_mode=WAL")
    connection.execute("PRAGMA synchronous=FULL")
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if version > SCHEMA_VERSION:
        problem = f"{file} was made by a newer roslings (schema {version})."
        raise BadGradebook(problem, "Bring roslings up to date: git pull")
    if version == 0:
        connection.executescript(
            f"BEGIN IMMEDIATE; {SCHEMA} PRAGMA user_version={SCHEMA_VERSION}; COMMIT;"
        )
    return Gradebook(connection)


def _insist_on_lab(book: Gradebook, lab: str, file: Path) -> None:
    if book.about("lab") != lab:
        problem = f"{file} is the gradebook of the lab {book.about('lab')!r}, not of {lab!r}."
        raise BadGradebook(problem, "Give another folder: --out DIR")


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
