"""Judge evidence: a pytest plugin, the demands a grader can make, and the faults they raise.

Knows points; knows no ROS and no processes.
"""

from roslings.judge.check import check
from roslings.judge.demands import (
    be_a_picture,
    be_built_as,
    be_named,
    be_the_only_one,
    be_there,
    be_well_formed,
    carry_its_type,
    come_up,
    during,
    end_within,
    exit_cleanly,
    have_just_this_qos,
    hold_just,
    install,
    list_what_it_imports,
    log_each,
    match_qos,
    outlast_the_soak,
    repeat,
    stay_up,
)
from roslings.judge.every_package import depends, well_formed
from roslings.judge.faults import Fault, Inconclusive, NothingToJudge
from roslings.judge.grader_mistakes import BadGrader, GraderBroke
from roslings.judge.judge import judge
from roslings.judge.unobserved import speak_unobserved
from roslings.judge.views import ExperimentView, PackageView

__all__ = [
    "BadGrader",
    "ExperimentView",
    "Fault",
    "GraderBroke",
    "Inconclusive",
    "NothingToJudge",
    "PackageView",
    "be_a_picture",
    "be_built_as",
    "be_named",
    "be_the_only_one",
    "be_there",
    "be_well_formed",
    "carry_its_type",
    "check",
    "come_up",
    "depends",
    "during",
    "end_within",
    "exit_cleanly",
    "have_just_this_qos",
    "hold_just",
    "install",
    "judge",
    "list_what_it_imports",
    "log_each",
    "match_qos",
    "outlast_the_soak",
    "repeat",
    "speak_unobserved",
    "stay_up",
    "well_formed",
]
