"""Prove that each word of a lab's card is judged: change the word, and the solution must fail."""

from roslings.authoring.contract.coverage import Coverage, prove_contract

__all__ = ["Coverage", "prove_contract"]
