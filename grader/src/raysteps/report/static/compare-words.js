"use strict";

/** @param {number[] | null} colour @returns {string} */
function colourWords(colour) {
  return colour ? colour.join(" ") : "no pixel";
}

/** A difference with its sign, as printed: +3, −3, 0. */
function signedWords(value) {
  return value > 0 ? `+${value}` : String(value).replace("-", "−");
}

/** FLIP's value of a pixel, from 0.00 to 1.00. */
function flipWords(pair, x, y) {
  return (pair.flip.data[(y * pair.width + x) * 4] / 255).toFixed(2);
}

function largestGap(difference) {
  return Math.max(...difference.map(Math.abs));
}

/** What a screen reader says of a pixel. */
function pixelInWords(pair, names, { x, y }) {
  const [reference, mine] = [PicturePair.colour(pair.reference, x, y), PicturePair.colour(pair.mine, x, y)];
  const difference = pair.difference(x, y);
  const gap = difference ? `, difference ${largestGap(difference)}` : "";
  return `pixel ${x}, ${y}: ${names.reference} ${colourWords(reference)}, ${names.mine} ${colourWords(mine)}${gap}`;
}

function tellColour(cell, colour) {
  const swatch = make("span", { class: "compare-swatch", "aria-hidden": "true" });
  if (colour) {
    swatch.style.backgroundColor = `rgb(${colour.join(" ")})`;
  }
  cell.replaceChildren(...(colour ? [swatch] : []), colourWords(colour));
}

/** Fills the readout with a pixel, or empties it. */
function tellPixel(cells, pair, pixel) {
  if (!pixel) {
    for (const cell of Object.values(cells)) {
      cell.replaceChildren("–");
    }
    return;
  }
  const { x, y } = pixel;
  cells.place.textContent = `x ${x}, y ${y}`;
  tellColour(cells.reference, PicturePair.colour(pair.reference, x, y));
  tellColour(cells.mine, PicturePair.colour(pair.mine, x, y));
  const difference = pair.difference(x, y);
  const signed = difference?.map(signedWords).join(" ");
  cells.difference.textContent = difference ? `${signed} (largest ${largestGap(difference)})` : "–";
  cells.flip.textContent = pair.flip ? flipWords(pair, x, y) : "no map";
}

function sizeWords(raster) {
  return `${raster.width} × ${raster.height}`;
}

/** What is there, what cannot be shown, and how much differs. */
function tellPair(ui, pair, names, known) {
  for (const button of ui.views) {
    const { id, needsBoth } = compareViews.find((view) => view.id === button.dataset.view);
    button.disabled = (needsBoth && !pair.comparable) || (id === "flip" && !pair.flip);
    if (id === "flip" && !pair.flip) {
      button.title =
        pair.comparable && !pair.wrong ? "FLIP: there is no difference" : "FLIP: there is no map of these pictures";
    }
  }
  ui.first.disabled = ui.worst.disabled = !pair.wrong;
  tellPixel(ui.cells, pair, null);
  tellHistogram(ui.histogram, pair.gaps);
  ui.count.classList.toggle("same", pair.comparable && !pair.wrong);
  ui.count.classList.toggle("trouble", !pair.comparable);
  ui.count.textContent = pair.comparable ? countWords(pair, known) : troubleWords(pair, names);
}

/** A grader shows a picture that is grossly wrong with fewer pixels and colours than it had: then its count holds. */
function countWords({ wrong: seen, width, height }, { counted, noisy }) {
  const all = width * height;
  const percent = 100 * (counted ?? seen / all);
  const wrong = Math.round((percent / 100) * all);
  const coarse =
    wrong === seen
      ? ""
      : " A picture that is mostly wrong is kept with fewer pixels and colours; your own check shows all of it.";
  const chance = noisy
    ? " Pixels of two right pictures differ by chance: what counts is the light of whole parts."
    : "";
  return wrong
    ? `${wrong} of ${all} pixels differ (${percent < 0.01 ? "under 0.01" : percent.toFixed(2)} %) by more than ${compareTolerance} of 255.${coarse}${chance}`
    : `No difference: no pixel is more than ${compareTolerance} of 255 away.`;
}

/** Why there is nothing to compare. */
function troubleWords(pair, names) {
  const missing = ["reference", "mine"].filter((role) => !pair[role]);
  return missing.length
    ? `There is no picture of: ${missing.map((role) => names[role]).join(", ")}.`
    : `The sizes differ: ${names.reference} is ${sizeWords(pair.reference)}, ${names.mine} is ${sizeWords(pair.mine)} pixels.`;
}
