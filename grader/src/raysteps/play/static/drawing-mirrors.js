import { flat, handle, list, place, said } from "./drawing-words.js";

// Step 05. From the side: x to the right, z up.

const MAX_LIMIT = 8;

export const MIRRORS = {
  name: "mirrors",
  title: "Your ray between two mirrors",
  intro:
    "The two mirrors of the worked example, with what your trace and reflected_ray say. Each sends a light of 1 by " +
    "itself. Drag the eye, where it looks, and the limit of the depth, or use the arrow keys.",
  numbers: {
    limit: { label: "Limit of the depth", min: 1, max: MAX_LIMIT, step: 1, stride: 1, start: 3 },
    ks: { label: "ks", min: 0, max: 1, step: 0.05, start: 0.5 },
    x: place("Eye x", -1.8, 1.8, 0),
    z: place("Eye z", -1, 4, -0.5),
    aimX: place("Looks at x", -1.8, 1.8, 1.8),
    aimZ: place("Looks at z", -1, 4, -0.2),
  },
  ask: ({ limit, ks, x, z, aimX, aimZ }) => [limit, ks, x, z, aimX, aimZ],
  views: [
    {
      label: "From the side: two mirrors that face each other, the eye, and where its ray goes",
      box: [-2.2, -1.2, 2.2, 4.2],
      handles: [handle("Eye", "x", "z"), handle("Where the eye looks", "aimX", "aimZ")],
      draw: (view, _, { path }) => {
        for (const side of [-2, 2]) {
          view.segment([side, -1.2], [side, 4.2], "edge");
        }
        path.forEach(([from, to], at) => {
          view.arrow(flat(from), flat(to), at === 0 ? "ray" : "axis");
          view.dot(flat(to), "hit", 3);
        });
      },
    },
    {
      label: "The limit of the depth to the right, the light that arrives upwards",
      box: [0, -1.2, MAX_LIMIT + 0.6, 8.6],
      stretch: 20,
      handles: [
        {
          label: "Limit of the depth",
          moves: ["limit"],
          place: ({ limit }) => [limit, -0.6],
          drag: ([x]) => ({ limit: x }),
        },
      ],
      draw: (view, { limit }, { sums }) => {
        view.segment([0.4, 0], [MAX_LIMIT + 0.6, 0], "faint");
        sums.forEach((sum, at) => {
          view.segment([at + 1, 0], [at + 1, sum], at + 1 === limit ? "ray" : "edge");
          view.words([at + 0.75, sum + 0.3], sum.toFixed(2));
        });
      },
    },
  ],
  says: ({ limit }, { sum, path }) =>
    `With a limit of ${limit}, ${said(sum)} arrives. Hits: ${path.map(([, [x, , z]]) => list([x, z])).join(", ")}.`,
};
