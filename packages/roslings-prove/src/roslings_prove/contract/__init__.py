"""Prove that each word of a lab's card is judged: change the word, and the solution must fail."""

from roslings_prove.contract.coverage import Coverage, contract_is_told, prove_contract

__all__ = ["Coverage", "contract_is_told", "prove_contract"]
