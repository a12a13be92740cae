"""Proofs that are kept: what was measured once is judged again, until what measures has changed."""
