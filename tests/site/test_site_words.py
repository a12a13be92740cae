"""Words in pages: the right sense, never in a title, and a popover for hand, eye and ear."""

from __future__ import annotations

from pathlib import Path

from two_days_site import Visit

DAY_1, DAY_3 = "days/01-install/index.html", "days/03-topics/index.html"


def words(page: object) -> list[tuple[str, str]]:
    """Each linked word with the entry that it opens."""
    found: list[list[str]] = page.evaluate(  # type: ignore[attr-defined]
        "[...document.querySelectorAll('button.word')].map(b => [b.textContent, b.dataset.word])"
    )
    return [(text, term) for text, term in found]


def test_a_word_opens_the_sense_that_the_page_names(visit: Visit) -> None:
    """Day 3 means colcon's workspace, and names the arm's by hand; day 1 names neither."""
    found = words(visit.go(DAY_3))
    assert ("workspace", "workspace") in found
    assert ("reach", "workspace-arm") in found
    assert "workspace" not in dict(words(visit.go(DAY_1)))


def test_a_word_is_linked_on_its_first_use_only(visit: Visit) -> None:
    """Plain text about nodes stays readable."""
    texts = [text.lower() for text, _ in words(visit.go(DAY_1))]
    assert texts.count("node") + texts.count("nodes") == 1


def test_no_word_is_linked_in_titles_code_or_links(visit: Visit) -> None:
    """The seed cut a title by a tooltip."""
    for name in (DAY_1, DAY_3, "labs/topics.html", "reference/doctor.html"):
        page = visit.go(name)
        places = "h1, h2, h3, h4, h5, title, pre, code, a, nav, th, caption, figcaption, legend"
        inside = ", ".join(f"{place} .word" for place in places.split(", "))
        assert page.locator(inside).count() == 0
    titles = visit.go(DAY_3).locator("h2").all_inner_texts()
    assert any("Read the workspace" in title for title in titles)


def test_a_popover_by_keyboard(visit: Visit) -> None:
    """Focus opens, Escape closes and keeps the place, Tab leads into it and out."""
    page = visit.go(DAY_1)
    button = page.locator("button.word").first
    popover = page.locator(f"#{button.get_attribute('aria-controls')}")
    assert not popover.is_visible()
    button.focus()
    assert popover.is_visible()
    assert button.get_attribute("aria-expanded") == "true"
    described = page.locator(f"#{button.get_attribute('aria-describedby')}")
    assert described.inner_text().startswith("A node is one working part")
    page.keyboard.press("Escape")
    assert not popover.is_visible()
    assert button.evaluate("b => b === document.activeElement")
    page.keyboard.press("Enter")
    assert popover.is_visible()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "More about it"
    assert popover.is_visible()
    page.keyboard.press("Tab")
    assert not popover.is_visible()


def test_a_popover_by_pointer_stays_while_pointed_at(visit: Visit) -> None:
    """WCAG 1.4.13: hoverable, dismissible, persistent."""
    page = visit.go(DAY_1)
    button = page.locator("button.word").first
    popover = page.locator(f"#{button.get_attribute('aria-controls')}")
    button.hover()
    popover.wait_for(state="visible")
    popover.locator("a").hover()
    page.wait_for_function("() => new Promise(done => setTimeout(() => done(true), 600))")
    assert popover.is_visible()
    page.mouse.move(2, 2)
    popover.wait_for(state="hidden")
    button.hover()
    popover.wait_for(state="visible")
    page.keyboard.press("Escape")
    assert not popover.is_visible()


def test_a_popover_by_tap_fits_a_phone(browser: object, site: Path) -> None:
    """A tap opens it, a tap elsewhere closes it, and it stays inside the screen."""
    context = browser.new_context(  # type: ignore[attr-defined]
        viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True
    )
    page = context.new_page()
    page.goto((site / DAY_1).as_uri())
    for button in page.locator("button.word").all():
        button.tap()
        popover = page.locator(f"#{button.get_attribute('aria-controls')}")
        popover.wait_for(state="visible")
        box = popover.bounding_box()
        assert box
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        page.locator("h1").tap()
        popover.wait_for(state="hidden")
    context.close()


def test_without_javascript_a_word_is_a_link(browser: object, site: Path) -> None:
    """And quizzes and words can be read."""
    context = browser.new_context(java_script_enabled=False)  # type: ignore[attr-defined]
    page = context.new_page()
    page.goto((site / DAY_1).as_uri())
    link = page.locator("a.word").first
    page.locator(".page-words summary").click()  # folded, and opened without a script
    assert page.locator(".page-words dd").first.is_visible()
    link.click()
    page.wait_for_url("**/glossary.html#word-node")
    page.locator("#word-node").wait_for(state="visible")
    page.goto((site / "days/01-install/quiz.html").as_uri())
    assert page.locator("form.question").count() == 3
    page.locator("noscript a").click()
    page.get_by_text("Sourcing changes the variables").wait_for(state="visible")
    page.goto((site / "review.html").as_uri())
    assert page.locator("form.question").first.is_visible()
    context.close()


def test_the_glossary_filters_by_letter_and_category(visit: Visit) -> None:
    """By keyboard too; a link to a hidden entry shows it."""
    page = visit.go("glossary.html")
    entries = page.locator("section.entry:visible")
    everything = entries.count()
    assert everything >= 100
    page.locator("input[name=letter][value=w]").check(force=True)
    assert 0 < entries.count() < everything
    assert all(name.lower().startswith("w") for name in entries.locator("h2").all_inner_texts())
    page.locator("input[name=category][value=hardware]").check(force=True)
    assert f"{entries.count()} words" in page.locator(".word-count").inner_text()
    page.locator("input[name=letter][value=w]").focus()
    page.keyboard.press("ArrowLeft")
    assert all(name.lower().startswith("v") for name in entries.locator("h2").all_inner_texts())
    page.evaluate("location.hash = 'word-node'")
    page.locator("#word-node").wait_for(state="visible")
    assert entries.count() == everything


def test_each_definition_links_the_words_it_uses(visit: Visit) -> None:
    """And never itself."""
    page = visit.go("glossary.html")
    assert page.locator("#word-topic a.word[data-word=node]").count() >= 1
    assert page.locator("#word-node .definition a.word[data-word=node]").count() == 0
    missing = page.evaluate(
        "[...document.querySelectorAll('a.word')].map(a => a.hash.slice(1))"
        ".filter(id => !document.getElementById(id))"
    )
    assert missing == []
