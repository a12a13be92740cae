"""All rewrites, by name, and the packages that they make of a lab's solution."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from roslings_prove.rewritten.arguments import keyword_arguments
from roslings_prove.rewritten.callbacks import (
    a_rate_in_a_thread,
    async_callbacks,
    reentrant_groups,
)
from roslings_prove.rewritten.composition import composition_for_inheritance
from roslings_prove.rewritten.functions import extracted, inlined
from roslings_prove.rewritten.goals import a_goal_that_sleeps
from roslings_prove.rewritten.layout import (
    all_files_into_one,
    methods_in_another_order,
    one_file_into_three,
    stripped,
)
from roslings_prove.rewritten.names import (
    renamed_attributes,
    renamed_classes,
    renamed_functions,
    renamed_variables,
)
from roslings_prove.rewritten.parameters import noted_by_a_callback, read_live, values_by_type
from roslings_prove.rewritten.qos import another_qos_that_fits, longer_queues
from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.spinning import a_loop_of_spin_once, a_with_block, multi_threaded
from roslings_prove.rewritten.texts import (
    double_quotes,
    format_for_f_strings,
    logger_for_print,
    other_quotes_in_lines,
    percent_for_f_strings,
    print_for_the_logger,
)

Rewrite = Callable[[Sources], Sources]
"""Gives the same sources back where it does not apply."""

REWRITES: Mapping[str, Rewrite] = {
    each.__name__.replace("_", " "): each
    for each in (
        one_file_into_three,
        all_files_into_one,
        extracted,
        inlined,
        values_by_type,
        read_live,
        noted_by_a_callback,
        a_rate_in_a_thread,
        a_goal_that_sleeps,
        multi_threaded,
        a_loop_of_spin_once,
        a_with_block,
        reentrant_groups,
        async_callbacks,
        longer_queues,
        another_qos_that_fits,
        print_for_the_logger,
        logger_for_print,
        other_quotes_in_lines,
        format_for_f_strings,
        percent_for_f_strings,
        keyword_arguments,
        composition_for_inheritance,
        methods_in_another_order,
        renamed_classes,
        renamed_functions,
        renamed_attributes,
        renamed_variables,
        stripped,
        double_quotes,
    )
}
"""In the order in which several are made: each finds what it looks for after those before it."""

COMBINATIONS, TOGETHER = 3, 5
"""So many packages of so many rewrites each."""
SEED = 19


@dataclass(frozen=True)
class RewrittenSources:
    """A right package, made from another one."""

    name: str
    sources: Sources


def made_from(sources: Sources) -> list[RewrittenSources]:
    """One package for each rewrite that applies, and a few for several at once."""
    single = {name: RewrittenSources(name, new) for name, new in _applied(sources, list(REWRITES))}
    return [*single.values(), *_combinations(sources, list(single))]


def _applied(sources: Sources, names: Sequence[str]) -> Iterator[tuple[str, Sources]]:
    for name in names:
        new = REWRITES[name](sources)
        if new != sources:
            yield name, new


def _combinations(sources: Sources, names: Sequence[str]) -> Iterator[RewrittenSources]:
    """Chosen by chance, and for one package always the same."""
    chance = random.Random(f"{SEED} {sources.card.package}")
    for _ in range(COMBINATIONS if len(names) > 1 else 0):
        chosen = chance.sample(names, min(TOGETHER, len(names)))
        made = all_at_once(sources, [name for name in REWRITES if name in chosen])
        yield made


def all_at_once(sources: Sources, names: Sequence[str]) -> RewrittenSources:
    """One rewrite after the other; what no longer applies is left out."""
    done = []
    for name in names:
        new = REWRITES[name](sources)
        if new != sources:
            done.append(name)
        sources = new
    return RewrittenSources(" + ".join(done), sources)
