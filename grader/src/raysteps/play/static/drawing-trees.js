import { along, flat, handle, list, place, said } from "./drawing-words.js";

// Step 06. From above: x to the right, z up, in the plane in which the balls lie.

export const OCTREE = {
  name: "octree",
  title: "Your octree and a ray",
  intro:
    "The box and the ray of the worked example, with what your Box::clip says, and 90 balls in your octree. Drag both " +
    "ends of the ray, or use the arrow keys. The boxes that it enters before its hit are filled.",
  numbers: {
    x: place("Origin x", -3.2, 1.6, -3),
    z: place("Origin z", -1.4, 3.2, 3),
    aimX: place("Aimed at x", -3.2, 1.6, 0),
    aimZ: place("Aimed at z", -1.4, 3.2, -1),
  },
  ask: ({ x, z, aimX, aimZ }) => [x, z, aimX, aimZ],
  views: [
    {
      label:
        "From above: the box of the worked example, the balls, the boxes of the tree that the ray enters, and the ray",
      box: [-3.3, -1.5, 1.7, 3.3],
      handles: [handle("Origin of the ray", "x", "z"), handle("Where the ray is aimed at", "aimX", "aimZ")],
      draw: (view, { x, z }, { balls, entered, direction, distance }) => {
        view.outline([-1, -1], [1, 1], "edge");
        for (const [low, high, enter] of entered) {
          if (distance < 0 || enter <= distance) {
            view.area(flat(low), flat(high));
          }
          view.outline(flat(low), flat(high), "faint");
        }
        for (const ball of balls) {
          view.circle(flat(ball), 0.03, "thin");
        }
        const origin = [x, 0, z];
        const end = along(origin, direction, distance < 0 ? 10 : distance);
        view.arrow(flat(origin), flat(end), distance < 0 ? "miss" : "ray");
        if (distance >= 0) {
          view.dot(flat(end), "hit", 4);
        }
      },
    },
  ],
  says: ({ x, z }, { direction, enter, leave, distance, boxTests, surfaceTests, balls }) =>
    `From ${list([x, 0, z])} along ${list(direction)}: ${
      enter < 0 ? "it misses the box" : `in the box from ${said(enter)} to ${said(leave)}`
    }. ${distance < 0 ? "No ball is hit" : `A ball is hit at the distance ${said(distance)}`}, after ` +
    `${boxTests} tests of boxes and ${surfaceTests} of balls; without a tree it is ${balls.length} of balls.`,
};

// Step 09. From above: x to the right, y up.

export const CUTS = {
  name: "cuts",
  title: "Your cost of a cut",
  intro:
    "The ten surfaces of the worked example, by their boxes, with what your surface_area and split_cost say. Drag the " +
    "cut, or use the arrow keys: a surface is left of it by its middle. Drag the last surface nearer to the heap, too.",
  numbers: {
    cut: { label: "Cut at x", min: 0.15, max: 3, step: 0.05, stride: 0.05, start: 2 },
    last: { label: "The last surface ends at x", min: 2, max: 4, step: 0.05, stride: 0.25, start: 4 },
  },
  limits: ({ last }) => ({ cut: last - 0.5 }),
  ask: ({ cut, last }) => [cut, last],
  views: [
    {
      label: "From above: ten boxes, the two around those left and right of the cut, and the cost of each cut below",
      box: [-0.2, -2.6, 4.2, 2.3],
      handles: [
        {
          label: "Cut",
          moves: ["cut"],
          place: ({ cut }) => [cut, -0.3],
          drag: ([x]) => ({ cut: x }),
        },
        {
          label: "The last surface",
          moves: ["last"],
          place: ({ last }) => [last, 1],
          drag: ([x]) => ({ last: x }),
        },
      ],
      draw: (view, { cut }, { boxes, left, right, costs, cost }) => {
        const outline = ([low, high], look) => view.outline(low.slice(0, 2), high.slice(0, 2), look);
        for (const box of boxes) {
          outline(box, "faint");
        }
        outline(left, "ray");
        outline(right, "axis");
        view.segment([cut, -0.3], [cut, 2.2], "miss");
        const height = (one) => -2.5 + 0.16 * one;
        view.segment([0, -2.5], [4, -2.5], "faint");
        view.line(
          costs.map((one, at) => [(4 * at) / (costs.length - 1), height(one)]),
          "edge",
        );
        view.dot([cut, height(cost)], "hit", 5);
        view.words([0, -0.55], "cost");
      },
    },
  ],
  says: (_, { area, leftArea, rightArea, leftCount, rightCount, cost, boxes }) =>
    `The area of the whole: ${said(area)}. Left ${leftCount} in a box of ${said(leftArea)}, right ${rightCount} in a box ` +
    `of ${said(rightArea)}: the cut costs ${said(cost)}. No cut: ${boxes.length}.`,
};
