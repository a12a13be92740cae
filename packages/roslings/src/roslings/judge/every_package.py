"""Checks that every lab's package has to pass; a grader takes them over by their names."""

from __future__ import annotations

from collections.abc import Callable

from roslings.judge.check import check
from roslings.judge.demands import be_well_formed, list_what_it_imports
from roslings.judge.views import PackageView

Check = Callable[[PackageView], None]


def well_formed(build_type: str) -> Check:
    """The check `well_formed` of a grader whose card asks for this build type.

    >>> test_well_formed = well_formed(CARD.build_type)
    """

    @check()
    def test_well_formed(package: PackageView) -> None:
        """The package has all its files, and ROS and Python can read them."""
        package.must(be_well_formed(build_type))

    return test_well_formed


@check()
def depends(package: PackageView) -> None:
    """package.xml names every ROS package that the code imports."""
    package.must(list_what_it_imports)
