"use strict";

/**
 * @typedef {{id: string, role: string, origin: Vec3, end: Vec3, hit: number | null,
 *   boxes: {min: Vec3, max: Vec3, entered: boolean, level: number | null}[],
 *   tests: {surface: number, hit: boolean, before: number}[]}} InsideRay
 * @typedef {{camera: object, goal: Vec3, lights: Vec3[], size: number, surfaces: object[], rays: InsideRay[]}} InsideSpace
 */

const RAY_COLORS = {
  eye: [1, 1, 1],
  reflect: [0.35, 0.8, 1],
  refract: [0.45, 0.95, 0.55],
  lit: [1, 0.85, 0.3],
  blocked: [1, 0.42, 0.36],
};
const BOX_NOW = [1, 0.62, 0.2];
const BOX_ENTERED = [0.72, 0.74, 0.8];
const BOX_MISSED = [0.75, 0.4, 0.4];

/** One pixel's scene, rays and boxes in three dimensions. */
class InsideView {
  /** @param {HTMLCanvasElement} canvas @param {InsideSpace} space */
  constructor(canvas, space) {
    this.canvas = canvas;
    this.space = space;
    this.painter = new SpacePainter(canvas);
    this.solid = false;
    this.show(space.rays[0], space.rays[0].boxes.length);
    this.surfaces = [];
    for (const surface of space.surfaces) {
      const mesh = meshOf(surface);
      const around =
        surface.radii.length === 1 && Math.hypot(...sub3(surface.points[0], space.camera.from)) < surface.radii[0];
      if (mesh)
        this.surfaces.push({
          number: surface.surface,
          color: surface.color,
          kept: this.painter.keepMesh(mesh, around),
        });
    }
    this.rays = space.rays.map((ray) => ({ ray, kept: this.painter.keepLines([[ray.origin, ray.end]]) }));
    this.lamps = space.lights.map((at) => this.painter.keepMesh(sphereMesh(at, 0.02 * space.size, 10)));
    this.eye = this.painter.keepLines(this.pyramid());
    this.orbit = new Orbit(canvas, space.camera, () => this.later());
    this.fromTheSide();
    new ResizeObserver(() => this.later()).observe(canvas);
  }

  /** Gives the stage back, of which a page has a few only. */
  end() {
    this.painter.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  /** The edges from the eye to the corners of the picture, drawn near the eye. @returns {[Vec3, Vec3][]} */
  pyramid() {
    const { from, corners } = this.space.camera;
    const ends = corners.map((corner) => addScaled3(from, corner, 0.18 * this.space.size));
    return ends.flatMap((end, i) => [
      [from, end],
      [end, ends[(i + 1) % 4]],
    ]);
  }

  /** @param {InsideRay} ray @param {number} boxes how many of its boxes, in their order */
  show(ray, boxes) {
    this.ray = ray;
    for (const { kept } of this.boxes ?? []) this.painter.drop(kept);
    this.boxes = ray.boxes
      .slice(0, boxes)
      .map((box) => ({ ...box, kept: this.painter.keepLines(boxEdges(box.min, box.max)) }));
    const tested = ray.tests.filter((test) => boxes >= ray.boxes.length || test.before <= boxes);
    this.tested = new Map(tested.map((test) => [test.surface, test.hit]));
    this.later();
  }

  fromTheEye() {
    this.orbit.goHome();
  }

  fromTheSide() {
    this.orbit.goHome();
    this.orbit.lookAt(this.space.goal, 1.15 * this.space.size);
    this.orbit.turn(0.9, 0.28);
  }

  /** Once per frame, however much has changed. */
  later() {
    if (!this.waiting)
      this.waiting = requestAnimationFrame(() => {
        this.waiting = 0;
        this.paint();
      });
  }

  paint() {
    const { canvas, space, orbit } = this;
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
    const aspect = canvas.width / canvas.height;
    const half = space.camera.halfHeight * Math.max(1, space.camera.aspect / aspect);
    const toEye = unit3(sub3(orbit.from, orbit.at));
    const lens = perspective4(half, aspect, 0.005 * space.size, 200 * space.size);
    this.painter.begin(times4(lens, lookAt4(orbit.from, orbit.at, space.camera.up)), toEye);
    this.paintSurfaces();
    this.paintLines(scale);
  }

  paintSurfaces() {
    const opaque = ({ number }) => this.solid || this.tested.get(number) || this.ray.hit === number;
    for (const lamp of this.lamps) this.painter.draw(lamp, [1, 0.92, 0.6, 1]);
    for (const surface of this.surfaces.filter(opaque)) this.painter.draw(surface.kept, [...this.shown(surface), 1]);
    for (const surface of this.surfaces.filter((one) => !opaque(one))) {
      this.painter.draw(surface.kept, [...this.shown(surface), this.tested.has(surface.number) ? 0.34 : 0.12]);
    }
  }

  /** @returns {number[]} its colour, where it can be told from the stage */
  shown({ color }) {
    const most = Math.max(...color, 1);
    return color.map((part) => 0.12 + (0.88 * part) / most);
  }

  paintLines(scale) {
    const last = this.boxes.length - 1;
    const lines = (alpha) => {
      this.painter.draw(this.eye, [0.8, 0.8, 0.85, 0.8 * alpha], 1.2 * scale);
      this.boxes.forEach((box, i) => {
        const color = i === last ? BOX_NOW : box.entered ? BOX_ENTERED : BOX_MISSED;
        if (box.entered || i === last)
          this.painter.draw(box.kept, [...color, (i === last ? 1 : 0.5) * alpha], (i === last ? 2.6 : 1.1) * scale);
      });
      for (const { ray, kept } of this.rays) {
        const chosen = ray === this.ray;
        this.painter.draw(
          kept,
          [...(RAY_COLORS[ray.role] ?? RAY_COLORS.eye), (chosen ? 1 : 0.6) * alpha],
          (chosen ? 4 : 1.6) * scale,
        );
      }
    };
    this.painter.through(() => lines(0.35));
    lines(1);
  }
}
