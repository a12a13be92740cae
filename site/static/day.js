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
      tick(quiz, left === 0, left === 1 ? "one question to answer" : `${left} questions to answer`);
    }
    for (const lab of box.querySelectorAll('[data-need="lab"]')) {
      tick(lab, !missing.labs.includes(lab.dataset.lab), "load its verdict below");
    }
    button.disabled = missing.done || missing.questions.length > 0 || missing.labs.length > 0;
    if (missing.done) state.textContent = "✓ This day is done. Home shows the next one.";
  }

  function tick(item, done, open) {
    item.classList.toggle("done", done);
    item.querySelector("span").textContent = done ? "✓ done" : open;
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
      return "This verdict says that not everything could be told. Run ./roslings doctor, then check again.";
    }
    if (verdict.outcome === "fail") {
      return `This verdict has ${verdict.score} of 100 points. Mend what it names, check again, load it again.`;
    }
    if (!day.labs.includes(verdict.lab)) {
      return `This is the verdict on the lab "${verdict.lab}". It is kept for the day of that lab.`;
    }
    return `The verdict on "${verdict.lab}" is loaded: ${verdict.score} of 100 points.`;
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
