"""Prove that a lab takes any right package: the solution, written in other ways, gets 100 too."""

from roslings_prove.rewritten.grading import Rewritten, Score, prove_rewritten, rewritten

__all__ = ["Rewritten", "Score", "prove_rewritten", "rewritten"]
