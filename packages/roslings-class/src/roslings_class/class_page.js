"use strict";
// Sorts and searches the table of the class. Without it the table is whole, the lowest score first.
const table = document.querySelector("table.class");
const rows = [...table.tBodies[0].rows];
const search = document.querySelector(".search");
const field = search.querySelector("input");
const found = search.querySelector("output");

// Small letters without accents: `zoe` finds `Zoë`.
const plain = (text) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
const texts = new Map(rows.map((row) => {
  const told = [row.dataset.also, ...[...row.cells].map((cell) => cell.textContent)];
  return [row, plain(told.join(" "))];
}));

function show() {
  const words = plain(field.value).split(/\s+/).filter(Boolean);
  for (const row of rows) row.hidden = !words.every((word) => texts.get(row).includes(word));
  const count = rows.filter((row) => !row.hidden).length;
  found.textContent = words.length ? `${count} of ${rows.length}` : "";
}

// A number where the cell has one, else its text; who has none comes last, whichever way.
function compare(one, other, place, way) {
  const [a, b] = [one, other].map((row) => row.cells[place].dataset.key
    ?? row.cells[place].textContent);
  if (!a || !b) return (a ? 0 : 1) - (b ? 0 : 1);
  return way * a.localeCompare(b, undefined, { numeric: true });
}

function sort(head) {
  const way = head.ariaSort === "ascending" ? -1 : 1;
  for (const other of table.tHead.rows[0].cells) other.ariaSort = "none";
  head.ariaSort = way === 1 ? "ascending" : "descending";
  rows.sort((one, other) => compare(one, other, head.cellIndex, way));
  table.tBodies[0].append(...rows);
}

for (const head of table.tHead.rows[0].cells) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = head.textContent;
  button.addEventListener("click", () => sort(head));
  head.replaceChildren(button);
  head.ariaSort = "none";
}
field.addEventListener("input", show);
for (const link of document.querySelectorAll("a[data-find]")) {
  link.addEventListener("click", () => { field.value = link.dataset.find; show(); });
}
search.hidden = false;
show();
