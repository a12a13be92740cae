"""The page for a browser: whole, without a neighbour, and deaf to what a student writes."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from html.parser import HTMLParser
from itertools import pairwise

import pytest
from written_evidence import evidence, messages, process, steady, talking
from written_graphs import STRING, graph
from written_verdicts import HINTS, TOO_SLOW, failing, left_open, too_slow, verdict

from ros2_on_pip.markup import prose, tag
from ros2_on_pip.rates import measure_rate
from roslings.evidence import Evidence, ExperimentSeen, LogLine, Qos, Segment, Spoken, Tick
from roslings.report.command_line import CommandLine
from roslings.report.html import OfClass, Own, RequiredRate, html_of
from roslings.report.html.interval_plot import BOTTOM, TOP, interval_plot
from roslings.report.html.intervals import watched
from roslings.report.html.slips import marked
from roslings.verdict import Verdict

ASKED = [RequiredRate("/chatter", STRING, 2.0, 1.9, 2.1)]
VOID = {"meta", "br", "rect", "path", "line", "ellipse"}
EVIL = "</pre></style><script>alert(1)</script><img src=//evil/x onerror=alert(2)>&\x1b[31m\u202e"


class Page(HTMLParser):
    """What a browser would make of the page."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: Counter[str] = Counter()
        self.classes: Counter[str] = Counter()
        self.attributes: set[str] = set()
        self.text = ""
        self.ids: list[str] = []
        self._open: list[str] = []
        self.feed(text)
        self.close()
        assert self._open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Count it."""
        self.tags[tag] += 1
        for name, value in attrs:
            self.attributes.add(name)
            self.classes.update((value or "").split() if name == "class" else ())
            self.ids += [value or ""] if name == "id" else []
        if tag not in VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Only an element that holds nothing ends itself."""
        assert tag in VOID
        self.handle_starttag(tag, attrs)

    def handle_endtag(self, tag: str) -> None:
        """It ends the one that was begun last."""
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        """Text, with what was escaped put back."""
        self.text += "" if self._open[-1:] == ["style"] else data


def page(seen: Evidence, found: Verdict | None = None) -> Page:
    """The page of a verdict on this evidence."""
    return Page(html_of(found or verdict(), seen, ASKED))


def test_the_page_stands_alone() -> None:
    """No script, no link, no picture from elsewhere, and a rule that forbids them."""
    text = html_of(verdict(), evidence(talking(messages(steady(0.5, 12)))), ASKED)
    found = Page(text)
    assert not {"script", "link", "img", "iframe", "a", "object"} & set(found.tags)
    assert not re.search(r"https?:|//|url\(|@import", text)
    assert not any(name.startswith("on") or name in ("src", "href") for name in found.attributes)
    assert "default-src &#x27;none&#x27;" in text
    assert len(found.ids) == len(set(found.ids))


def test_what_a_student_writes_is_text_and_nothing_else() -> None:
    """In names, logs, messages, advice and in the verdict's own words."""
    seen = talking(messages(steady(0.5, 12)), f"/{EVIL}", EVIL)
    seen.graph = graph(publishes=[(EVIL, f"/{EVIL}", EVIL)], nodes=[EVIL, EVIL])
    seen.rosout = {EVIL: [LogLine(arrival_ns=1, text=EVIL, source="rosout")]}
    seen.not_believed = EVIL
    seen.spoken = [
        Spoken(topic=EVIL, type=EVIL, content={EVIL: EVIL}, sent_ns=1, matched=False, offered=Qos())
    ]
    seen.processes[EVIL] = process(EVIL, EVIL)
    bad = evidence(seen, talking([]).model_copy(update={"name": EVIL}), package=EVIL)
    bad.attempts, bad.advice = [seen], [EVIL]
    words = {name: EVIL for name in ("expected", "measured", "why", "hint", "mend", "lesson")}
    failed = failing("rate", log=(EVIL,), hints=(EVIL,) * 3, **words)
    text = html_of(verdict(failed, advice=(EVIL,)), bad, ASKED)
    found = Page(text)
    plain = page(evidence(talking(messages(steady(0.5, 12)))), too_slow())
    assert set(found.tags) - {"ellipse", "section"} <= set(plain.tags)
    assert found.attributes <= plain.attributes | {"font-size"}
    assert "<script>alert(1)</script>" in found.text
    assert not re.search("[\x00-\x08\x0b-\x1f\u202e]", text)


