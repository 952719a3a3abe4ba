import { list } from "./drawing-words.js";

// Step 07. Light to the right, what is shown of it upwards.

const BRIGHTEST = 5;
const CHANNELS = [
  ["red", 3],
  ["green", 1.5],
  ["blue", 0.25],
];

export const TONE = {
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
        { label: `Light, ${name}`, min: 0, max: BRIGHTEST, step: 0.05, stride: 0.25, start },
      ]),
    ),
  },
  ask: ({ exposure, red, green, blue }) => [BRIGHTEST, exposure, red, green, blue],
  views: [
    {
      label: "The curve: light to the right, what is shown upwards, and both colours",
      box: [0, -0.5, BRIGHTEST, 1.05],
      stretch: 150,
      handles: CHANNELS.map(([name]) => ({
        label: `Light, ${name}`,
        moves: [name],
        place: (values) => [values[name], 0],
        drag: ([x]) => ({ [name]: x }),
      })),
      draw: (view, values, { curve, shown, bytes, cutOff }) => {
        view.segment([0, 0], [0, 1.05], "faint");
        view.segment([0, 0], [BRIGHTEST, 0], "faint");
        view.segment([0, 1], [BRIGHTEST, 1], "faint");
        const bend = Math.min(BRIGHTEST, 1 / values.exposure);
        view.line(
          [
            [0, 0],
            [bend, bend * values.exposure],
            [BRIGHTEST, Math.min(1, BRIGHTEST * values.exposure)],
          ],
          "miss",
        );
        view.line(
          curve.map((one, at) => [(BRIGHTEST * at) / (curve.length - 1), one]),
          "ray",
        );
        CHANNELS.forEach(([name], at) => {
          view.segment([values[name], 0], [values[name], shown[at]], `channel live-${name}`);
          view.dot([values[name], shown[at]], `channel live-${name} live-full`, 5);
        });
        view.words([0, -0.23], "tone mapped");
        view.words([2.6, -0.23], "cut off");
        view.swatch([0, -0.27], [2.4, -0.5], bytes);
        view.swatch([2.6, -0.27], [BRIGHTEST, -0.5], cutOff);
      },
    },
  ],
  says: (_, { light, shown, bytes, cutOff }) =>
    `The light ${list(light)} becomes ${list(shown)}, bytes (${bytes.join(", ")}): the colour at the left. ` +
    `Cut off at 1 it would be (${cutOff.join(", ")}), at the right.`,
};
