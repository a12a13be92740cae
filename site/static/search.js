// Sphinx's search gives a text that names a word often as many points as a page called by it.
// A page or a word of that very name comes first, then a title with that word, then one that has it in a word.
(function () {
  "use strict";

  if (typeof Scorer === "undefined") return;
  const asked = (new URLSearchParams(location.search).get("q") || "").trim().toLowerCase();

  Scorer.score = ([, title, , , score, , kind]) => {
    if (!asked || kind === "object") return score; // names of the engine: for authors
    const own = title.toLowerCase().replace(/<[^>]*>/g, "").split(" > ").pop().trim();
    const words = own.split(/[^\p{L}\p{N}_]+/u);
    if (own === asked) return score + 4000;
    if (words.some((word) => word === asked || word === `${asked}s`)) return score + 2000;
    return own.includes(asked) ? score + 1000 : score;
  };
})();
