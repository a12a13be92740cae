// The questions of a quiz: checks an answer, explains each choice, keeps the outcome.
(function () {
  "use strict";

  const forms = [...document.querySelectorAll("form.question")];
  if (!forms.length || !window.roslingsKeys) return;
  const bytes = Uint8Array.from(atob(window.roslingsKeys), (sign) => sign.charCodeAt(0));
  const keys = JSON.parse(new TextDecoder().decode(bytes));
  delete window.roslingsKeys;
  roslings.keys = keys;

  for (const form of forms) {
    if (form.dataset.kind === "order") makeMovable(form);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      checkAnswer(form);
    });
    form.addEventListener("change", () => takeBack(form));
    form.addEventListener("input", () => takeBack(form));
  }

  // A new choice: what was said of the last one no longer fits.
  function takeBack(form) {
    form.classList.remove("right", "wrong");
    for (const why of form.querySelectorAll(".why")) why.hidden = true;
    for (const item of form.querySelectorAll("li")) item.classList.remove("right", "wrong");
    form.querySelector(".outcome").textContent = "";
  }

  function checkAnswer(form) {
    takeBack(form);
    const judge = { order: judgeOrder, prints: judgePrint }[form.dataset.kind] || judgeChoices;
    const right = judge(form, keys[form.dataset.question]);
    if (right === null) {
      say(form, roslings.text("script.quiz.first", "Answer first, then press Check."));
      return;
    }
    form.classList.add(right ? "right" : "wrong");
    const notYet = roslings.text("script.quiz.not_yet", "✗ Not yet. Read why, and try again.");
    say(form, right ? roslings.text("script.quiz.right", "✓ Right.") : notYet);
    form.dispatchEvent(new CustomEvent("roslings:answered", { bubbles: true }));
    roslings.answer(form.dataset.question, right);
  }

  function say(form, text) {
    form.querySelector(".outcome").textContent = text;
  }

  function explain(item, html, right) {
    const why = item.querySelector(".why");
    const label = right ? roslings.text("script.quiz.is", "Right: ") : roslings.text("script.quiz.is_not", "Not right: ");
    why.innerHTML = `<b>${label}</b>${html}`;
    why.hidden = false;
    item.classList.add(right ? "right" : "wrong");
  }

  // Explains what was chosen; once all is right, the other choices too.
  function judgeChoices(form, key) {
    const items = [...form.querySelectorAll(".choices > li")];
    const chosen = items.map((item) => item.querySelector("input").checked);
    if (!chosen.includes(true)) return null;
    const right = chosen.every((is, index) => is === key.right.includes(index));
    items.forEach((item, index) => {
      if (chosen[index] || right) explain(item, key.why[index], key.right.includes(index));
    });
    const lacks = key.right.some((index) => !chosen[index]);
    const nothingWrong = chosen.every((is, index) => !is || key.right.includes(index));
    const more = roslings.text("script.quiz.more", "✗ Not yet. One more is right.");
    if (!right && lacks && nothingWrong) queueMicrotask(() => say(form, more));
    return right;
  }

  function judgePrint(form, key) {
    const plain = (text) => text.trim().replace(/\s+/g, " ");
    const given = plain(form.elements.answer.value);
    if (!given) return null;
    const right = given === plain(key.prints);
    const mistake = key.mistakes.find(([text]) => plain(text) === given);
    const english = "Go through the code line by line, and write down each value.";
    const other = roslings.text("script.quiz.line_by_line", english);
    explain(form.querySelector("fieldset"), right ? key.why : mistake ? mistake[1] : other, right);
    return right;
  }

  // --- steps in order ---------------------------------------------------------------------------

  function makeMovable(form) {
    for (const item of form.querySelectorAll(".steps > li")) {
      const name = item.querySelector("span").textContent;
      const buttons = document.createElement("span");
      buttons.className = "movers";
      buttons.append(mover(form, item, -1, "↑", roslings.text("script.quiz.up", "Move up: {step}", { step: name })));
      buttons.append(mover(form, item, 1, "↓", roslings.text("script.quiz.down", "Move down: {step}", { step: name })));
      item.querySelector("span").after(buttons);
    }
  }

  function mover(form, item, by, sign, label) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = sign;
    button.setAttribute("aria-label", label);
    button.addEventListener("click", () => move(form, item, by, button));
    return button;
  }

  function move(form, item, by, button) {
    const items = [...item.parentElement.children];
    const to = items.indexOf(item) + by;
    takeBack(form);
    if (to < 0 || to >= items.length) {
      say(form, by < 0
        ? roslings.text("script.quiz.is_first", "It is the first step already.")
        : roslings.text("script.quiz.is_last", "It is the last step already."));
      return;
    }
    if (by < 0) items[to].before(item);
    else items[to].after(item);
    button.focus();
    say(form, roslings.text("script.quiz.now", "Now step {step} of {all}.", { step: to + 1, all: items.length }));
  }

  function judgeOrder(form, key) {
    const items = [...form.querySelectorAll(".steps > li")];
    const given = items.map((item) => Number(item.dataset.step));
    const elsewhere = roslings.text("script.quiz.elsewhere", "This step belongs elsewhere.");
    items.forEach((item, index) => {
      const fits = given[index] === key.right[index];
      explain(item, fits ? key.why[given[index]] : elsewhere, fits);
    });
    return given.every((step, index) => step === key.right[index]);
  }
})();
