// What the live figures draw, step by step. Each asks framework/web/figures.cpp: whatever is a step's work comes from
// there, by the student's functions. Only what a reader sets, or what is given, is known here: this file goes out to
// students, so no formula of a step stands in it.

/** Numbers as the handouts write them: four digits behind the point, no zeros at the end. */
export function said(number) {
  return typeof number === "number" ? String(Number(number.toFixed(4)) + 0) : String(number);
}

const list = (vector) => `(${vector.map(said).join(", ")})`;
const along = (from, direction, distance) => from.map((one, axis) => one + distance * direction[axis]);
const DEGREE = Math.PI / 180;

// Step 01. From the camera's side: -z to the right, the way that its up leans upwards. From the eye: x to the right, y
// up, in the window's own plane.

const leaningTo = (leaning) => [Math.sin(leaning * DEGREE), Math.cos(leaning * DEGREE)];
const tipOf = ({ leaning }) => leaningTo(leaning).map((one) => 1.8 * one);
const onWindow = (from, direction) => along(from, direction, -1 / direction[2]).slice(0, 2);

/** The middle of an edge of the window, or a corner of it: `across` and `upwards` are -1, 0 or 1. */
function edgeAt({ from, forward, right, up, halfWidth, halfHeight }, across, upwards) {
  const towardsSide = along(along(from, forward, 1), right, across * halfWidth);
  return along(towardsSide, up, upwards * halfHeight);
}

const CAMERA = {
  name: "camera",
  title: "Your camera",
  intro:
    "The camera of the worked example, with what your view_frame and primary_ray say. Drag the tip of the camera's " +
    "up, or use the arrow keys and the sliders. A wide window is drawn smaller.",
  numbers: {
    angle: { label: "Angle", min: 10, max: 130, step: 1, start: 90, unit: "°" },
    leaning: { label: "up leans by", min: -90, max: 90, step: 1, stride: 5, start: 0, unit: "°" },
    width: { label: "Width", min: 1, max: 8, step: 1, start: 4 },
    height: { label: "Height", min: 1, max: 6, step: 1, start: 2 },
    x: { label: "Pixel x", min: 0, max: 7, step: 1, start: 3 },
    y: { label: "Pixel y", min: 0, max: 5, step: 1, start: 0 },
  },
  most: ({ width, height }) => ({ x: width - 1, y: height - 1 }),
  ask: ({ angle, leaning, width, height, x, y }) => [angle, leaning, width, height, x, y],
  views: [
    {
      label: "From the side: the eye at the left, the window one unit ahead",
      box: [-0.5, -2.3, 3.5, 2.3],
      handles: [],
      draw: (view, { leaning }, answer) => {
        const { from } = answer;
        const [sin, cos] = leaningTo(leaning);
        const fromSide = ([x, y, z]) => [from[2] - z, x * sin + y * cos];
        for (const direction of answer.directions) {
          view.segment(fromSide(from), fromSide(along(from, direction, 3)), "faint");
        }
        view.segment(fromSide(edgeAt(answer, 0, 1)), fromSide(edgeAt(answer, 0, -1)), "edge");
        view.arrow(fromSide(from), fromSide(along(from, answer.forward, 1)), "axis");
        view.arrow(fromSide(from), fromSide(along(from, answer.up, 1)), "axis");
        view.arrow(fromSide(from), fromSide(along(from, answer.direction, 3)), "ray");
        view.dot(fromSide(from), "point");
      },
    },
    {
      label: "From the eye: the window and the centres of its pixels",
      box: [-2.6, -2.3, 2.6, 2.3],
      handles: [
        {
          label: "Tip of the camera's up",
          moves: ["leaning"],
          place: tipOf,
          drag: ([x, y]) => ({ leaning: Math.atan2(x, y) / DEGREE }),
        },
      ],
      draw: (view, values, answer) => {
        view.segment([0, 0], tipOf(values), "miss");
        const farthest = Math.hypot(answer.halfWidth, answer.halfHeight);
        const fitting = farthest > 2.3 ? 2.3 / farthest : 1;
        const fit = ([x, y]) => [fitting * x, fitting * y];
        const corners = [
          [-1, -1],
          [1, -1],
          [1, 1],
          [-1, 1],
          [-1, -1],
        ].map(([across, upwards]) => fit(edgeAt(answer, across, upwards)));
        view.line(corners, "edge");
        const middle = fit(edgeAt(answer, 0, 0));
        view.arrow(middle, along(middle, answer.right, 0.8), "axis");
        view.arrow(middle, along(middle, answer.up, 0.8), "axis");
        for (const direction of answer.directions.filter(([, , z]) => z < 0)) {
          view.dot(fit(onWindow(answer.from, direction)), "hit", 2.5);
        }
        if (answer.direction[2] < 0) {
          view.dot(fit(onWindow(answer.from, answer.direction)), "ray live-head", 5);
        }
      },
    },
  ],
  says: ({ x, y }, answer) =>
    `forward ${list(answer.forward)}, right ${list(answer.right)}, up ${list(answer.up)}; ` +
    `half_width ${said(answer.halfWidth)}, half_height ${said(answer.halfHeight)}. ` +
    `The ray through pixel (${x}, ${y}) has the direction ${list(answer.direction)}.`,
};

// Step 02. From above: x to the right, z up, in the plane in which the ray runs.

const flat = ([x, , z]) => [x, z];