def test_a_failure_says_all_that_the_verdict_says() -> None:
    """Expected, measured, why, what to try; each hint folded by itself."""
    found = page(evidence(), too_slow())
    for key in ("expected", "measured", "why", "hint", "lesson"):
        assert str(TOO_SLOW[key]) in found.text
    assert all(hint in found.text for hint in HINTS)
    passed_and_colcon = 2
    assert found.tags["details"] == len(HINTS) + passed_and_colcon
    mended = page(evidence(), verdict(failing("rate", **TOO_SLOW, mend="Take 0.5 s.")))
    assert "What mends it" in mended.text and "Take 0.5 s." in mended.text


def test_the_page_says_what_is_next() -> None:
    """As the terminal does, below the score."""
    assert 'Next Mend "rate", then check again: ./roslings check topics' in page(
        evidence(), too_slow()
    ).text.replace("\n", " ")
    assert "./roslings pack topics" in page(evidence()).text


def test_what_to_read_is_a_link_where_the_site_is_built() -> None:
    """And what is typed next is what was typed, the package's place included."""
    command_line = CommandLine("topics", place=("~/mine",))
    seen = evidence(talking(messages(steady(1.0, 12))))
    linked = html_of(too_slow(), seen, ASKED, Own(command_line, "file:///site"))
    assert re.search(r'<a href="file:///site/days/[\w-]+/index.html#[\w-]+">days/', linked)
    assert "./roslings check topics ~/mine" in linked
    plain = html_of(too_slow(), seen, ASKED, Own(command_line))
    assert "<a " not in plain and "in the lesson that ./roslings lab 3 opens" in Page(plain).text


def test_a_page_of_a_class_stands_alone() -> None:
    """It names its student, and what counts besides; it leads to no page of the others."""
    seen = evidence(talking(messages(steady(0.5, 12))))
    text = html_of(verdict(), seen, ASKED, OfClass("Zoë <b>", "88 of 100 count, by tutor: <i>"))
    assert "<b>Zoë &lt;b&gt;</b>" in text and "<b>88 of 100 count, by tutor: &lt;i&gt;</b>" in text
    assert "href=" not in text
    assert "count, by" not in html_of(verdict(), seen, ASKED, OfClass("Zoë"))


def test_a_rate_that_failed_has_its_plot_in_its_card() -> None:
    """Once on the page, and above the checks that pass."""
    text = html_of(too_slow(), evidence(talking(messages(steady(1.0, 12)))), ASKED)
    article = text[text.index("<article") : text.index("</article>")]
    assert 'class="plot"' in article
    assert text.count('class="plot"') == article.count('class="plot"')
    passed = html_of(verdict(), evidence(talking(messages(steady(0.5, 12)))), ASKED)
    assert passed.index('class="plot"') > passed.index("The checks")


@pytest.mark.parametrize(
    ("text", "other", "shown"),
    [
        ("there is /alve", "a node /alive", "there is /alve"),
        ("there is /alivee", "a node /alive", "there is /alive<mark>e</mark>"),
        ("a node /alive", "there is /alve", "a node /al<mark>i</mark>ve"),
        ("'hello <b>'", "'hallo <b>'", "h<mark>e</mark>llo &lt;b&gt;"),
        ("/chatter", "/chatter", "/chatter"),
        ("2 Hz", "1 Hz", "2 Hz"),
    ],
)
def test_what_differs_between_two_names_is_marked(text: str, other: str, shown: str) -> None:
    """Letters alone, and nothing that a student wrote becomes HTML."""
    assert shown in marked(text, other)


def test_a_package_that_was_not_built_has_a_page_too() -> None:
    """No experiment, no build, no score."""
    seen = evidence().model_copy(update={"build": None})
    found = page(seen, verdict(left_open("builds", "this computer stood still")))
    assert "no score" in found.text
    assert "this computer stood still" in found.text
    assert "plot" not in found.classes


