// The review page: missed questions come back, progress can be carried to another computer, and
// questions can be carried to Anki.
(function () {
  "use strict";

  const page = document.querySelector(".review");
  if (!page) return;
  const forms = [...document.querySelectorAll(".review-questions form.question")];
  const status = page.querySelector(".review-status");
  const answer = document.querySelector(".review-answer");
  const keys = roslings.keys || {};
  const { text } = roslings;
  const answeredHere = new Set(); // they stay, so that the explanation can be read

  page.hidden = false;
  showDue();
  document.addEventListener("roslings:answered", (event) => {
    answeredHere.add(event.target.dataset.question);
  }, true);
  document.addEventListener("roslings:progress", showDue);

  function showDue() {
    const { due, missed, next } = roslings.review();
    const here = due.filter((id) => keys[id]);
    let number = 0;
    for (const form of forms) {
      const id = form.dataset.question;
      form.hidden = !here.includes(id) && !answeredHere.has(id);
      if (!form.hidden) form.querySelector(".question-number").textContent = numbered(++number);
    }
    status.textContent = sentence(here.length, missed.length, next);
  }

  function numbered(number) {
    return text("script.review.question", "Question {number}", { number });
  }

  function sentence(due, missed, next) {
    if (due) {
      return roslings.counted("script.review.due", due, "One question is due today.", "{count} questions are due today.");
    }
    if (next) {
      return text("script.review.next", "Nothing is due today. The next question comes back on {date}.", { date: next });
    }
    return missed
      ? text("script.review.nothing", "Nothing is due today.")
      : text("script.review.none_missed", "No question is missed. Do a quiz, and come back.");
  }

  // --- files ------------------------------------------------------------------------------------

  on("export", () => {
    roslings.save("roslings-progress.json", JSON.stringify(roslings.read(), null, 2), "application/json");
    const english = "Saved as {file}. Load it on the other computer.";
    answer.textContent = text("script.review.saved", english, { file: "roslings-progress.json" });
  });

  document.querySelector('[data-do="import"]').addEventListener("change", async (event) => {
    const file = event.target.files[0];
    event.target.value = "";
    if (!file) return;
    const found = roslings.check(await file.text());
    if (found.problem) {
      const english = "{problem} Your progress is unchanged.";
      answer.textContent = text("script.review.unchanged", english, { problem: found.problem });
      return;
    }
    roslings.join(found.progress);
    const count = Object.keys(found.progress.questions).length;
    answer.textContent = text("script.review.loaded", "Loaded: {count} questions. Newer answers were kept.", { count });
  });

  on("anki-missed", () => saveCards(roslings.review().missed.filter((id) => keys[id]), "missed"));
  on("anki-all", () => saveCards(Object.keys(keys), "all"));

  on("forget", () => {
    const sure = document.querySelector(".forget-sure");
    sure.hidden = !sure.hidden;
    if (!sure.hidden) sure.querySelector("button").focus();
  });
  on("forget-now", () => {
    roslings.forget();
    document.querySelector(".forget-sure").hidden = true;
    answer.textContent = text("script.review.deleted", "All progress in this browser is deleted.");
  });

  // Anki reads a text file: a line a card, and headers that say what the columns are.
  function saveCards(ids, name) {
    if (!ids.length) {
      answer.textContent = text("script.review.no_cards", "There is no such question yet. Nothing was saved.");
      return;
    }
    const cell = (html) => `"${html.replace(/"/g, '""').replace(/\n/g, "<br>")}"`;
    const head = ["#separator:tab", "#html:true", "#guid column:1", "#tags column:4", "#deck:roslings"];
    const lines = ids.map((id) =>
      [`roslings-${id}`, cell(keys[id].front), cell(keys[id].back), `roslings ${keys[id].day}`].join("\t"),
    );
    roslings.save(`roslings-${name}.txt`, [...head, ...lines, ""].join("\n"), "text/plain");
    const english = "Saved {count} cards. In Anki, choose File, then Import.";
    answer.textContent = text("script.review.cards", english, { count: ids.length });
  }

  function on(name, act) {
    document.querySelector(`[data-do="${name}"]`).addEventListener("click", act);
  }
})();
