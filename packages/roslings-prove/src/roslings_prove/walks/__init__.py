"""`./roslings prove LAB --walks`: the solution keeps its word in a hundred orders of events."""

from roslings_prove.walks.grading import DrawsNoWalks, WalkedSolution, prove_walks, walked_solutions

__all__ = ["DrawsNoWalks", "WalkedSolution", "prove_walks", "walked_solutions"]
