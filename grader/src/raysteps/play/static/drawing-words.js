// What the drawings of all steps share: numbers in words, points, and handles.

/** Numbers as the handouts write them: four digits behind the point, no zeros at the end. */
export function said(number) {
  return typeof number === "number" ? String(Number(number.toFixed(4)) + 0) : String(number);
}

export const list = (vector) => `(${vector.map(said).join(", ")})`;
export const along = (from, direction, distance) => from.map((one, axis) => one + distance * direction[axis]);
export const DEGREE = Math.PI / 180;

/** From above or from the side: x to the right, z up. */
export const flat = ([x, , z]) => [x, z];

/** A point that is moved along both axes of a view: two numbers of the figure. */
export const handle = (label, x, z) => ({
  label,
  moves: [x, z],
  place: (values) => [values[x], values[z]],
  drag: ([toX, toZ]) => ({ [x]: toX, [z]: toZ }),
});

/** A number that a handle moves: by a step with the mouse, by a stride with an arrow key. */
export const place = (label, min, max, start) => ({ label, min, max, step: 0.1, stride: 0.5, start });
