import { along, handle, list, place, said } from "./drawing-words.js";

// Step 12. The lamp from the side: x to the right, y up. The lens from above: x to the right, away from the eye is up.

const KINDS = ["disk", "triangle", "sphere"];
const CORNERS = [
  [1, 0],
  [-0.5, Math.sqrt(0.75)],
  [-0.5, -Math.sqrt(0.75)],
  [1, 0],
];

/** How many of the samples lie where an even spread puts half of them, or of a triangle a quarter. */
function spreadInWords(kind, points) {
  const isTriangle = KINDS[kind] === "triangle";
  const inPart = points.filter(([, , x, y]) => (isTriangle ? x > 0.25 : x * x + y * y > 0.5)).length;
  return isTriangle
    ? `${inPart} of them lie in the quarter at one corner, evenly spread it is 25`
    : `${inPart} of them lie in the outer half of it, evenly spread it is 50`;
}

export const LAMP = {
  name: "lamp",
  title: "Your samples of a lamp",
  intro:
    "The floor and the lamp of the worked example, with 100 of your samples. Drag the lamp and the lit place, or use " +
    "the arrow keys; take another lamp, and turn it away. The second view is the lamp itself: points should be " +
    "spread evenly over it.",
  numbers: {
    kind: { label: "Lamp", min: 0, max: 2, step: 1, start: 0, words: KINDS },
    x: place("Lamp x", -1, 5, 3),
    y: place("Lamp y", 1.2, 5, 4),
    radius: { label: "Radius", min: 0.1, max: 1, step: 0.05, start: 0.5 },
    turn: { label: "Turned by", min: -180, max: 180, step: 5, start: 0, unit: "°" },
    place: place("Place x", -1, 5, 0),
  },
  onlyNumbers: ["sampled_light"],
  ask: ({ kind, x, y, radius, turn, place }) => [kind, x, y, radius, turn, place],
  views: [
    {
      label: "From the side: the floor, the lit place on it, the lamp, and rays to samples of it",
      box: [-1.6, -0.5, 6, 5.6],
      handles: [
        handle("Lamp", "x", "y"),
        {
          label: "Lit place",
          moves: ["place"],
          place: ({ place }) => [place, 0],
          drag: ([x]) => ({ place: x }),
        },
      ],
      draw: (view, { kind, x, y, radius, place }, { normal, side, points }) => {
        view.segment([-1.6, 0], [6, 0], "edge");
        if (KINDS[kind] === "sphere") {
          view.circle([x, y], radius, "edge");
        } else {
          const [left, right] = KINDS[kind] === "disk" ? [-1, 1] : [-0.5, 1];
          view.segment(along([x, y], side, left * radius), along([x, y], side, right * radius), "edge");
          view.arrow([x, y], along([x, y], normal, 0.7), "axis");
        }
        for (const [sampleX, sampleY, , , isSeen] of points.slice(0, 12)) {
          view.segment([place, 0], [sampleX, sampleY], isSeen ? "faint" : "miss");
        }
        view.dots(points, "ray", 1.5);
      },
    },
    {
      label: "The lamp itself, face-on, a sphere as it is seen from the lit place, and the samples on it",
      box: [-1.7, -1.1, 1.7, 1.1],
      handles: [],
      draw: (view, { kind }, { points }) => {
        if (KINDS[kind] === "triangle") {
          view.line(CORNERS, "edge");
        }
        view.circle([0, 0], 1, KINDS[kind] === "triangle" ? "faint" : "edge");
        ["point", "ray"].forEach((look, isLit) => {
          const some = points.filter((one) => one[4] === isLit);
          view.dots(
            some.map(([, , seenX, seenY]) => [seenX, seenY]),
            look,
            2.5,
          );
        });
      },
    },
  ],
  says: ({ kind }, { pdf, light, mean, points }) => {
    const unseen = points.filter((one) => !one[4]).length;
    return (
      `${KINDS[kind] === "sphere" ? "Each point that is seen" : "The lamp's middle"} has the density ${said(pdf)} by ` +
      `solid angle; a sample of the middle brings ${said(light)}. The mean of 100 samples is ${said(mean)}` +
      `${unseen ? `, with ${unseen} that bring nothing, as they are seen from behind` : ""}. ` +
      `${spreadInWords(kind, points)}.`
    );
  },
};

const depth = (label, start) => ({ label, min: 1, max: 8, step: 0.1, stride: 0.5, start });

export const LENS = {
  name: "lens",
  title: "Your rays through a lens",
  intro:
    "The camera of the worked example looks upwards here, with 24 of your rays, all for the same pixel. Drag the point " +
    "that is sharp, or use the arrow keys, and the wall that the rays meet.",
  numbers: {
    x: place("Sharp point x", -4, 4, 3),
    focal: depth("Focal distance", 4),
    radius: { label: "Radius of the lens", min: 0, max: 1, step: 0.05, start: 0.4 },
    wall: depth("Wall at", 7),
  },
  ask: ({ x, focal, radius, wall }) => [x, focal, radius, wall],
  views: [
    {
      label: "From above: the lens below, the plane of focus dashed, the wall, and rays from the lens to the wall",
      box: [-5.4, -0.6, 8, 8.4],
      handles: [
        handle("Sharp point", "x", "focal"),
        { label: "Wall", moves: ["wall"], place: ({ wall }) => [-4.8, wall], drag: ([, y]) => ({ wall: y }) },
      ],
      draw: (view, { focal, radius, wall }, { rays }) => {
        view.segment([-radius, 0], [radius, 0], "edge");
        view.segment([-5.4, focal], [8, focal], "miss");
        view.segment([-5.4, wall], [8, wall], "edge");
        for (const [fromX, fromDepth, toX] of rays) {
          view.segment([fromX, fromDepth], [toX, wall], "faint");
        }
        view.words([0.6, -0.4], "lens");
        view.words([-4.4, wall + 0.15], "wall");
      },
    },
    {
      label: "The wall, face-on: where the rays meet it; the circle is as large as the lens",
      box: [-1.7, -1.1, 1.7, 1.1],
      handles: [],
      draw: (view, { radius }, { rays, middle }) => {
        view.circle([0, 0], radius, "faint");
        view.dots(
          rays.map(([, , x, y]) => [x - middle[0], y - middle[1]]),
          "ray",
          3,
        );
      },
    },
  ],
  says: ({ x, focal, wall }, { direction, miss, spread, middle }) =>
    `The ray through the middle has the direction ${list(direction)}. In the plane of focus ${
      miss < 0.001 ? "all rays meet at" : `rays miss by up to ${said(miss)}`
    } ${list([x, 0, -focal])}. ` +
    `On the wall, ${said(wall)} away, they are up to ${said(spread)} from ${list(middle)}: ` +
    `${spread < 0.005 ? "sharp" : "blurred"}.`,
};
