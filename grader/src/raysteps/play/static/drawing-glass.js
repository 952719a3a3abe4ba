import { along, flat, handle, list, said } from "./drawing-words.js";

// Step 08. From the side: x to the right, z up, the ray comes from above.

const MEDIA = ["air", "glass"];
const at = (label, min, max, start) => ({ label, min, max, step: 0.05, stride: 0.05, start });

export const GLASS = {
  name: "glass",
  title: "Your ray at the surface of glass",
  intro:
    "The glass of the worked example, with what your transmitted_ray says. Drag where the ray comes from, or use the " +
    "arrow keys. Then let it come from inside of the glass: beyond some angle nothing gets out.",
  numbers: {
    index: { label: "Index of refraction", min: 1, max: 2.5, step: 0.05, start: 1.5 },
    inside: { label: "The ray comes from", min: 0, max: 1, step: 1, start: 0, words: MEDIA },
    x: at("Origin x", -1, 1, -0.6),
    z: at("Origin z", 0.05, 1, 0.8),
  },
  ask: ({ index, inside, x, z }) => [index, inside, x, z],
  views: [
    {
      label: "From the side: the surface of the glass, its normal upwards, and the ray",
      box: [-1.15, -1.05, 1.15, 1.05],
      handles: [handle("Origin of the ray", "x", "z")],
      draw: (view, { x, z, inside }, { leaves }) => {
        view.area([-1.15, inside ? 1.05 : 0], [1.15, inside ? 0 : -1.05]);
        view.segment([-1.15, 0], [1.15, 0], "edge");
        view.segment([0, -1.05], [0, 1.05], "faint");
        view.words([0.7, 0.05], MEDIA[inside]);
        view.words([0.7, -0.13], MEDIA[1 - inside]);
        view.segment([x, z], [0, 0], "ray");
        view.arrow([0, 0], flat(along([0, 0, 0], leaves, 1)), "ray");
      },
    },
    {
      label: "The angle before to the right, the angle after upwards, in degrees; a thick line where rays are mirrored",
      box: [-6, -8, 92, 92],
      handles: [],
      draw: (view, _, { curve, angle, angleAfter }) => {
        view.segment([0, 0], [90, 0], "faint");
        view.segment([0, 0], [0, 90], "faint");
        view.segment([0, 0], [90, 90], "miss");
        view.line(
          curve.map((after, before) => [before, after ?? Number.NaN]),
          "edge",
        );
        if (curve.includes(null)) {
          view.segment([curve.indexOf(null), 0], [90, 0], "axis");
        }
        view.words([2, 84], "90° after");
        view.words([66, -7], "90° before");
        view.dot([angle, angleAfter], "hit", 5);
      },
    },
  ],
  says: ({ inside }, { arrives, angle, leaves, angleAfter }) =>
    `From ${MEDIA[inside]}, along ${list(arrives)}, ${said(angle)}° from the normal. ${
      leaves[2] < 0
        ? `In ${MEDIA[1 - inside]} it goes on along ${list(leaves)}, ${said(angleAfter)}° from it.`
        : `Nothing gets into ${MEDIA[1 - inside]}: it is mirrored, along ${list(leaves)}.`
    }`,
};
