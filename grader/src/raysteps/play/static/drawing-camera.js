import { along, DEGREE, list, said } from "./drawing-words.js";

// Step 01. From the camera's side: -z to the right, the way that its up leans upwards. From the eye: x to the right, y
// up, in the window's own plane.

const tiltedUp = (tilt) => [Math.sin(tilt * DEGREE), Math.cos(tilt * DEGREE)];
const tipOf = ({ tilt }) => tiltedUp(tilt).map((one) => 1.8 * one);
const onWindow = (from, direction) => along(from, direction, -1 / direction[2]).slice(0, 2);

/** The middle of an edge of the window, or a corner of it: `across` and `upwards` are -1, 0 or 1. */
function edgeAt({ from, forward, right, up, halfWidth, halfHeight }, across, upwards) {
  const towardsSide = along(along(from, forward, 1), right, across * halfWidth);
  return along(towardsSide, up, upwards * halfHeight);
}

export const CAMERA = {
  name: "camera",
  title: "Your camera",
  intro:
    "The camera of the worked example, with what your view_frame and primary_ray say. Drag the tip of the camera's " +
    "up, or use the arrow keys and the sliders. A wide window is drawn smaller.",
  numbers: {
    angle: { label: "Angle", min: 10, max: 130, step: 1, start: 90, unit: "°" },
    tilt: { label: "up leans by", min: -90, max: 90, step: 1, stride: 5, start: 0, unit: "°" },
    width: { label: "Width", min: 1, max: 8, step: 1, start: 4 },
    height: { label: "Height", min: 1, max: 6, step: 1, start: 2 },
    x: { label: "Pixel x", min: 0, max: 7, step: 1, start: 3 },
    y: { label: "Pixel y", min: 0, max: 5, step: 1, start: 0 },
  },
  limits: ({ width, height }) => ({ x: width - 1, y: height - 1 }),
  ask: ({ angle, tilt, width, height, x, y }) => [angle, tilt, width, height, x, y],
  views: [
    {
      label: "From the side: the eye at the left, the window one unit ahead",
      box: [-0.5, -2.3, 3.5, 2.3],
      handles: [],
      draw: (view, { tilt }, answer) => {
        const { from } = answer;
        const [sin, cos] = tiltedUp(tilt);
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
          moves: ["tilt"],
          place: tipOf,
          drag: ([x, y]) => ({ tilt: Math.atan2(x, y) / DEGREE }),
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
