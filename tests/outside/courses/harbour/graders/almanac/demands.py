"""Demands on warnings."""

from __future__ import annotations

from graders.almanac import faults
from graders.almanac.contract import GaleWords
from graders.almanac.record import WindSeen

from roslings.course import NodeContract
from roslings.course.files import written
from roslings.judge import ExperimentView
from roslings.judge.faults import NothingToJudge
from roslings.judge.views import Demand


def warn_of_gales(node: NodeContract) -> Demand[ExperimentView]:
    """The card's line for each gale, and for no breeze."""
    template = written(node.log, node.node)
    above_m_s = written(node.of(GaleWords).warns_above_m_s, node.node)

    def demand(experiment: ExperimentView) -> None:
        texts = experiment.process(node).texts
        speeds_m_s = experiment.seen.part(WindSeen).speeds_m_s
        if not speeds_m_s:
            raise NothingToJudge("the node did not hear any wind")
        for speed_m_s in speeds_m_s:
            line = template.format(text=f"{speed_m_s:.1f}")
            is_told = any(line in text for text in texts)
            if speed_m_s > above_m_s and not is_told:
                raise faults.NoWarning(line)
            if speed_m_s <= above_m_s and is_told:
                raise faults.FalseWarning(line)

    return demand
