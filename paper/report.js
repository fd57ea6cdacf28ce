// The report on the screen: tables are sorted by a click on a heading, the contents fold on narrow screens and show the
// part that is being read.
"use strict";

const wide = window.matchMedia("(min-width: 75rem)");
const contents = document.querySelector("#TOC details");
const fold = () => { contents.open = wide.matches; };
fold();
wide.addEventListener("change", fold);
contents.addEventListener("click", (event) => {
  if (event.target.closest("a") && !wide.matches) contents.open = false;
});

// A folded table opens when a link leads to it.
const unfold = () => {
  const place = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const details = place && place.querySelector("details");
  if (details) details.open = true;
};
unfold();
window.addEventListener("hashchange", unfold);

const key = (row, column) => {
  const cell = row.cells[column];
  const text = cell.textContent.trim();
  return cell.dataset.v !== undefined ? Number(cell.dataset.v) : text === "" ? null : text;
};
const compare = (one, other) => typeof one === "number" && typeof other === "number"
  ? one - other : String(one).localeCompare(String(other), "en", { numeric: true });

for (const table of document.querySelectorAll(".wide table")) {
  if (table.tBodies[0].rows.length < 4) continue;
  table.querySelectorAll("thead th").forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.title = head.title ? head.title + "\n(a click sorts)" : "sort";
    head.removeAttribute("title");
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      table.querySelectorAll("th").forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      // Empty cells stay at the end.
      const rows = [...table.tBodies[0].rows].map((row) => [key(row, column), row]);
      rows.sort(([one], [other]) => one === null || other === null
        ? (one === null) - (other === null) : down ? compare(other, one) : compare(one, other));
      table.tBodies[0].append(...rows.map(([, row]) => row));
    });
  });
}

const entries = new Map([...document.querySelectorAll("#TOC a")].map((link) => [link.hash.slice(1), link]));
const headings = [...document.querySelectorAll("main h1[id], main h2[id]")].filter(({ id }) => entries.has(id));
let current;
const follow = () => {
  const read = headings.filter((heading) => heading.getBoundingClientRect().top < 120).pop() || headings[0];
  const link = read && entries.get(read.id);
  if (!link || link === current) return;
  if (current) current.removeAttribute("aria-current");
  current = link;
  link.setAttribute("aria-current", "true");
  if (wide.matches) link.scrollIntoView({ block: "nearest" });
};
document.addEventListener("scroll", follow, { passive: true });
follow();
