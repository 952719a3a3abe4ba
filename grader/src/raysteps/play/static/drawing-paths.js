import { DEGREE, handle, list, said } from "./drawing-words.js";

// Step 13. From the side: x to the right, y up.

const unit = (label, start) => ({ label, min: 0, max: 0.99, step: 0.01, stride: 0.05, start });
const dot = (one, other) => one.reduce((sum, part, axis) => sum + part * other[axis], 0);
const LOBE = 3; // how long a density of 1 is drawn
const towards = (degrees, length) => [length * Math.sin(degrees * DEGREE), length * Math.cos(degrees * DEGREE)];

export const COSINE = {
  name: "cosine",
  title: "Your directions",
  intro:
    "The surface of the worked example, with 200 directions by your cosine_direction and their density by your " +
    "cosine_pdf. Drag the two numbers u and the normal, or use the arrow keys. Seen along the normal, the directions " +
    "should fill the circle evenly.",
  numbers: {
    lean: { label: "The normal leans by", min: -180, max: 180, step: 1, stride: 10, start: 0, unit: "°" },
    x: unit("u x", 0.36),
    y: unit("u y", 0.25),
  },
  onlyNumbers: ["scatter_diffuse"],
  ask: ({ lean, x, y }) => [lean, x, y],
  views: [
    {
      label: "The square of the numbers u, with 200 others",
      box: [-0.4, -0.05, 1.4, 1.05],
      handles: [handle("u", "x", "y")],
      draw: (view, _, { others }) => {
        view.outline([0, 0], [1, 1], "edge");
        view.dots(others, "point", 1.5);
      },
    },
    {
      label: "From the side: the surface, its normal, all directions, the one of u, and the density in each direction",
      box: [-1.5, -1.15, 1.5, 1.15],
      handles: [
        {
          label: "Tip of the normal",
          moves: ["lean"],
          place: ({ lean }) => towards(lean, 1),
          drag: ([x, y]) => ({ lean: Math.atan2(x, y) / DEGREE }),
        },
      ],
      draw: (view, { lean }, { others, direction, lobe }) => {
        view.segment(towards(lean - 90, 1.1), towards(lean + 90, 1.1), "edge");
        view.arrow([0, 0], towards(lean, 0.9), "axis");
        view.line(
          lobe.map((point) => point.map((one) => LOBE * one)),
          "channel live-blue",
        );
        view.dots(
          others.map(([, , ...other]) => other),
          "point",
          1.5,
        );
        view.arrow([0, 0], direction.slice(0, 2), "ray");
      },
    },
    {
      label: "Along the normal: the same directions within the circle of length 1",
      box: [-1.7, -1.1, 1.7, 1.1],
      handles: [],
      draw: (view, { lean }, { others, direction }) => {
        const [x, y] = towards(lean + 90, 1);
        const seen = ([toX, toY, toZ]) => [x * toX + y * toY, -toZ];
        view.circle([0, 0], 1, "edge");
        view.dots(
          others.map(([, , ...other]) => seen(other)),
          "point",
          1.5,
        );
        view.arrow([0, 0], seen(direction), "ray");
      },
    },
  ],
  says: ({ x, y }, { normal, direction, height, pdf, weight, others }) =>
    `u = ${list([x, y])} becomes ${list(direction)}, which rises by ${said(height)} along the normal. Its density is ` +
    `${said(pdf)}, and the weight ${list(weight)}. Of all 200, ` +
    `${others.filter(([, , ...other]) => dot(other, normal) ** 2 < 0.5).length} lie in the outer half of the circle, ` +
    "evenly spread it is 100.",
};

export const ROULETTE = {
  name: "roulette",
  title: "Your paths between surfaces without end",
  intro:
    "Each surface adds a light of 1 and sends on the same share of all that comes, so a path must find " +
    "1 + share + share² and so on. 500 paths by your path_light and survival_probability. Drag the share, or use the " +
    "arrow keys: paths get longer, and noisier.",
  numbers: { share: { label: "Share that is sent on", min: 0, max: 0.95, step: 0.01, stride: 0.05, start: 0.8 } },
  ask: ({ share }) => [share],
  views: [
    {
      label: "How many surfaces a path meets to the right, of 500 paths how many upwards",
      box: [0, -60, 25, 520],
      stretch: 0.3,
      handles: [
        {
          label: "Share that is sent on",
          moves: ["share"],
          place: ({ share }) => [25 * share, -35],
          drag: ([x]) => ({ share: x / 25 }),
        },
      ],
      draw: (view, _, { lengths }) => {
        view.segment([0.4, 0], [25, 0], "faint");
        lengths.forEach((count, at) => {
          view.segment([at + 1, 0], [at + 1, count], "ray");
          if (count >= 50) {
            view.words([at + 0.6, count + 10], String(count));
          }
        });
        view.words([16, 480], `last: ${lengths.length} or more`);
      },
    },
    {
      label: "Paths to the right, their mean upwards, and the right mean dashed",
      box: [0, 0, 500, 2],
      stretch: 90,
      handles: [],
      draw: (view, { share }, { means }) => {
        const right = 1 / (1 - share);
        view.segment([0, 0], [500, 0], "faint");
        view.segment([0, 1], [500, 1], "miss");
        view.line(
          means.map(([count, mean]) => [count, Math.min(2, mean / right)]),
          "edge",
        );
        view.words([10, 1.85], "twice as much");
      },
    },
  ],
  says: ({ share }, { mean, survival, longest, lengths }) =>
    `A path that counts ${said(share)} goes on with a probability of ${said(survival)}. The mean of 500 paths is ` +
    `${said(mean)}, right on average is ${said(1 / (1 - share))}. They meet ` +
    `${lengths.findIndex((count) => count > 0) + 1} surfaces at least, ${longest} at most.`,
};
