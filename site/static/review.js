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
      if (!form.hidden) form.querySelector(".question-number").textContent = `Question ${++number}`;
    }
    status.textContent = sentence(here.length, missed.length, next);
  }

  function sentence(due, missed, next) {
    if (due) return due === 1 ? "One question is due today." : `${due} questions are due today.`;
    if (next) return `Nothing is due today. The next question comes back on ${next}.`;
    return missed ? "Nothing is due today." : "No question is missed. Do a quiz, and come back.";
  }

  // --- files ------------------------------------------------------------------------------------

  on("export", () => {
    roslings.save("roslings-progress.json", JSON.stringify(roslings.read(), null, 2), "application/json");
    answer.textContent = "Saved as roslings-progress.json. Load it on the other computer.";
  });

  document.querySelector('[data-do="import"]').addEventListener("change", async (event) => {
    const file = event.target.files[0];
    event.target.value = "";
    if (!file) return;
    const found = roslings.check(await file.text());
    if (found.problem) {
      answer.textContent = `${found.problem} Your progress is unchanged.`;
      return;
    }
    roslings.join(found.progress);
    const count = Object.keys(found.progress.questions).length;
    answer.textContent = `Loaded: ${count} questions. Newer answers were kept.`;
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
    answer.textContent = "All progress in this browser is deleted.";
  });

  // Anki reads a text file: a line a card, and headers that say what the columns are.
  function saveCards(ids, name) {
    if (!ids.length) {
      answer.textContent = "There is no such question yet. Nothing was saved.";
      return;
    }
    const cell = (html) => `"${html.replace(/"/g, '""').replace(/\n/g, "<br>")}"`;
    const head = ["#separator:tab", "#html:true", "#guid column:1", "#tags column:4", "#deck:roslings"];
    const lines = ids.map((id) =>
      [`roslings-${id}`, cell(keys[id].front), cell(keys[id].back), `roslings ${keys[id].day}`].join("\t"),
    );
    roslings.save(`roslings-${name}.txt`, [...head, ...lines, ""].join("\n"), "text/plain");
    answer.textContent = `Saved ${ids.length} cards. In Anki, choose File, then Import.`;
  }

  function on(name, act) {
    document.querySelector(`[data-do="${name}"]`).addEventListener("click", act);
  }
})();
