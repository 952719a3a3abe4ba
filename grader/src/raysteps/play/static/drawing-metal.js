import { flat, handle, list, said } from "./drawing-words.js";

// Step 14. From the side: x to the right, z up.

export const FRESNEL = {
  name: "fresnel",
  title: "Your mirrored share",
  intro:
    "How much of the light glass and metal mirror, by your fresnel_dielectric and fresnel_schlick. Drag the angle, or " +
    "use the arrow keys. From inside of the glass all light is mirrored beyond some angle.",
  numbers: {
    angle: { label: "Angle with the normal", min: 0, max: 90, step: 1, stride: 5, start: 0, unit: "°" },
    index: { label: "Index of refraction", min: 1, max: 2.5, step: 0.05, start: 1.5 },
    metal: { label: "Metal, straight on", min: 0, max: 1, step: 0.05, start: 0.6 },
  },
  ask: ({ angle, index, metal }) => [angle, index, metal],
  views: [
    {
      label: "The angle to the right, the mirrored share upwards: glass from outside and from inside, and metal",
      box: [-2, -0.15, 93, 1.1],
      stretch: 160,
      handles: [
        {
          label: "Angle",
          moves: ["angle"],
          place: ({ angle }) => [angle, 0],
          drag: ([x]) => ({ angle: x }),
        },
      ],
      draw: (view, { angle, metal }, { curves, shares }) => {
        for (const height of [0, 1]) {
          view.segment([0, height], [90, height], "faint");
        }
        ["ray", "miss", "channel live-blue"].forEach((look, which) => {
          view.line(
            curves.map((one, degree) => [degree, one[which]]),
            look,
          );
        });
        for (const share of shares) {
          view.dot([angle, share], "hit", 4);
        }
        view.words([2, metal + (metal > 0.85 ? -0.08 : 0.04)], "metal");
        view.words([4, -0.12], "glass, from inside dashed");
        view.words([86, -0.12], "90°");
      },
    },
  ],
  says: ({ angle }, { shares: [outside, inside, metal] }) =>
    `At ${angle}° glass mirrors ${said(outside)} of the light that comes from outside, and ${said(inside)} of that ` +
    `from inside${inside === 1 ? ": none gets out" : ""}. Metal mirrors ${said(metal)}.`,
};

const at = (label, min, max, start) => ({ label, min, max, step: 0.05, stride: 0.1, start });

const directionsOf = (normals) => normals.filter((one) => one.length > 2).map(([, , ...direction]) => direction);

export const METAL = {
  name: "metal",
  title: "Your rough metal",
  intro:
    "The metal of the worked example, with what your functions say of one eye and one light, and where 150 paths go " +
    "on. Drag both, or use the arrow keys: the less rough, the narrower. The blue line is the density of each " +
    "direction; dots are your samples.",
  numbers: {
    alpha: { label: "Roughness alpha", min: 0.05, max: 1, step: 0.05, start: 0.5 },
    eyeX: at("Eye x", -1, 1, 0.6),
    eyeZ: at("Eye z", 0.05, 1, 0.8),
    lightX: at("Light x", -1, 1, -0.6),
    lightZ: at("Light z", 0.05, 1, 0.8),
  },
  onlyNumbers: ["metal_brdf"],
  ask: ({ alpha, eyeX, eyeZ, lightX, lightZ }) => [alpha, eyeX, eyeZ, lightX, lightZ],
  views: [
    {
      label: "From the side: the surface, eye and light, the normal between them, and the density of each direction",
      box: [-1.2, -0.15, 1.2, 1.2],
      handles: [handle("Eye", "eyeX", "eyeZ"), handle("Light", "lightX", "lightZ")],
      draw: (view, { eyeX, eyeZ, lightX, lightZ }, { half, lobe, normals }) => {
        view.segment([-1.2, 0], [1.2, 0], "edge");
        view.segment([0, 0], [eyeX, eyeZ], "ray");
        view.segment([0, 0], [lightX, lightZ], "miss");
        view.arrow([0, 0], flat(half), "axis");
        const longest = Math.max(...lobe.map(([, , density]) => density));
        view.line(
          lobe.map(([x, z]) => [x / longest, z / longest]),
          "channel live-blue",
        );
        view.dots(directionsOf(normals).map(flat), "point", 1.5);
        view.words([eyeX + 0.06, eyeZ + 0.06], "eye");
        view.words([lightX - 0.2, lightZ + 0.07], "light");
      },
    },
    {
      label: "From above, within the circle of length 1: 150 visible normals, small, and where paths go on, filled",
      box: [-1.7, -1.1, 1.7, 1.1],
      handles: [],
      draw: (view, _, { normals }) => {
        view.circle([0, 0], 1, "edge");
        view.dots(normals, "point", 1.5);
        view.dots(directionsOf(normals), "ray", 2.5);
      },
    },
  ],
  says: (_, { half, distribution, lambda, brdf, normalPdf, pdf, normals }) => {
    const lost = normals.length - directionsOf(normals).length;
    return (
      `The normal between eye and light is ${list(half)}: D = ${said(distribution)}, its density ${said(normalPdf)}. ` +
      `Λ of the eye is ${said(lambda)}. f = ${said(brdf)}, and the density of the light's direction ${said(pdf)}. ` +
      `${lost === 0 ? "All" : normals.length - lost} of 150 paths go on${lost ? ", the others lead below" : ""}.`
    );
  },
};