/** A ray from a handle to another. */
function rayFigure({ name, title, intro, box, plane, start, aim, outline }) {
  const [left, near, right, far] = box;
  const place = (label, min, max, at) => ({ label, min, max, step: 0.1, stride: 0.5, start: at });
  const handle = (label, x, z) => ({
    label,
    moves: [x, z],
    place: (values) => [values[x], values[z]],
    drag: ([toX, toZ]) => ({ [x]: toX, [z]: toZ }),
  });
  return {
    name,
    title,
    intro,
    numbers: {
      y: { label: "Height of the ray, y", step: 0.1, ...plane },
      x: place("Origin x", left, right, start[0]),
      z: place("Origin z", near, far, start[1]),
      aimX: place("Aimed at x", left, right, aim[0]),
      aimZ: place("Aimed at z", near, far, aim[1]),
    },
    ask: ({ y, x, z, aimX, aimZ }) => [y, x, z, aimX, aimZ],
    views: [
      {
        label: "From above, cut at the height of the ray: x to the right, z upwards",
        box,
        handles: [handle("Origin of the ray", "x", "z"), handle("Where the ray is aimed at", "aimX", "aimZ")],
        draw: (view, { y, x, z }, { direction, hit }) => {
          outline(view, y);
          const origin = [x, y, z];
          view.arrow(flat(origin), flat(along(origin, direction, hit ? hit.distance : 30)), hit ? "ray" : "miss");
          if (hit) {
            view.segment(flat(hit.position), flat(along(hit.position, direction, 30)), "faint");
            view.arrow(flat(hit.position), flat(along(hit.position, hit.normal, 2)), "axis");
            view.dot(flat(hit.position), "hit", 5);
          }
        },
      },
    ],
    says: ({ y, x, z }, { direction, hit }) =>
      `From ${list([x, y, z])} along ${list(direction)}: ${
        hit
          ? `a hit at the distance ${said(hit.distance)}, position ${list(hit.position)}, normal ${list(hit.normal)}, ` +
            `from the ${hit.front ? "front" : "back"}.`
          : "no hit."
      }`,
  };
}

const SPHERE = rayFigure({
  name: "sphere",
  title: "Your ray and a sphere",
  intro:
    "The sphere of the worked example, with what your Sphere::intersect says. Drag both ends of the ray, or use the " +
    "arrow keys: begin inside of the sphere, behind it, or touch it.",
  box: [-8, -4, 10, 15],
  plane: { min: -3, max: 7, start: 2 },
  start: [4, 13],
  aim: [4, 3],
  outline: (view, y) => {
    view.circle([1, 3], Math.sqrt(Math.max(0, 25 - (y - 2) ** 2)), "edge");
    view.dot([1, 3], "point", 3);
  },
});

const TRIANGLE = rayFigure({
  name: "triangle",
  title: "Your ray and a triangle",
  intro:
    "The triangle of the worked example, seen from above and cut at the height of the ray, with what your " +
    "Triangle::intersect says. At another height the cut has another length.",
  box: [-4, -5, 8, 5],
  plane: { min: -1, max: 5, start: 1 },
  start: [-2, 4],
  aim: [1, 0],
  outline: (view, y) => {
    if (y >= 0 && y <= 4) {
      view.segment([0, 0], [4 - y, 0], "edge");
    }
  },
});

// Step 07. Light to the right, what is shown of it upwards.

const MOST = 5;
const CHANNELS = [
  ["red", 3],
  ["green", 1.5],
  ["blue", 0.25],
];

const TONE = {
  name: "tone",
  title: "Your tone curve",
  intro:
    "The light of the worked example, with what your tone_map and to_byte say. Drag the three channels, or use the " +
    "arrow keys; the exposure multiplies them all. The dashed line is light that is cut off at 1.",
  numbers: {
    exposure: { label: "Exposure", min: 0, max: 8, step: 0.05, start: 1 },
    ...Object.fromEntries(
      CHANNELS.map(([name, start]) => [
        name,
        { label: `Light, ${name}`, min: 0, max: MOST, step: 0.05, stride: 0.25, start },
      ]),
    ),
  },
  ask: ({ exposure, red, green, blue }) => [MOST, exposure, red, green, blue],
  views: [
    {
      label: "The curve: light to the right, what is shown upwards, and both colours",
      box: [0, -0.5, MOST, 1.05],
      stretch: 150,
      handles: CHANNELS.map(([name]) => ({
        label: `Light, ${name}`,
        moves: [name],
        place: (values) => [values[name], 0],
        drag: ([x]) => ({ [name]: x }),
      })),
      draw: (view, values, { curve, shown, bytes, cutOff }) => {
        view.segment([0, 0], [0, 1.05], "faint");
        view.segment([0, 0], [MOST, 0], "faint");
        view.segment([0, 1], [MOST, 1], "faint");
        const bend = Math.min(MOST, 1 / values.exposure);
        view.line(
          [
            [0, 0],
            [bend, bend * values.exposure],
            [MOST, Math.min(1, MOST * values.exposure)],
          ],
          "miss",
        );
        view.line(
          curve.map((one, at) => [(MOST * at) / (curve.length - 1), one]),
          "ray",
        );
        CHANNELS.forEach(([name], at) => {
          view.segment([values[name], 0], [values[name], shown[at]], `channel live-${name}`);
          view.dot([values[name], shown[at]], `channel live-${name} live-full`, 5);
        });
        view.words([0, -0.23], "tone mapped");
        view.words([2.6, -0.23], "cut off");
        view.swatch([0, -0.27], [2.4, -0.5], bytes);
        view.swatch([2.6, -0.27], [MOST, -0.5], cutOff);
      },
    },
  ],
  says: (_, { light, shown, bytes, cutOff }) =>
    `The light ${list(light)} becomes ${list(shown)}, bytes (${bytes.join(", ")}): the colour at the left. ` +
    `Cut off at 1 it would be (${cutOff.join(", ")}), at the right.`,
};

const OF_STEPS = { "01": [CAMERA], "02": [SPHERE, TRIANGLE], "07": [TONE] };

export const drawingsOf = (number) => OF_STEPS[number] ?? [];
