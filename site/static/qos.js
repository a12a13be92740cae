// What matches what: the choices of each rule stand from weak to strong, and the offer must be at
// least as strong as what is asked.
(function () {
  "use strict";

  const form = document.querySelector("form.qos-play");
  if (!form) return;
  const rules = [...form.querySelectorAll("fieldset")];
  const says = form.querySelector(".qos-says");
  const code = form.querySelector(".qos-code");

  form.hidden = false;
  form.addEventListener("change", show);
  form.addEventListener("submit", (event) => event.preventDefault());
  show();

  function show() {
    const broken = rules.filter((rule) => !holds(rule));
    for (const rule of rules) {
      const wrong = broken.includes(rule);
      rule.classList.toggle("wrong", wrong);
      rule.querySelector(".qos-mark").textContent = wrong
        ? roslings.text("script.qos.weak", "\u2717 too weak")
        : roslings.text("script.qos.fits", "\u2713 fits");
    }
    const why = broken.map((rule) => rule.dataset.broken).join(" ");
    says.textContent = broken.length
      ? roslings.text("script.qos.no_match", "They do not match: no message comes. {why}", { why })
      : roslings.text("script.qos.match", "They match: messages come.");
    code.textContent = `offered = ${profile("offered")}\nasked = ${profile("asked")}`;
  }

  function holds(rule) {
    return list(rule, "offered").selectedIndex >= list(rule, "asked").selectedIndex;
  }

  function profile(side) {
    const chosen = rules.map((rule) => list(rule, side).selectedOptions[0].dataset.code);
    return `QoSProfile(\n    ${["depth=10", ...chosen.filter(Boolean)].join(",\n    ")},\n)`;
  }

  function list(rule, side) {
    return rule.querySelector(`select[data-side="${side}"]`);
  }
})();