def test_the_plot_shows_the_periods_that_were_judged() -> None:
    """One for each of the rate's, losses counted in the same way."""
    heard = messages(steady(0.5, 30), lost={7, 8, 20})
    (each,) = watched(evidence(talking(heard)), ASKED)
    rate = measure_rate(heard)
    assert rate is not None
    assert tuple(interval.period_s for interval in each.intervals) == rate.periods_s
    assert [interval.lost for interval in each.intervals if interval.lost] == [2, 1]
    assert each.rate == rate
    assert each.intervals[-1].end_s == pytest.approx(14.5)


def test_in_simulated_time_the_ticks_count() -> None:
    """However fast they went by on the wall."""
    seen = talking(messages(steady(0.5, 20), simulated=True))
    for number, message in enumerate(seen.topics["/chatter"].messages):
        message.source_ns = message.arrival_ns = number * 1_000_000
    seen.clock, seen.segments = "sim", [Segment(first=0, last=1, step_ns=10**8, speed=50)]
    seen.ticks = [Tick(sim_ns=n, wall_ns=n, at_ns=n, kept_up=True) for n in (-1, 10**10)]
    (each,) = watched(evidence(seen), ASKED)
    assert {interval.period_s for interval in each.intervals} == {0.5}
    seen.graph = graph([("/talker", "/chatter", STRING)], [("/talker", "/clock", "it/msg/Clock")])
    text = page(evidence(seen)).text
    assert "simulated seconds" in text
    assert "/clock" not in text  # the grader's own


def simulated(times_s: Sequence[float], step_s: float) -> ExperimentSeen:
    """What is seen of messages that are sent at these times by a clock of such steps."""
    at_ticks = [math.ceil(time_s / step_s - 1e-9) * step_s for time_s in times_s]
    seen = talking(messages(at_ticks, simulated=True))
    seen.clock = "sim"
    seen.segments = [Segment(first=0, last=1, step_ns=round(step_s * 1e9), speed=50)]
    seen.ticks = [Tick(sim_ns=n, wall_ns=n, at_ns=n, kept_up=True) for n in (-1, 10**11)]
    return seen


@pytest.mark.parametrize("period_s", [0.435, 0.5, 0.333])
def test_the_steps_of_the_clock_are_no_jitter(period_s: float) -> None:
    """A perfect timer has periods of 0.4 and 0.5 s then: that is the clock's doing."""
    seen = simulated(steady(period_s, 25), 0.1)
    (each,) = watched(evidence(seen), ASKED)
    assert len({interval.period_s for interval in each.intervals}) == 1
    assert each.intervals[0].period_s == pytest.approx(period_s, rel=0.01)
    text = page(evidence(seen)).text
    assert "less than one step of the simulated clock (100.0 ms)" in text
    assert "400.0 ms" not in text
    gaps_s = [after.end_s - before.end_s for before, after in pairwise(each.intervals)]
    assert gaps_s == pytest.approx([each.intervals[0].period_s] * len(gaps_s))
    assert "give or take" in text
    assert "p95" not in text  # nobody can tell


def test_what_no_step_explains_is_shown() -> None:
    """Two messages at once, then a pause: no timer does that."""
    times_s = sorted([*steady(1.0, 12), *(0.2 + time_s for time_s in steady(1.0, 12))])
    seen = simulated(times_s, 0.1)
    (each,) = watched(evidence(seen), ASKED)
    assert {round(interval.period_s, 3) for interval in each.intervals} == {0.2, 0.8}
    assert (
        "each time known to one step of the simulated clock (100.0 ms)" in page(evidence(seen)).text
    )


def test_losses_and_the_asked_band_are_drawn() -> None:
    """Only where there are some; the band lies at the card's limits."""
    whole = page(evidence(talking(messages(steady(0.5, 12)))))
    lossy = page(evidence(talking(messages(steady(0.5, 12), lost={4}))))
    assert whole.classes["lost"] == 0
    assert lossy.classes["lost"] == 3  # the wide plot, the narrow one, the legend
    (each,) = watched(evidence(talking(messages(steady(0.5, 12)))), ASKED)
    band = re.search(
        r'y="([\d.]+)"[^>]*height="([\d.]+)" class="band"', interval_plot(each, 720, 270)
    )
    assert band
    top_s, paper = 1.15 / 1.9, 270 - TOP - BOTTOM
    assert float(band[1]) == pytest.approx(TOP + paper * (1 - (1 / 1.9) / top_s), abs=0.1)
    assert float(band[2]) == pytest.approx(paper * (1 / 1.9 - 1 / 2.1) / top_s, abs=0.1)


