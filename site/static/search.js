// Sphinx's search gives a text that names a word often as many points as a page called by it.
// A page or a word of that very name comes first, then a title that begins so, then one that has it.
(function () {
  "use strict";

  if (typeof Scorer === "undefined") return;
  const asked = (new URLSearchParams(location.search).get("q") || "").trim().toLowerCase();

  Scorer.score = ([, title, , , score]) => {
    const own = title.toLowerCase().replace(/<[^>]*>/g, "").split(" > ").pop().trim();
    const words = own.split(/[^\p{L}\p{N}_]+/u);
    if (own === asked) return score + 4000;
    if (own.startsWith(asked)) return score + 3000;
    if (words.includes(asked)) return score + 2000;
    return own.includes(asked) ? score + 1000 : score;
  };
})();
