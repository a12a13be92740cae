"""The gradebook: one SQLite file, one transaction a result. What it holds survives everything."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from roslings_class.errors import BadGradebook
from roslings_class.result import GradingResult
from roslings_class.signing import ClassKey, EvidenceOrigin

FILE = "gradebook.sqlite"
SCHEMA_VERSION = 2
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
    signature BLOB,
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
UPGRADES = {1: "ALTER TABLE evidence ADD COLUMN signature BLOB;"}
"""From each earlier schema to the next one."""
WAIT_S = 30.0
SIGNED_BY = "key"
"""A fact about the whole: the name of the key that signs its evidence."""
UNSIGNED = "its signature was taken away"
CHANGED = "it was changed, or is of something else"
OTHER_ATTEMPT = "it is of another try"
NO_KEY = "the key of the class is not there"


@dataclass(frozen=True)
class Override:
    """A score that a person gave, and why."""

    submission: str
    score: float
    reason: str
    by: str
    written: str


@dataclass(frozen=True)
class _Kept:
    """A line of the table of evidence."""

    attempt: int
    content: bytes
    signature: bytes | None


OF_ONE = "FROM evidence WHERE submission=? AND digest=?"


class Gradebook:
    """All that is known of the submissions to one lab."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection
        self._key: ClassKey | None = None

    def write(self, result: GradingResult, evidence: bytes | None = None) -> None:
        """Put down one result, with its evidence, in one transaction. The same one twice is one.

        Evidence of an earlier try goes: the verdict does not come from it.
        """
        with self._transaction() as connection:
            _put_result(connection, result)
            if evidence is not None:
                self._put_evidence(result, evidence)
            elif result.verdict is not None:
                connection.execute(f"DELETE {OF_ONE}", (result.submission, result.digest))

    def judged_again(self, result: GradingResult, evidence: bytes) -> None:
        """Put down what came of evidence that is here already; from now on it is of this try."""
        with self._transaction() as connection:
            _put_result(connection, result)
            self._put_evidence(result, evidence)

    def _put_evidence(self, result: GradingResult, content: bytes) -> None:
        key = (result.submission, result.digest, result.attempt)
        signature = self._key.sign(self._origin(*key), content) if self._key else None
        self._connection.execute(
            "INSERT OR REPLACE INTO evidence (submission, digest, attempt, content, signature)"
            " VALUES (?, ?, ?, ?, ?)",
            (*key, content, signature),
        )

    def _origin(self, submission: str, digest: str, attempt: int) -> EvidenceOrigin:
        return EvidenceOrigin(self.about("lab") or "", submission, digest, attempt)

    def latest(self) -> dict[str, GradingResult]:
        """Submission to the newest result of it, by name."""
        rows = self._connection.execute("SELECT result FROM latest ORDER BY submission")
        results = (GradingResult.model_validate_json(text) for (text,) in rows)
        return {result.submission: result for result in results}

    def first_graded(self) -> dict[str, datetime]:
        """Submission to when the content that counts was graded first."""
        rows = self._connection.execute(
            "SELECT results.submission, min(results.written) FROM results"
            " JOIN latest USING (submission, digest) GROUP BY results.submission"
        )
        return {name: datetime.fromisoformat(written) for name, written in rows}

    def attempts(self, submission: str, digest: str) -> int:
        """How often this very content was tried."""
        query = "SELECT coalesce(max(attempt), 0) FROM results WHERE submission=? AND digest=?"
        (count,) = self._connection.execute(query, (submission, digest)).fetchone()
        return int(count)

    def evidence(self, result: GradingResult) -> bytes | None:
        """The packed evidence that a result was judged from.

        None where none was kept, and where evidence is signed and this was not measured here.
        """
        row = self._evidence_of(result)
        return None if row is None or self.why_not(result) else row.content

    def why_not(self, result: GradingResult) -> str:
        """Why the evidence of a result is not what was measured here; empty where it is."""
        row = self._evidence_of(result)
        if row is None or not self.signed_by():
            return ""
        if self._key is None:
            return NO_KEY
        if row.signature is None:
            return UNSIGNED
        origin = self._origin(result.submission, result.digest, row.attempt)
        if not self._key.has_signed(origin, row.content, row.signature):
            return CHANGED
        return "" if row.attempt == result.attempt else OTHER_ATTEMPT

    def forged(self) -> dict[str, str]:
        """Submissions whose newest verdict has evidence that was not measured here, and why."""
        judged = (result for result in self.latest().values() if result.verdict)
        return {result.submission: why for result in judged if (why := self.why_not(result))}

    def _evidence_of(self, result: GradingResult) -> _Kept | None:
        query = f"SELECT attempt, content, signature {OF_ONE}"
        row = self._connection.execute(query, (result.submission, result.digest)).fetchone()
        return _Kept(*row) if row else None

    def signed_by(self) -> str | None:
        """The name of the key that signs the evidence; None where it is not signed."""
        return self.about(SIGNED_BY)

    def has_evidence(self) -> bool:
        """Whether any was kept."""
        return bool(self._connection.execute("SELECT 1 FROM evidence LIMIT 1").fetchone())

    def use(self, key: ClassKey) -> None:
        """Sign with this key from now on, and believe what it has signed."""
        self._key = key

    def sign_all(self, key: ClassKey) -> int:
        """Sign what was kept before there was a key: once in the life of a gradebook; how many."""
        self.use(key)
        with self._transaction() as connection:
            signed = [self._sign(result) for result in self._judged_last()]
            connection.execute("INSERT OR REPLACE INTO about VALUES (?, ?)", (SIGNED_BY, key.name))
        return sum(signed)

    def _judged_last(self) -> Iterable[GradingResult]:
        """Of each content its newest verdict: from its evidence all verdicts of it came."""
        rows = self._connection.execute("SELECT result FROM results ORDER BY attempt").fetchall()
        results = (GradingResult.model_validate_json(text) for (text,) in rows)
        return {(one.submission, one.digest): one for one in results if one.verdict}.values()

    def _sign(self, result: GradingResult) -> bool:
        if kept := self._evidence_of(result):
            self._put_evidence(result, kept.content)
        return kept is not None

    def override(self, submission: str, score: float, reason: str, by: str) -> None:
        """Put a person's score beside the measured one, which stays."""
        with self._transaction() as connection:
            connection.execute(
                "INSERT INTO overrides (submission, score, reason, by, written)"
                " VALUES (?, ?, ?, ?, ?)",
                (submission, score, reason, by, _now()),
            )

    def forget(self, submission: str) -> None:
        """Delete every row of a submission. What is deleted is overwritten, too: `shrink`."""
        with self._transaction() as connection:
            for table in ("results", "evidence", "overrides"):
                connection.execute(f"DELETE FROM {table} WHERE submission=?", (submission,))

    def shrink(self) -> None:
        """Write the file anew without what was deleted, so that no byte of it stays."""
        self._connection.execute("VACUUM")
        self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

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
    for earlier in range(version, SCHEMA_VERSION) if version else ():
        connection.executescript(
            f"BEGIN IMMEDIATE; {UPGRADES[earlier]} PRAGMA user_version={earlier + 1}; COMMIT;"
        )
    return Gradebook(connection)


def _insist_on_lab(book: Gradebook, lab: str, file: Path) -> None:
    if book.about("lab") != lab:
        problem = f"{file} is the gradebook of the lab {book.about('lab')!r}, not of {lab!r}."
        raise BadGradebook(problem, "Give another folder: --out DIR")


def _put_result(connection: sqlite3.Connection, result: GradingResult) -> None:
    key = (result.submission, result.digest, result.attempt)
    words = (result.word, result.score, result.model_dump_json(by_alias=True), _now())
    connection.execute(
        "INSERT OR REPLACE INTO results"
        " (submission, digest, attempt, word, score, result, written)"
        " VALUES (?, ?, ?, ?, ?, ?, ?)",
        (*key, *words),
    )


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