def test_a_rare_long_period_does_not_press_the_rest_flat() -> None:
    """It stands at the top, marked, and the legend says how long it was."""
    times_s = [*steady(0.5, 30), *(60 + t for t in steady(0.5, 30))]
    found = page(evidence(talking(messages(times_s))))
    assert found.classes["beyond"] == 3
    assert "up to 45.50 s" in found.text


def test_many_messages_make_no_large_page() -> None:
    """20,000 of them, the most that are kept."""
    seen = evidence(
        talking(messages([t + (i % 7) * 1e-5 for i, t in enumerate(steady(0.001, 20_000))]))
    )
    text = html_of(verdict(), seen, ASKED)
    assert len(text) < 100_000
    assert "columns" in Page(text).classes


def test_a_misspelt_topic_is_shown_beside_what_was_asked() -> None:
    """With the band of the topic that it is nearest to."""
    found = page(evidence(talking(messages(steady(0.5, 12)), "/chater")))
    assert "The lab asks for /chatter: this is the nearest." in found.text
    assert found.classes["band"] == 3


def test_a_topic_that_nobody_heard_is_named() -> None:
    """It stands in the graph and in the list."""
    found = page(evidence(talking([])))
    assert "/chatter (std_msgs/msg/String) in talking" in found.text
    assert "No message came on these topics" in found.text
    heard = page(evidence(talking(messages(steady(0.5, 12)))))
    assert "No message came" not in heard.text


def test_the_graph_has_its_picture_and_its_words() -> None:
    """Two nodes of one name are drawn double."""
    seen = ExperimentSeen(name="together", clock="wall")
    seen.graph = graph([("/talker", "/chatter", STRING)], [("/listener", "/chatter", STRING)])
    found = page(evidence(seen))
    assert found.classes["graph"] == 2  # for a wide screen and for a narrow one
    assert "/talker publishes on /chatter" in found.text
    seen.graph.nodes.append("/talker")
    assert page(evidence(seen)).classes["doubled"] == 4


def test_what_the_grader_said_is_told() -> None:
    """And whether somebody was there to hear it."""
    seen = ExperimentSeen(name="hearing", clock="wall")
    seen.spoken = [
        Spoken(
            topic="/chatter",
            type=STRING,
            content=content,
            sent_ns=1,
            matched=matched,
            offered=Qos(),
        )
        for content, matched in (({"data": "amber 1234"}, True), ({"x": 1, "y": 2}, False))
    ]
    text = page(evidence(seen)).text
    assert "in hearing, on /chatter: 'amber 1234'" in text
    assert "{'x': 1, 'y': 2} (nobody was listening)" in text


def test_a_run_that_was_made_again_is_told() -> None:
    """With its reason."""
    seen = evidence(talking(messages(steady(0.5, 12))))
    seen.attempts = [talking([]).model_copy(update={"clock": "sim", "not_believed": "it slept"})]
    text = page(seen).text
    assert "talking, in simulated time: it slept" in text and "That costs no points." in text
    assert "once more" not in page(evidence()).text


def test_the_jitter_is_explained() -> None:
    """Beside the number; where there is none, there is nothing to explain."""
    told = "The jitter is the standard deviation of the periods"
    assert told in page(evidence(talking(messages(steady(0.5, 12))))).text
    assert told not in page(evidence(talking([]))).text


def test_a_long_log_shows_both_ends() -> None:
    """And says how much is missing."""
    found = page(evidence(talking([], "/chatter", *(f"line {n};" for n in range(2000)))))
    assert "line 0;" in found.text
    assert "line 1999;" in found.text
    assert "line 1000;" not in found.text
    assert "1600 lines more" in found.text


def test_commands_in_a_sentence_are_code() -> None:
    """Where backquotes stand around them; one alone is left as it is."""
    assert prose("run `a <b>` or `c") == "run <code>a &lt;b&gt;</code> or `c"


def test_an_element_escapes_what_it_is_given() -> None:
    """In its text and in its attributes; a number loses what nobody sees."""
    assert tag("p", "<&", class_='"x"') == '<p class="&quot;x&quot;">&lt;&amp;</p>'
    assert tag("rect", x=0.0, y=1.26, width=None) == '<rect x="0" y="1.3"/>'
