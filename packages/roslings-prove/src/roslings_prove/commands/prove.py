"""`./roslings prove`: show that a lab's checks catch what they should."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip.errors import FAILED, INCONCLUSIVE, OK, WRONG_USE
from roslings import course
from roslings.commands.options import whole_number

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings_prove.telling import ProofLine


USUALLY_PROVEN = ("packages", "contract")
PROVABLE = (*USUALLY_PROVEN, "generated", "boundary", "rewritten", "variants", "walks")


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("labs", metavar="LAB", nargs="*", help="for example: topics")
    word.add_argument("--all", action="store_true", help="list what holds, too")
    word.add_argument(
        "--anyway", action="store_true", help="grade even where the files do not fit each other"
    )
    word.add_argument(
        "--drills", metavar="DAY|NAME", nargs="*", help="drills, of a day or by name (default: all)"
    )
    word.add_argument(
        "--packages",
        action="store_true",
        help="only: solution, starter and mutants get the verdicts that they must get",
    )
    word.add_argument(
        "--contract",
        action="store_true",
        help="only: each word of the card, and each sentence of the task, is judged",
    )
    word.add_argument(
        "--generated",
        action="store_true",
        help="make 100 wrong packages of the solution; 95 of 100 must be caught",
    )
    word.add_argument(
        "--boundary",
        action="store_true",
        help="let 60 things go wrong between its nodes and ROS; 98 of 100 must be caught",
    )
    word.add_argument(
        "--keep",
        metavar="DIR",
        type=Path,
        help="with --generated, --boundary: where results stay, so that an interrupted run goes on",
    )
    word.add_argument(
        "--so-far",
        action="store_true",
        help="with --generated, --boundary: grade nothing, and tell what is known",
    )
    word.add_argument(
        "--keep-kills",
        action="store_true",
        help="with --generated: name a few that were caught, for prove --record",
    )
    word.add_argument(
        "--rewritten",
        action="store_true",
        help="write the solution in other ways; each must get 100",
    )
    word.add_argument(
        "--variants",
        action="store_true",
        help="each value of variants.yaml: the solution in these words gets 100",
    )
    word.add_argument(
        "--walks",
        action="store_true",
        help="a lab whose nodes have states: its solution keeps its word in 100 orders of events",
    )
    word.add_argument(
        "--kept",
        action="store_true",
        help="judge all proofs that are kept, and say which are stale; runs no node",
    )
    word.add_argument(
        "--prices",
        action="store_true",
        help="what each kept wrong package lost in points, and by what; runs no node",
    )
    word.add_argument(
        "--record",
        action="store_true",
        help="measure what is stale, and keep the proofs of it; with --due: all that is due",
    )
    word.add_argument(
        "--due", action="store_true", help="measure what must be measured before a landing"
    )
    word.add_argument(
        "--told",
        metavar="FILE",
        type=Path,
        help="with --due: what came of each package, a line of JSON each",
    )
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )


def run(options: argparse.Namespace) -> int:
    """Prove labs' packages and contracts, and say what is not as it must be."""
    if options.drills is not None:
        return _prove_drills(options)
    if options.prices:
        return _tell_prices(options.labs)
    if options.kept or options.record or options.due:
        return _prove_kept(options)
    return _prove_labs(options)


def _prove_labs(options: argparse.Namespace) -> int:
    if not options.labs:
        print("roslings: name a lab, or --drills. For example: topics", file=sys.stderr)
        return WRONG_USE
    from roslings.report.progress import ProgressLine
    from roslings_class.command import ProgressTeller
    from roslings_prove.prove import Proof
    from roslings_prove.telling import told

    names = [name for name in PROVABLE if getattr(options, name)]
    parts = [_proofs_of(name, options) for name in names or USUALLY_PROVEN]
    labs = [course.lab(name) for name in dict.fromkeys(options.labs)]
    seen = _seen_in_files(labs, with_contract=options.contract or not names)
    if not options.anyway and _do_not_fit(seen, options):
        print("Nothing was graded. Mend this first, or grade all the same: --anyway")
        return FAILED
    try:
        with ProgressLine() as progress:
            graded = [
                line
                for part in parts
                for line in part(labs, ProgressTeller(progress), options.jobs)
            ]
    except KeyboardInterrupt:
        if options.generated or options.boundary:
            print("\nWhat is graded is kept. The same command goes on from here.", file=sys.stderr)
        raise
    lines = [*seen, *graded]
    for text in told(lines, all_of_them=options.all):
        print(text)
    wrong = [line for line in lines if isinstance(line, Proof) and not line.holds]
    if not wrong:
        for lab in labs:
            only = f": its {' and '.join(names)} only" if names else ""
            print(f"The lab {lab.name!r} is proven{only}.")
        return OK
    return INCONCLUSIVE if all(proof.is_open for proof in wrong) else FAILED


