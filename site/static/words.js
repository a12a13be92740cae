// A word of the glossary: the link becomes a button with a popover. The popover opens on hover, on
// focus and on a tap, stays while it is pointed at, and closes with Escape (WCAG 1.4.13).
(function () {
  "use strict";

  const LEAVE_MS = 250; // time to move the pointer from the word into the popover
  let count = 0;
  let open = null;

  for (const link of document.querySelectorAll("a.word")) {
    const entry = document.querySelector(`.page-words [data-entry="${link.dataset.word}"]`);
    if (entry) makeButton(link, entry);
  }

  function makeButton(link, entry) {
    const holder = document.createElement("span");
    holder.className = "word-holder";
    const button = document.createElement("button");
    button.type = "button";
    button.className = "word";
    button.dataset.word = link.dataset.word;
    button.append(...link.childNodes);
    button.setAttribute("aria-expanded", "false");
    const popover = makePopover(link, entry);
    button.setAttribute("aria-controls", popover.id);
    button.setAttribute("aria-describedby", `${popover.id}-text`);
    holder.append(button, popover);
    link.replaceWith(holder);
    listen({ holder, button, popover, timer: 0, pinned: false });
  }

  // Spans, because a word stands inside a paragraph.
  function makePopover(link, entry) {
    const popover = document.createElement("span");
    popover.className = "popover";
    popover.id = `popover-${++count}`;
    popover.hidden = true;
    const title = span("popover-title", entry.querySelector("dt").textContent);
    const text = span("popover-text", "");
    text.id = `${popover.id}-text`;
    text.append(...[...entry.querySelector("dd").childNodes].map((node) => node.cloneNode(true)));
    const more = document.createElement("a");
    more.href = link.href;
    more.textContent = roslings.text("script.words.more", "More about it");
    const word = entry.querySelector("dt").textContent;
    more.setAttribute("aria-label", roslings.text("script.words.more_about", "More about {word}", { word }));
    popover.append(title, text, more);
    return popover;
  }

  function span(name, text) {
    const made = document.createElement("span");
    made.className = name;
    made.textContent = text;
    return made;
  }

  function listen(word) {
    const { holder, button } = word;
    holder.addEventListener("pointerenter", (event) => event.pointerType === "mouse" && show(word));
    holder.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && leave(word));
    button.addEventListener("focus", () => show(word));
    holder.addEventListener("focusout", (event) => {
      if (!holder.contains(event.relatedTarget)) hide(word);
    });
    // A press also gives focus, which opens: so a press pins what is open, and the next one closes.
    button.addEventListener("click", () => {
      if (word.pinned) hide(word);
      else show(word, true);
    });
  }

  function show(word, pin = false) {
    clearTimeout(word.timer);
    if (open && open !== word) hide(open);
    open = word;
    word.pinned = word.pinned || pin;
    word.popover.hidden = false;
    word.button.setAttribute("aria-expanded", "true");
    place(word);
  }

  function leave(word) {
    word.timer = setTimeout(() => {
      if (!word.pinned && !word.holder.contains(document.activeElement)) hide(word);
    }, LEAVE_MS);
  }

  function hide(word) {
    clearTimeout(word.timer);
    word.pinned = false;
    word.popover.hidden = true;
    word.button.setAttribute("aria-expanded", "false");
    if (open === word) open = null;
  }

  // Under the word, or above it near the bottom, and never outside the window.
  function place(word) {
    const { button, popover } = word;
    popover.style.left = "0px";
    popover.classList.remove("above");
    const at = button.getBoundingClientRect();
    const size = popover.getBoundingClientRect();
    const edge = 8;
    const most = document.documentElement.clientWidth - size.width - edge;
    popover.style.left = `${Math.max(edge, Math.min(at.left, most)) - size.left}px`;
    const below = window.innerHeight - at.bottom;
    popover.classList.toggle("above", below < size.height + 20 && at.top > size.height + 20);
  }

  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !open) return;
    const word = open;
    if (word.popover.contains(document.activeElement)) {
      word.button.focus();
    }
    hide(word);
  });

  document.addEventListener("pointerdown", (event) => {
    if (open && !open.holder.contains(event.target)) hide(open);
  });
})();
