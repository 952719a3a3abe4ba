import { DEGREE, handle, said } from "./drawing-words.js";

// Step 15. The plate from the side: x to the right, z up.

const GREATEST = 6;
const density = (label, start) => ({ label, min: 0, max: GREATEST, step: 0.05, stride: 0.25, start });
const across = (label, name) => ({
  label,
  moves: [name],
  place: (values) => [values[name], 0],
  drag: ([x]) => ({ [name]: x }),
});

export const WEIGHTS = {
  name: "weights",
  title: "Your weights",
  intro:
    "The two densities of the worked example, with what your balance_heuristic and power_heuristic say. Drag both, or " +
    "use the arrow keys. The curves show the weight for each density of the sample itself.",
  numbers: { pdf: density("Its own density", 3), other: density("Density by the other way", 1) },
  ask: ({ pdf, other }) => [pdf, other, GREATEST],
  views: [
    {
      label: "The sample's own density to the right, its weight upwards: by the power heuristic, by balance dashed",
      box: [-0.15, -0.2, GREATEST + 0.2, 1.1],
      stretch: 140,
      handles: [across("Its own density", "pdf"), across("Density by the other way", "other")],
      draw: (view, { pdf, other }, { curves, balance, power }) => {
        for (const height of [0, 1]) {
          view.segment([0, height], [GREATEST, height], "faint");
        }
        ["miss", "ray"].forEach((look, which) => {
          view.line(
            curves.map((one, at) => [(GREATEST * at) / (curves.length - 1), one[which]]),
            look,
          );
        });
        view.segment([other, 0], [other, 0.5], "faint");
        for (const weight of [balance, power]) {
          view.dot([pdf, weight], "hit", 4);
        }
        view.words([pdf - 0.2, -0.15], "own");
        view.words([other - 0.25, -0.15], Math.abs(pdf - other) < 0.8 ? "" : "other");
      },
    },
  ],
  says: ({ pdf, other }, { balance, power }) =>
    `Found with the density ${said(pdf)}, by the other way with ${said(other)}: the weight is ${said(balance)} by the ` +
    `balance heuristic, ${said(power)} by the power heuristic.`,
};

const place = (label, min, max, start) => ({ label, min, max, step: 0.05, stride: 0.1, start });

export const WAYS = {
  name: "ways",
  title: "Your two ways to a lamp",
  intro:
    "A plate of rough metal and a lamp, the sphere of the worked example, with your densities and weights. Drag eye " +
    "and lamp, or use the arrow keys; polish the plate, and make the lamp smaller. The green line is the weight of " +
    "the lamp's samples.",
  numbers: {
    alpha: { label: "Roughness alpha", min: 0.05, max: 1, step: 0.05, start: 0.3 },
    radius: { label: "Radius of the lamp", min: 0.05, max: 0.6, step: 0.05, start: 0.6 },
    lampX: place("Lamp x", -1.4, 1.4, 0),
    lampZ: place("Lamp z", 0.7, 1.6, 1),
    eyeX: place("Eye x", -1.4, 1.4, -1.2),
    eyeZ: place("Eye z", 0.1, 1.6, 1.2),
  },
  onlyNumbers: ["emission_weight"],
  ask: ({ alpha, radius, lampX, lampZ, eyeX, eyeZ }) => [alpha, eyeX, eyeZ, lampX, lampZ, radius],
  views: [
    {
      label: "From the side: the plate, the eye, the lamp, and how likely the plate sends a path into each direction",
      box: [-1.7, -0.15, 1.7, 2.1],
      handles: [handle("Eye", "eyeX", "eyeZ"), handle("Lamp", "lampX", "lampZ")],
      draw: (view, { eyeX, eyeZ, lampX, lampZ, radius }, { lobe }) => {
        view.segment([-1.7, 0], [1.7, 0], "edge");
        view.segment([0, 0], [eyeX, eyeZ], "ray");
        view.circle([lampX, lampZ], radius, "edge");
        const longest = Math.max(...lobe.map(([, byPath]) => byPath));
        view.line(
          lobe.map(([, byPath], degree) => {
            const angle = (degree - 90) * DEGREE;
            return [(byPath / longest) * Math.sin(angle), (byPath / longest) * Math.cos(angle)];
          }),
          "channel live-blue",
        );
        view.words([eyeX + 0.08, eyeZ + 0.08], "eye");
        view.words([lampX + 0.1, lampZ - 0.05], "lamp");
      },
    },
    {
      label:
        "The direction to the right, from -90 to 90 degrees; upwards both densities, and the weight of a lamp's sample",
      box: [-92, -0.2, 92, 1.1],
      stretch: 120,
      handles: [],
      draw: (view, _, { lobe }) => {
        const peaks = [0, 1].map((which) => Math.max(...lobe.map((one) => one[which])));
        const greatest = Math.max(...peaks);
        const curve = (which, scale) => lobe.map((one, at) => [at - 90, one[which] / scale]);
        view.segment([-90, 0], [90, 0], "faint");
        view.line(curve(0, greatest), "edge");
        view.line(curve(1, greatest), "channel live-blue");
        view.line(
          curve(2, 1).filter((_, at) => lobe[at][0] > 0),
          "axis",
        );
        ["lamp", "path"].forEach((way, which) => {
          const peak = lobe.findIndex((one) => one[which] === peaks[which]);
          view.words([Math.min(peak - 90, 66), peaks[which] / greatest + 0.03], way);
        });
        view.words([-90, -0.14], "-90°");
        view.words([76, -0.14], "90°");
      },
    },
  ],
  says: (_, { lampPdf, scatterPdf, sampleWeight, pathWeight }) =>
    `A sample of the lamp has the density ${said(lampPdf)}. Towards its middle a path goes on with ` +
    `${said(scatterPdf)}. There a sample of the lamp counts ${said(sampleWeight)}, and a path that meets it ` +
    `${said(pathWeight)}.`,
};
