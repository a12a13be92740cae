"""Evidence made by hand: what the judge sees is plain values."""

from __future__ import annotations

from collections.abc import Sequence

from roslings.evidence import MessageSeen

MS = 1_000_000
EPOCH_NS = 1_700_000_000 * 1_000_000_000


def messages(times_ms: Sequence[float], sequence: Sequence[int] | None = None) -> list[MessageSeen]:
    """Messages sent at these times, each arriving 1 ms later."""
    counts = sequence or range(1, len(times_ms) + 1)
    return [
        MessageSeen(
            source_ns=int(1_700_000_000e9 + t * MS),
            sequence=n,
            arrival_ns=int((t + 1) * MS),
            size=9,
        )
        for t, n in zip(times_ms, counts, strict=True)
    ]
