import { along, flat, handle, list, said } from "./drawing-words.js";

// Step 11. The triangle from above: x to the right, y up; and from the side: x to the right, z up.

const CORNERS = [
  [0, 0],
  [4, 0],
  [0, 4],
];
const NORMALS = [
  [0, 0, 1],
  [0.6, 0, 0.8],
  [0, 0.6, 0.8],
];
const on = (label) => ({ label, min: 0, max: 4, step: 0.05, stride: 0.25, start: 2 });

export const MESH = {
  name: "mesh",
  title: "Your point of a triangle",
  intro:
    "The triangle of the worked example, whose first corner has the normal (0, 0, 1), with what your barycentric, " +
    "shading_normal and curved_position say. Drag the point, or use the arrow keys.",
  numbers: { x: on("x"), y: on("y") },
  limits: ({ y }) => ({ x: Number((4 - y).toFixed(6)) }),
  ask: ({ x, y }) => [x, y],
  views: [
    {
      label: "From above: the triangle, the point, the three small triangles around it, and the blended normal",
      box: [-0.5, -0.5, 4.7, 4.7],
      handles: [handle("Point", "x", "y")],
      draw: (view, { x, y }, { weights, normal }) => {
        view.line([...CORNERS, CORNERS[0]], "edge");
        CORNERS.forEach((corner, at) => {
          view.segment([x, y], corner, "faint");
          const [toX, toY] = along(corner, NORMALS[at], 0.8);
          view.arrow(corner, [toX, toY], "axis");
        });
        CORNERS.forEach(([cornerX, cornerY], at) => {
          view.words([cornerX + 0.1, cornerY + 0.15], said(Math.round(100 * weights[at]) / 100));
        });
        view.arrow([x, y], [x + normal[0], y + normal[1]], "ray");
      },
    },
    {
      label: "Cut through the point, from the side: the flat triangle, the curved surface, and the lifted point",
      box: [-0.5, -0.3, 4.7, 2.2],
      handles: [],
      draw: (view, { x, y }, { cut, lifted, normal }) => {
        view.segment([0, 0], [4 - y, 0], "edge");
        view.line(cut, "axis");
        view.segment([x, 0], flat(lifted), "miss");
        view.dot([x, 0], "point", 3);
        view.arrow(flat(lifted), flat(along(lifted, normal, 0.8)), "ray");
        view.dot(flat(lifted), "hit", 4);
      },
    },
  ],
  says: (_, { weights, normal, lifted }) =>
    `Weights ${list(weights)}, normal ${list(normal)}. Lifted: ${list(lifted)}.`,
};

const FARTHEST = 100;
const SHIFTS = [-6, -3, -2, -1, 0, 1, 2, 3, 6];
const shiftInWords = (shift) => (shift === 0 ? "your own" : `${Math.abs(shift)} ${shift < 0 ? "finer" : "coarser"}`);

export const LEVEL = {
  name: "level",
  title: "Your level of a texture",
  intro:
    "The triangle and the pixel of the worked example, with what your texels_across and mip_level say, and a floor of " +
    "such triangles, drawn by your build_pyramid and trilinear. Drag the hit, or use the arrow keys. Then let the " +
    "picture take a finer or coarser level than yours.",
  numbers: {
    distance: { label: "Distance of the hit", min: 1, max: FARTHEST, step: 1, stride: 5, start: 20 },
    cosine: { label: "The ray comes in at a cosine of", min: 0.1, max: 1, step: 0.05, start: 0.8 },
    shift: {
      label: "The picture takes the level",
      min: 0,
      max: SHIFTS.length - 1,
      step: 1,
      start: SHIFTS.indexOf(0),
      words: SHIFTS.map(shiftInWords),
    },
  },
  ask: ({ distance, cosine, shift }) => [distance, cosine, SHIFTS[shift]],
  views: [
    {
      label: "The distance to the right, the level upwards",
      box: [-2, -1.2, FARTHEST + 4, 6.4],
      stretch: 22,
      handles: [
        {
          label: "Distance of the hit",
          moves: ["distance"],
          place: ({ distance }) => [distance, 0],
          drag: ([x]) => ({ distance: x }),
        },
      ],
      draw: (view, { distance }, { curve, level }) => {
        for (let one = 0; one <= 6; one++) {
          view.segment([0, one], [FARTHEST, one], "faint");
        }
        view.line(curve, "edge");
        view.segment([distance, 0], [distance, level], "ray");
        view.dot([distance, level], "ray live-head", 4);
        view.words([1, 5.4], "level 0 to 6");
        view.words([66, -1], "distance");
      },
    },
    {
      label: "A floor of such triangles, to the horizon",
      box: [-4, -2, 4, 2],
      handles: [],
      draw: (view, _, { picture }) => view.picture([-4, 2], [4, -2], picture, 64),
    },
  ],
  says: ({ shift }, { texels, level, levels }) =>
    `The pixel covers ${said(texels)} texels: level ${said(level)} of 0 to ${levels.length - 1}. The picture takes ${
      SHIFTS[shift] === 0
        ? "your level at each pixel."
        : `a level ${shiftInWords(SHIFTS[shift])} than yours: ${
            SHIFTS[shift] < 0 ? "the squares break up into noise where they are small." : "the squares are blurred."
          }`
    }`,
};
