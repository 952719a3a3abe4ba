"use strict";

/** From this difference of a channel on, of 255, each row of the histogram begins. */
const compareRanges = [0, 3, 9, 33, 129];

/** How many pixels differ by how much, as a drawing and as a table that says the same. */
function makeHistogram() {
  const canvas = make("canvas", { "aria-hidden": "true", width: 256, height: 64 });
  const body = make("tbody");
  const head = make(
    "tr",
    {},
    make("th", { scope: "col" }, "channel differs by"),
    make("th", { scope: "col" }, "pixels"),
  );
  const table = make("table", {}, make("thead", {}, head), body);
  const root = make(
    "details",
    { class: "compare-histogram", hidden: true },
    make("summary", {}, "Histogram of the differences"),
    canvas,
    table,
  );
  return { root, canvas, body };
}

/** @param {number[]} counts of pixels, by the channel that differs most, from 0 to 255 */
function tellHistogram({ root, canvas, body }, counts) {
  root.hidden = !counts.some(Boolean);
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, canvas.width, canvas.height);
  const highest = Math.log1p(Math.max(...counts));
  counts.forEach((count, gap) => {
    const tall = count ? Math.max(2, (canvas.height * Math.log1p(count)) / highest) : 0;
    context.fillStyle = gap > compareTolerance ? "#d9480f" : "#2b8a3e";
    context.fillRect(gap, canvas.height - tall, 1, tall);
  });
  const rows = compareRanges.map((from, at) => {
    const below = compareRanges[at + 1] ?? counts.length;
    const sum = counts.slice(from, below).reduce((all, count) => all + count, 0);
    const words = `${from} to ${below - 1}${at === 0 ? " (right)" : ""}`;
    return make("tr", {}, make("th", { scope: "row" }, words), make("td", {}, String(sum)));
  });
  body.replaceChildren(...rows);
}
