import { along, DEGREE, flat, handle, list, place, said } from "./drawing-words.js";

// Steps 03 and 04. From the side: x to the right, z up.

const FROM_SIDE = [-4.5, -0.4, 4.5, 6];
const HIGHLIGHT = 4; // how long a highlight of 1 is drawn

export const PHONG = {
  name: "phong",
  title: "Your light and its highlight",
  intro:
    "The surface of the worked example, with what your functions say, and a ball of the same surface. Drag the light " +
    "and the eye, or use the arrow keys. The blue line shows how much of the highlight an eye in each direction sees: " +
    "a larger shine makes it narrower.",
  numbers: {
    lightX: place("Light x", -4, 4, 3),
    lightZ: place("Light z", 0.5, 5.5, 4),
    eyeX: place("Eye x", -4, 4, 0),
    eyeZ: place("Eye z", 0.5, 5.5, 5),
    kd: { label: "kd", min: 0, max: 1, step: 0.05, start: 0.6 },
    ks: { label: "ks", min: 0, max: 1, step: 0.05, start: 0.5 },
    shine: { label: "shine", min: 1, max: 100, step: 1, start: 2 },
  },
  ask: ({ lightX, lightZ, eyeX, eyeZ, kd, ks, shine }) => [lightX, lightZ, eyeX, eyeZ, kd, ks, shine],
  views: [
    {
      label: "From the side: the surface, its normal, the light, the eye, and where a mirror would send the light",
      box: FROM_SIDE,
      handles: [handle("Light", "lightX", "lightZ"), handle("Eye", "eyeX", "eyeZ")],
      draw: (view, { lightX, lightZ, eyeX, eyeZ }, { mirrored, highlight }) => {
        view.segment([-4.5, 0], [4.5, 0], "edge");
        view.arrow([0, 0], [0, 1], "axis");
        view.segment([lightX, lightZ], [0, 0], "ray");
        view.arrow([0, 0], flat(along([0, 0, 0], mirrored, 2.5)), "miss");
        view.segment([0, 0], [eyeX, eyeZ], "faint");
        view.line(
          highlight.map((bright, at) => {
            const angle = (at - 90) * DEGREE;
            return [HIGHLIGHT * bright * Math.sin(angle), HIGHLIGHT * bright * Math.cos(angle)];
          }),
          "channel live-blue",
        );
        view.words([lightX + 0.25, lightZ + 0.15], "light");
        view.words([eyeX + 0.25, eyeZ + 0.15], "eye");
      },
    },
    {
      label: "A ball of this surface from straight above, in the same light",
      box: [-1, -1, 1, 1],
      handles: [],
      draw: (view, _, { ball }) => view.picture([-1, 1], [1, -1], ball, 48),
    },
  ],
  says: (_, { mirrored, diffuse, specular, sum }) =>
    `Diffuse ${list(diffuse)}. The light is mirrored along ${list(mirrored)}, specular ${list(specular)}. ` +
    `The sum is ${list(sum)}.`,
};

const THRESHOLDS = [0, 0.000001, 0.00001, 0.0001, 0.001, 0.003, 0.01, 0.03, 0.1];

export const SHADOW = {
  name: "shadow",
  title: "Your shadow ray and its threshold",
  intro:
    "The hit, the light and the ball of the worked example, with what your shadow_ray and is_lit say, and a ball and " +
    "two low strips, 0.09 and 0.025 high, on a floor at coordinates around 100. Your functions are given hits that " +
    "are moved along the normal, so that your shadow rays start as far off the surface as you set here.",
  numbers: {
    threshold: {
      label: "Threshold",
      min: 0,
      max: THRESHOLDS.length - 1,
      step: 1,
      start: THRESHOLDS.indexOf(0.001),
      words: THRESHOLDS.map((one) => (one === 0.000001 ? "0.000001" : String(one).replace("1e-5", "0.00001"))),
    },
    x: place("Hit x", -1, 5, 1),
    lightX: place("Light x", -1, 6, 4),
    lightZ: place("Light z", 0.5, 5, 4),
  },
  ask: ({ threshold, x, lightX, lightZ }) => [THRESHOLDS[threshold], x, lightX, lightZ],
  views: [
    {
      label: "From the side: the floor, a hit on it, a ball and the light",
      box: [-1.2, -0.4, 6.2, 5.2],
      handles: [
        { label: "Hit", moves: ["x"], place: ({ x }) => [x, 0], drag: ([x]) => ({ x }) },
        handle("Light", "lightX", "lightZ"),
      ],
      draw: (view, { lightX, lightZ }, { start, lit }) => {
        view.segment([-1.2, 0], [6.2, 0], "edge");
        view.circle([3.1, 2.8], 0.5, "edge");
        view.segment(flat(start), [lightX, lightZ], lit ? "ray" : "miss");
        view.words([lightX + 0.2, lightZ + 0.15], "light");
      },
    },
    {
      label: "A ball and two low strips on a floor, in low light from the right",
      box: [-4, -3, 4, 3],
      handles: [],
      draw: (view, _, { picture }) => view.picture([-4, 3], [4, -3], picture, 64),
    },
  ],
  says: (_, { start, direction, lit, darker, brighter }) =>
    `The shadow ray starts at ${list(start)} along ${list(direction)}: ${lit ? "lit" : "in shadow"}. ` +
    `Of the picture's 3072 pixels, ${said(darker)} are dark and ${said(brighter)} lit that are not so with your own ` +
    `threshold.${darker > 100 ? " Dark speckles are shadow acne." : ""}` +
    (brighter > 60 ? " What is lower than the threshold throws no shadow." : ""),
};
