import { said } from "./drawing-words.js";

// Step 10. The pixel: x to the right, y up, both from 0 to 1. The filters: distance to the right, weight upwards.

const KINDS = ["anywhere", "stratified", "Halton's"];
const ROWS = 3; // the row of pixels, drawn that high
const across = (label, name, y) => ({
  label,
  moves: [name],
  place: (values) => [values[name], y],
  drag: ([x]) => ({ [name]: x }),
});
const edge = (label) => ({ label, min: 0, max: 1, step: 0.02, stride: 0.1, start: 0.5 });

export const SAMPLES = {
  name: "samples",
  title: "Your samples at an edge",
  intro:
    "A pixel that is white at the left of an edge, with your points. Drag both ends of the edge, or use the arrow " +
    "keys. Below, 32 pixels that see the same edge, each with points of its own: where they differ, that is noise. " +
    "Points anywhere are the framework's, for comparison.",
  numbers: {
    kind: { label: "Points", min: 0, max: 2, step: 1, start: 1, words: KINDS },
    side: { label: "Points along each side", min: 1, max: 8, step: 1, start: 2 },
    bottom: edge("Edge, below"),
    top: edge("Edge, above"),
  },
  ask: ({ kind, side, bottom, top }) => [kind, side, bottom, top],
  views: [
    {
      label: "A pixel: its squares, its points, those that see white filled, and the edge; below, a row of pixels",
      box: [-0.05, -0.22, 1.05, 1.1],
      handles: [across("Edge, below", "bottom", 0), across("Edge, above", "top", 1)],
      draw: (view, { side, bottom, top }, { points, row }) => {
        for (let line = 0; line <= side; line++) {
          view.segment([line / side, 0], [line / side, 1], "faint");
          view.segment([0, line / side], [1, line / side], "faint");
        }
        view.segment([bottom, 0], [top, 1], "edge");
        for (const [x, y, isWhite] of points) {
          view.dot([x, y], isWhite ? "ray live-head" : "hit", 4);
        }
        view.words([0, 1.04], "white");
        view.words([0.88, 1.04], "black");
        view.picture([0, -0.1], [1, -0.1 - ROWS / 32], row.repeat(ROWS), 32);
      },
    },
  ],
  says: ({ kind, side }, { points, mean, share, error }) =>
    `${side * side} ${side === 1 ? "point" : "points"}, ${KINDS[kind]}: ${points.filter((one) => one[2]).length} ` +
    `see white, and the pixel shows ${said(mean)}. Of the pixel ${said(share)} is white. The 32 pixels are off by ` +
    `${said(error)} (root mean square).`,
};

const FILTERS = ["box", "tent", "Mitchell's"];
const SAMPLES_OF = ["first", "second"];

export const FILTER = {
  name: "filter",
  title: "Your filters",
  intro:
    "The two samples of the worked example, with what your filters, reconstruct and linear_to_srgb say. Drag the " +
    "samples, or use the arrow keys, and take another filter.",
  numbers: {
    filter: { label: "Filter", min: 0, max: 2, step: 1, start: 1, words: FILTERS },
    first: { label: "First sample", min: -2, max: 2, step: 0.025, stride: 0.125, start: 0.625 },
    firstLight: { label: "Light of the first", min: 0, max: 1, step: 0.05, start: 0.9 },
    second: { label: "Second sample", min: -2, max: 2, step: 0.025, stride: 0.125, start: -0.25 },
    secondLight: { label: "Light of the second", min: 0, max: 1, step: 0.05, start: 0.3 },
  },
  onlyNumbers: ["reconstruct", "linear_to_srgb"],
  ask: ({ filter, first, firstLight, second, secondLight }) => [filter, first, firstLight, second, secondLight],
  views: [
    {
      label: "The distance from the middle of the pixel to the right, the weight upwards, and the two samples",
      box: [-2.1, -0.2, 2.1, 1.1],
      stretch: 130,
      handles: [across("First sample", "first", 0), across("Second sample", "second", 0)],
      draw: (view, values, { curve, weights }) => {
        view.segment([-2.1, 0], [2.1, 0], "faint");
        view.segment([0, 0], [0, 1.1], "faint");
        for (const side of [-0.5, 0.5]) {
          view.segment([side, -0.06], [side, 0.06], "edge"); // of the pixel
        }
        view.line(curve, "edge");
        SAMPLES_OF.forEach((name, at) => {
          view.segment([values[name], 0], [values[name], weights[at]], "ray");
          view.dot([values[name], weights[at]], "ray live-head", 4);
        });
        view.words([-0.42, -0.16], "the pixel");
      },
    },
  ],
  says: (_, { weights, mean, screen }) =>
    `Weights ${weights.map(said).join(" and ")}. The mean is ${said(mean)}, and the screen is sent ${said(screen)}.`,
};
