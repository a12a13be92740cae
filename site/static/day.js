// The box at the end of a day: it unlocks when the quiz is answered and the verdict is loaded.
(function () {
  "use strict";

  const box = document.querySelector(".day-box");
  if (!box) return;
  const day = roslings.dayOf(box);
  const state = box.querySelector(".day-state");
  const button = box.querySelector(".day-done");
  const drop = box.querySelector(".drop");

  function show() {
    const missing = roslings.missing(day);
    const quiz = box.querySelector('[data-need="quiz"]');
    if (quiz) {
      const left = missing.questions.length;
      const open = roslings.counted("script.day.left", left, "one question to answer", "{count} questions to answer");
      tick(quiz, left === 0, open);
    }
    for (const lab of box.querySelectorAll('[data-need="lab"]')) {
      const open = roslings.text("script.day.load", "load its verdict below");
      tick(lab, !missing.labs.includes(lab.dataset.lab), open);
    }
    button.disabled = missing.done || missing.questions.length > 0 || missing.labs.length > 0;
    if (missing.done) {
      state.textContent = roslings.text("script.day.done", "✓ This day is done. Home shows the next one.");
    }
  }

  function tick(item, done, open) {
    item.classList.toggle("done", done);
    item.querySelector("span").textContent = done ? roslings.text("script.done", "✓ done") : open;
  }

  button.addEventListener("click", () => roslings.finishDay(day.id));
  document.addEventListener("roslings:progress", show);
  show();

  // --- the verdict ------------------------------------------------------------------------------

  async function load(file) {
    if (!file) return;
    const verdict = roslings.readVerdict(await file.text());
    state.textContent = answerTo(verdict);
    if (verdict.outcome === "pass") roslings.passLab(verdict.lab, verdict.score);
  }

  function answerTo(verdict) {
    if (verdict.problem) return verdict.problem;
    if (verdict.outcome === "inconclusive") {
      const english = "This verdict says that not everything could be told. Run ./roslings doctor, then check again.";
      return roslings.text("script.verdict.open", english);
    }
    if (verdict.outcome === "fail") {
      const english = "This verdict has {score} of 100 points. Mend what it names, check again, load it again.";
      return roslings.text("script.verdict.fail", english, { score: verdict.score });
    }
    if (!day.labs.includes(verdict.lab)) {
      const english = 'This is the verdict on the lab "{lab}". It is kept for the day of that lab.';
      return roslings.text("script.verdict.other", english, { lab: verdict.lab });
    }
    const english = 'The verdict on "{lab}" is loaded: {score} of 100 points.';
    return roslings.text("script.verdict.loaded", english, { lab: verdict.lab, score: verdict.score });
  }

  if (!drop) return;
  const input = drop.querySelector("input");
  input.addEventListener("change", () => load(input.files[0]));
  drop.addEventListener("dragover", (event) => {
    event.preventDefault();
    drop.classList.add("over");
  });
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    load(event.dataTransfer.files[0]);
  });
})();
