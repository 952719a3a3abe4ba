"use strict";

/** @typedef {[number, number, number]} Vec3 */
/** @typedef {Float32Array} Mat4 column by column, as WebGL takes it */

/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
function sub3(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/** a + s b @param {Vec3} a @param {Vec3} b @param {number} s @returns {Vec3} */
function addScaled3(a, b, s) {
  return [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
}

/** @param {Vec3} a @param {Vec3} b @returns {number} */
function dot3(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
function cross3(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {Vec3} a @returns {Vec3} of unit length; the zero vector stays */
function unit3(a) {
  const length = Math.hypot(...a) || 1;
  return [a[0] / length, a[1] / length, a[2] / length];
}

/** Some unit vector at right angles to a. @param {Vec3} a @returns {Vec3} */
function across3(a) {
  return unit3(cross3(a, Math.abs(a[1]) < 0.9 * Math.hypot(...a) ? [0, 1, 0] : [1, 0, 0]));
}

/** The matrix a b. @param {Mat4} a @param {Mat4} b @returns {Mat4} */
function times4(a, b) {
  const product = new Float32Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      for (let k = 0; k < 4; ++k) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return product;
}

/**
 * From world to eye coordinates: x to the right, y up, looking along -z.
 * @param {Vec3} from @param {Vec3} at @param {Vec3} up @returns {Mat4}
 */
function lookAt4(from, at, up) {
  const back = unit3(sub3(from, at));
  const right = unit3(cross3(up, back));
  const top = cross3(back, right);
  return new Float32Array([
    right[0],
    top[0],
    back[0],
    0,
    right[1],
    top[1],
    back[1],
    0,
    right[2],
    top[2],
    back[2],
    0,
    -dot3(right, from),
    -dot3(top, from),
    -dot3(back, from),
    1,
  ]);
}

/**
 * @param {number} halfHeight of the picture at distance 1 @param {number} aspect width to height
 * @param {number} near @param {number} far distances @returns {Mat4}
 */
function perspective4(halfHeight, aspect, near, far) {
  const matrix = new Float32Array(16);
  matrix[0] = 1 / (halfHeight * aspect);
  matrix[5] = 1 / halfHeight;
  matrix[10] = (far + near) / (near - far);
  matrix[11] = -1;
  matrix[14] = (2 * far * near) / (near - far);
  return matrix;
}
