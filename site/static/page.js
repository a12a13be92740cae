// Small things that every page needs: wide parts that scroll can be reached by the keyboard, words
// that were searched for are marked, the path of days shows how far the student is, and the glossary
// can be filtered.
(function () {
  "use strict";

  // --- wide code and tables ---------------------------------------------------------------------

  const WIDE = "article pre, article p:has(img), div.cell_output, .table-wrapper, .sidebar-scroll, .toc-scroll";

  function reachWideParts() {
    for (const part of document.querySelectorAll(WIDE)) {
      const scrolls = part.scrollWidth > part.clientWidth || part.scrollHeight > part.clientHeight;
      if (!scrolls) {
        part.removeAttribute("tabindex");
      } else if (!part.hasAttribute("tabindex")) {
        part.tabIndex = 0;
      }
    }
  }

  addEventListener("load", reachWideParts);
  addEventListener("resize", reachWideParts);
  document.addEventListener("toggle", reachWideParts, true);
  reachWideParts();

  // --- words that were searched for -------------------------------------------------------------

  // Sphinx's own scripts mark them; pages that nobody came to from a search do not load them.
  function markSearched(here) {
    const asked = new URLSearchParams(location.search).has("highlight");
    const there = document.querySelector('script[src*="documentation_options"]');
    if (there || !(asked || remembered())) return;
    for (const name of ["documentation_options", "doctools", "sphinx_highlight"]) {
      const script = document.createElement("script");
      script.src = new URL(`${name}.js`, here);
      script.async = false;
      document.head.append(script);
    }
  }

  function remembered() {
    try {
      return localStorage.getItem("sphinx_highlight_terms");
    } catch {
      return null; // a browser that keeps nothing
    }
  }

  markSearched(document.currentScript.src);

  // --- the path of days -------------------------------------------------------------------------

  function showPath() {
    let hereFound = false;
    for (const element of document.querySelectorAll(".path-day")) {
      const day = roslings.dayOf(element);
      const missing = roslings.missing(day);
      const state = element.querySelector(".path-state");
      const isHere = !missing.done && !hereFound;
      hereFound = hereFound || isHere;
      element.classList.toggle("here", isHere);
      if (isHere) element.setAttribute("aria-current", "step");
      else element.removeAttribute("aria-current");
      element.classList.toggle("done", missing.done);
      state.textContent = [isHere ? roslings.text("script.path.here", "You are here") : "", ...howFar(day, missing)].filter(Boolean).join(" · ");
    }
    showDueReviews();
  }

  // How far a day is, in short phrases.
  function howFar(day, missing) {
    const answered = day.questions.length - missing.questions.length;
    const drills = roslings.drillsOf(day);
    const { text } = roslings;
    const score = (found) => (found ? text("script.path.lab", "Lab {score} of 100", { score: found.score }) : "");
    return [
      missing.done ? text("script.path.done", "✓ Done") : "",
      drills && drills[0] ? text("script.path.drills", "{done} of {all} drills", { done: drills[0], all: drills[1] }) : "",
      ...day.labs.map((lab) => score(roslings.scoreOf(lab))),
      answered && !missing.done
        ? text("script.path.answered", "{done} of {all} questions answered", { done: answered, all: day.questions.length })
        : "",
    ];
  }

  function showDueReviews() {
    const place = document.querySelector(".review-due");
    if (!place) return;
    const due = roslings.review().due.length;
    place.hidden = due === 0;
    place.querySelector("span").textContent = roslings.counted(
      "script.missed", due, "One missed question is due today.", "{count} missed questions are due today.");
  }

  document.addEventListener("roslings:progress", showPath);
  showPath();

  // --- the filter of the glossary ---------------------------------------------------------------

  const filter = document.querySelector(".word-filter");
  if (filter) {
    filter.hidden = false;
    filter.addEventListener("change", applyFilter);
    filter.addEventListener("submit", (event) => event.preventDefault());
    addEventListener("hashchange", showTarget);
    applyFilter();
    showTarget();
  }

  function applyFilter() {
    const chosen = new FormData(filter);
    const wanted = ["letter", "category"]
      .filter((name) => chosen.get(name))
      .map((name) => `${name}-${chosen.get(name)}`);
    let shown = 0;
    for (const entry of document.querySelectorAll("section.entry")) {
      entry.hidden = !wanted.every((name) => entry.classList.contains(name));
      shown += entry.hidden ? 0 : 1;
    }
    filter.querySelector(".word-count").textContent = shown
      ? roslings.counted("script.words", shown, "{count} word", "{count} words")
      : roslings.text("script.words.none", "No word fits both. Choose All in one row.");
  }

  // A link to an entry that the filter hides: show all.
  function showTarget() {
    const entry = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!entry || !entry.matches("section.entry[hidden]")) return;
    filter.reset();
    applyFilter();
    entry.scrollIntoView();
  }

  // --- copy buttons -----------------------------------------------------------------------------

  for (const pre of document.querySelectorAll("article .highlight pre, [data-copy]")) {
    if (!pre.closest(".cell_output") && navigator.clipboard) addCopy(pre);
  }

  function addCopy(pre) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = roslings.text("script.copy", "Copy");
    button.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(pre.textContent.trimEnd());
        button.textContent = roslings.text("script.copied", "Copied");
      } catch {
        button.textContent = roslings.text("script.not_allowed", "Not allowed here");
      }
    });
    const holder = document.createElement("div");
    holder.className = "copy-holder";
    pre.replaceWith(holder);
    holder.append(pre, button);
  }

  // --- print: what is folded is unfolded --------------------------------------------------------

  addEventListener("beforeprint", () => {
    for (const part of document.querySelectorAll(".page-words details, details.folded")) part.open = true;
  });
})();
