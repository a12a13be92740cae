"""Orders in which things happen to a program with a state: drawn from a small model of it.

A lab's grader says as a model what the card says of the program: which events are possible now,
and what follows from one. Walks through it are drawn here. The lab's experiment makes the events
happen, one after the other, and its demand holds each step against the model.
"""

from roslings.walks.drawing import Impossible, WalkModel, drawn_walk, first_difference, states_on

__all__ = ["Impossible", "WalkModel", "drawn_walk", "first_difference", "states_on"]
