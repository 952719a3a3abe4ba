import { along, flat, handle, list, place, said } from "./drawing-words.js";

// Step 02. From above: x to the right, z up, in the plane in which the ray runs.

/** A ray from a handle to another. */
function rayFigure({ name, title, intro, box, plane, start, aim, outline }) {
  const [left, near, right, far] = box;
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

export const SPHERE = rayFigure({
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

export const TRIANGLE = rayFigure({
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
