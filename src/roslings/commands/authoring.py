"""What an author of labs types."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from roslings import course
from roslings.errors import FAILED, INCONCLUSIVE, OK, WRONG_USE
from roslings.workspace.errors import from_here

if TYPE_CHECKING:
    from roslings.authoring.telling import Told
    from roslings.course import Lab

USUALLY_PROVEN = ("packages", "contract")
PROVABLE = (*USUALLY_PROVEN, "generated", "rewritten")


def new_lab(options: argparse.Namespace) -> int:
    """Make a small lab that works."""
    from roslings.authoring.new_lab import new_lab as make

    lab = make(options.lab, options.package, options.day)
    print(f"The lab {lab.name!r} is in {from_here(lab.folder)}.")
    print(f"Its grader is {from_here(lab.grader)}. Both work as they are; change them.")
    print(f"Then prove it: ./roslings prove {lab.name}")
    return OK


def prove(options: argparse.Namespace) -> int:
    """Prove labs' packages and contracts, and say what is not as it must be."""
    if options.drills is not None:
        return _prove_drills(options)
    if options.kept or options.record or options.due:
        return _prove_kept(options)
    return _prove_labs(options)


def _prove_labs(options: argparse.Namespace) -> int:
    if not options.labs:
        print("roslings: name a lab, or --drills. For example: topics", file=sys.stderr)
        return WRONG_USE
    from roslings.authoring.prove import Proof
    from roslings.authoring.telling import told
    from roslings.batch.command import Teller
    from roslings.report import Progress

    names = [name for name in PROVABLE if getattr(options, name)]
    parts = [_proofs_of(name, options) for name in names or USUALLY_PROVEN]
    labs = [course.lab(name) for name in dict.fromkeys(options.labs)]
    seen = _seen_in_files(labs, with_contract=options.contract or not names)
    if not options.anyway and _do_not_fit(seen, options):
        print("Nothing was graded. Mend this first, or grade all the same: --anyway")
        return FAILED
    try:
        with Progress() as progress:
            graded = [line for part in parts for line in part(labs, Teller(progress), options.jobs)]
    except KeyboardInterrupt:
        if options.generated:
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


def _seen_in_files(labs: Iterable[Lab], *, with_contract: bool) -> list[Told]:
    """What can be seen without running anything.

    Its task is looked at where its files fit: until then some of what accounts for it is missing.
    """
    from roslings.authoring.consistency import files_fit
    from roslings.authoring.contract import contract_is_told

    seen: list[Told] = []
    for lab in labs:
        proofs = list(files_fit(lab))
        seen += proofs
        if with_contract and all(proof.holds for proof in proofs):
            seen += contract_is_told(lab)
    return seen


def _do_not_fit(seen: Sequence[Told], options: argparse.Namespace) -> bool:
    """Whether some of it is wrong; then that is said."""
    from roslings.authoring.prove import Proof
    from roslings.authoring.telling import told

    if all(line.holds for line in seen if isinstance(line, Proof)):
        return False
    for text in told(seen, all_of_them=options.all):
        print(text)
    return True


def _prove_drills(options: argparse.Namespace) -> int:
    """Prove drills: all, those of days, or some by name."""
    from roslings.authoring.drills import chosen, prove_drills
    from roslings.authoring.telling import told

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
    from roslings.authoring.proofs.command import due, kept, labs_or_all, recorded
    from roslings.authoring.prove import Proof
    from roslings.authoring.telling import told
    from roslings.batch.command import Teller
    from roslings.report import Progress

    labs = labs_or_all(options.labs)
    if _do_not_fit(_seen_in_files(labs, with_contract=False), options):
        print("No proof was judged or made. Mend this first.")
        return FAILED
    with Progress() as progress:
        teller = Teller(progress)
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


def _proofs_of(name: str, options: argparse.Namespace) -> Callable[..., Iterable[Any]]:
    """What proves a part of labs; all that it tells has a `line`. LibCST is only where needed."""
    if name == "generated":
        from roslings.authoring.generated.run import proofs_for

        return proofs_for(options.keep, options.so_far, options.keep_kills)
    if name == "rewritten":
        from roslings.authoring.rewritten import prove_rewritten

        return prove_rewritten
    if name == "contract":
        from roslings.authoring.contract import prove_contract

        return prove_contract
    from roslings.authoring.prove import prove as prove_packages

    return prove_packages


def release(options: argparse.Namespace) -> int:
    """Make the students' edition."""
    from roslings.authoring.release import release as make

    edition = make(options.to)
    print(f"The students' edition is in {from_here(options.to)}: {len(edition.names)} files.")
    print("No solution, no mutant and no hidden check is in it.")
    for remark in edition.remarks:
        print(remark)
    return OK