def _seen_in_files(labs: Iterable[Lab], *, with_contract: bool) -> list[ProofLine]:
    """What can be seen without running anything.

    Its task is looked at where its files fit: until then some of what accounts for it is missing.
    """
    from roslings_prove.consistency import files_fit
    from roslings_prove.contract import contract_is_told

    seen: list[ProofLine] = []
    for lab in labs:
        proofs = list(files_fit(lab))
        seen += proofs
        if with_contract and all(proof.holds for proof in proofs):
            seen += contract_is_told(lab)
    return seen


def _do_not_fit(seen: Sequence[ProofLine], options: argparse.Namespace) -> bool:
    """Whether some of it is wrong; then that is said."""
    from roslings_prove.prove import Proof
    from roslings_prove.telling import told

    if all(line.holds for line in seen if isinstance(line, Proof)):
        return False
    for text in told(seen, all_of_them=options.all):
        print(text)
    return True


def _prove_drills(options: argparse.Namespace) -> int:
    """Prove drills: all, those of days, or some by name."""
    from roslings_prove.drills import chosen, prove_drills
    from roslings_prove.telling import told

    drills = chosen(options.drills)
    lines = list(prove_drills(drills, options.jobs))
    for text in told(lines, all_of_them=options.all):
        print(text)
    wrong = [line for line in lines if not line.holds]
    if not wrong:
        print(f"{len(drills)} drills are proven.")
        return OK
    return INCONCLUSIVE if all(proof.is_open for proof in wrong) else FAILED


def _prove_kept(options: argparse.Namespace) -> int:
    """Judge kept proofs; measure what is stale or due."""
    from roslings.report.progress import ProgressLine
    from roslings_class.command import ProgressTeller
    from roslings_prove.proofs.command import due, kept, labs_or_all, recorded
    from roslings_prove.prove import Proof
    from roslings_prove.telling import told

    labs = labs_or_all(options.labs)
    if _do_not_fit(_seen_in_files(labs, with_contract=False), options):
        print("No proof was judged or made. Mend this first.")
        return FAILED
    with ProgressLine() as progress:
        teller = ProgressTeller(progress)
        lines = [
            *(kept(labs) if options.kept else ()),
            *(recorded(labs, teller, options.jobs, due=options.due) if options.record else ()),
            *(
                due(labs, teller, options.jobs, options.told)
                if options.due and not options.record
                else ()
            ),
        ]
    for text in told(lines, all_of_them=options.all):
        print(text)
    wrong = [line for line in lines if isinstance(line, Proof) and not line.holds]
    if not wrong:
        return OK
    return INCONCLUSIVE if all(proof.is_open for proof in wrong) else FAILED


def _tell_prices(names: Sequence[str]) -> int:
    """The price list of each lab."""
    from roslings_prove.prices import INDENT, price_list
    from roslings_prove.proofs.command import labs_or_all
    from roslings_prove.proofs.kept import kept_here
    from roslings_prove.telling import wrapped

    for lab in labs_or_all(names):
        for line in price_list(lab, kept_here()).lines():
            print("\n".join(wrapped(line, INDENT)))
    return OK


def _proofs_of(name: str, options: argparse.Namespace) -> Callable[..., Iterable[Any]]:
    """What proves a part of labs; all that it tells has a `line`. LibCST is only where needed."""
    if name == "generated":
        from roslings_prove.generated.run import proofs_for

        return proofs_for(options.keep, options.so_far, options.keep_kills)
    if name == "boundary":
        from roslings_prove.boundary.run import proofs_for as proofs_at_the_boundary

        return proofs_at_the_boundary(options.keep, options.so_far)
    if name == "rewritten":
        from roslings_prove.rewritten import prove_rewritten

        return prove_rewritten
    if name == "variants":
        from roslings_prove.variants import prove_variants

        return prove_variants
    if name == "walks":
        from roslings_prove.walks import prove_walks

        return prove_walks
    if name == "contract":
        from roslings_prove.contract import prove_contract

        return prove_contract
    from roslings_prove.prove import prove as prove_packages

    return prove_packages
