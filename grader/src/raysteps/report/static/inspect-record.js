"use strict";

/** A ray that meets nothing is drawn as long as so many sizes of the view. */
const insideFar = 3;

/** @param {number | string} value of a record: one that is not finite is a word @returns {number} */
const insideNumber = (value) => ({ inf: Infinity, "-inf": -Infinity, nan: NaN })[value] ?? value;

/** @param {(number | string)[]} vector @returns {boolean} */
const insideIsFinite = (vector) => vector.every((value) => Number.isFinite(insideNumber(value)));

/** @param {(number | string)[]} vector @returns {number[]} with 0 in place of what cannot be drawn */
const insidePlain = (vector) => vector.map(insideNumber).map((value) => (Number.isFinite(value) ? value : 0));

/**
 * The ray and all that come of it, in the order in which they are written: first its shadow rays.
 * @param {object} ray of a record
 * @param {string} id begins those of the others, and is that of its entry in the tree
 * @returns {{id: string, role: string, ray: object}[]}
 */
function insideRays(ray, id = "eye") {
  const way = (one) => (one.role === "internal" ? "refract" : one.role); // glass does so where it would refract
  const shadowsOf = ({ lit, rays }, name) =>
    rays.map((shadow, again) => ({
      id: `${id}-${name}${again ? `-ray${again + 1}` : ""}`,
      role: lit ? "lit" : "blocked",
      ray: shadow,
    }));
  const lamps = ray.lamps ?? []; // of area lights
  const shadows = [
    ...ray.lights.flatMap((one) => shadowsOf(one, `light${one.light + 1}`)),
    ...lamps.flatMap((one, at) => shadowsOf(one, `lamp${at + 1}`)),
  ];
  const bounces = ray.bounces.flatMap((bounce) => insideRays(bounce, `${id}-${way(bounce)}`));
  return [{ id, role: way(ray), ray }, ...shadows, ...bounces];
}

/** @param {object} ray @param {number} size @returns {number[]} where it is drawn to */
function insideEnd(ray, size) {
  if (ray.hit && insideIsFinite(ray.hit.position)) return ray.hit.position;
  const far = insideFar * size;
  const long = ray.limit === null ? far : Math.min(insideNumber(ray.limit), 10 * far);
  return insidePlain(addScaled3(insidePlain(ray.origin), insidePlain(ray.direction), long));
}

function insideRay({ id, role, ray }, size) {
  const box = (one) => ({
    min: insidePlain(one.min),
    max: insidePlain(one.max),
    entered: one.enter !== null,
    level: one.level,
  });
  const test = (one) => ({ surface: one.surface, hit: one.distance !== null, before: one.boxes_before });
  return {
    id,
    role,
    origin: insidePlain(ray.origin),
    end: insideEnd(ray, size),
    hit: ray.hit?.surface ?? null,
    boxes: ray.boxes.map(box),
    tests: ray.tests.map(test),
  };
}

function insideCamera({ camera, frame }) {
  const [forward, right, up] = [frame.forward, frame.right, frame.up].map(insidePlain);
  const corner = (across, along) =>
    insidePlain(
      addScaled3(
        addScaled3(forward, right, across * insideNumber(frame.half_width)),
        up,
        along * insideNumber(frame.half_height),
      ),
    );
  return {
    from: insidePlain(camera.from),
    at: insidePlain(camera.at),
    up: insidePlain(camera.up),
    halfHeight: Math.tan((insideNumber(camera.angle) * Math.PI) / 360),
    aspect: camera.width / camera.height,
    corners: [corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)],
  };
}

/**
 * What the pixel shows; a sky far behind the scene is no good place to look at. How far the scene is says `at`, but not
 * that of a scene of pbrt: there it is one unit away.
 */
function insideGoal({ scene, camera, ray }) {
  const [from, at] = [camera.from, camera.at].map(insidePlain);
  const away = Math.hypot(...sub3(at, from));
  const far = scene.endsWith(".pbrt") ? Infinity : insideFar * away;
  const isNear = ray.hit && insideIsFinite(ray.hit.position) && Math.hypot(...sub3(ray.hit.position, from)) <= far;
  return isNear ? ray.hit.position : at;
}

/**
 * Camera, lights, surfaces near the rays, and the rays; `size` is how far the eye is from the goal.
 * @param {object} record of the form raysteps/inspect/v1
 * @returns {InsideSpace}
 */
function spaceOf(record) {
  const goal = insideGoal(record);
  const size = Math.max(Math.hypot(...sub3(goal, insidePlain(record.camera.from))), 1e-3);
  return {
    camera: insideCamera(record),
    goal,
    size,
    lights: record.lights.map((light) => insidePlain(light.position)),
    surfaces: record.near.map((near) => ({
      surface: near.surface,
      points: near.points.map(insidePlain),
      radii: insidePlain(near.radii),
      color: insidePlain(near.color),
    })),
    rays: insideRays(record.ray).map((ray) => insideRay(ray, size)),
  };
}
