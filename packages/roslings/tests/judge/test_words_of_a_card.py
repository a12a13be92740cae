"""A node and a card by the words of a capability: the same thing, or a sentence why not."""

from __future__ import annotations

import pickle

import pytest

from roslings.capabilities.launch.contract import LaunchContract, LaunchWords
from roslings.capabilities.parameters.contract import ParameterContract, ParameterWords
from roslings.capability import capabilities
from roslings.course import Card, NodeContract
from roslings.course.contract import CardWords, NodeWords

FAST = ParameterContract(name="fast", type="bool", about="its pace", default=False, tried=True)
FAR = ParameterContract(name="far", type="double", about="metres", default=1.0, tried=2.0)
NODE = NodeContract.model_validate(
    {"node": "/it", "executable": "it", "parameters": (FAST.model_dump(), FAR.model_dump())}
)
CARD = Card.model_validate(
    {
        "id": "it",
        "title": "It",
        "day": "03-topics",
        "package": "it",
        "nodes": [NODE.model_dump()],
        "points": {"runs": 100},
        "launch": {"file": "launch/it.launch.xml", "starts": ["it"]},
    }
)
NODES = [words.node for each in capabilities() if (words := each.words_here) and words.node]
PACKAGES = [words.card for each in capabilities() if (words := each.words_here) and words.card]


class Strange(NodeWords):
    """Words of a node that no capability brings."""

    strange: bool = False


class Foreign(CardWords):
    """Words of the package that no capability brings."""

    foreign: bool = False


@pytest.mark.parametrize("words", NODES, ids=lambda words: words.__name__)
def test_a_node_has_the_words_of_each_capability(words: type[NodeWords]) -> None:
    """It is the same node."""
    assert NODE.of(words) is NODE


@pytest.mark.parametrize("words", PACKAGES, ids=lambda words: words.__name__)
def test_a_card_has_the_words_of_each_capability(words: type[CardWords]) -> None:
    """It is the same card."""
    assert CARD.of(words) is CARD


def test_what_was_said_is_there() -> None:
    """In the order of the card, and by names in the order of these."""
    said = NODE.of(ParameterWords)
    assert said.parameters == (FAST, FAR)
    assert said.parameter("far") == FAR
    assert said.named("far", "fast") == (FAR, FAST)
    with pytest.raises(KeyError, match="slow"):
        said.named("fast", "slow")
    launch = LaunchContract(file="launch/it.launch.xml", starts=("it",))
    assert CARD.of(LaunchWords).launch == launch


def test_a_copy_has_them_too() -> None:
    """Changed, pickled, and written as JSON."""
    moved = NODE.model_copy(update={"node": "/there"})
    again = NodeContract.model_validate_json(moved.model_dump_json())
    for copy in (moved, again, pickle.loads(pickle.dumps(moved))):
        assert copy == moved and copy.node == "/there"
        assert copy.of(ParameterWords).named("fast") == (FAST,)


def test_words_that_nobody_brings_are_told() -> None:
    """By their class, where it lies, and of what they are."""
    with pytest.raises(TypeError, match=rf"brings Strange, of {__name__}, .* of a node$"):
        NODE.of(Strange)
    with pytest.raises(TypeError, match=rf"brings Foreign, of {__name__}, .* of the package$"):
        CARD.of(Foreign)
