"use strict";

/** A camera that goes round a point: by dragging, wheel, pinch and keys. */
class Orbit {
  /**
   * @param {HTMLElement} stage what is dragged
   * @param {{from: Vec3, at: Vec3, up: Vec3}} home
   * @param {() => void} changed
   */
  constructor(stage, home, changed) {
    this.home = home;
    this.changed = changed;
    this.fingers = new Map();
    this.goHome();
    stage.addEventListener("pointerdown", (event) => this.press(event, stage));
    stage.addEventListener("pointermove", (event) => this.move(event));
    stage.addEventListener("pointerup", (event) => this.fingers.delete(event.pointerId));
    stage.addEventListener("pointercancel", (event) => this.giveUp(event));
    stage.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(event.deltaY * 0.0012));
      },
      { passive: false },
    );
    stage.addEventListener("keydown", (event) => this.key(event));
  }

  goHome() {
    this.from = [...this.home.from];
    this.at = [...this.home.at];
    this.changed();
  }

  /** Goes on round another point, as far away as before. @param {Vec3} point @param {number} distance */
  lookAt(point, distance) {
    this.from = addScaled3(point, unit3(sub3(this.from, this.at)), distance);
    this.at = [...point];
    this.changed();
  }

  /** @param {number} sideways @param {number} upwards angles in radians */
  turn(sideways, upwards) {
    const up = unit3(this.home.up);
    const arm = sub3(this.from, this.at);
    const right = unit3(cross3(up, arm));
    const level = Math.acos(Math.max(-1, Math.min(1, dot3(up, unit3(arm)))));
    const tilt = Math.max(0.05, Math.min(Math.PI - 0.05, level - upwards)) - level;
    this.from = addScaled3(this.at, Orbit.round(Orbit.round(arm, right, tilt), up, -sideways), 1);
    this.changed();
  }

  /** Rodrigues' rotation. @param {Vec3} v @param {Vec3} axis @param {number} angle @returns {Vec3} */
  static round(v, axis, angle) {
    const [c, s, across, along] = [Math.cos(angle), Math.sin(angle), cross3(axis, v), dot3(axis, v)];
    return [0, 1, 2].map((i) => v[i] * c + across[i] * s + axis[i] * along * (1 - c));
  }

  /** @param {number} factor of the distance */
  zoom(factor) {
    this.from = addScaled3(this.at, sub3(this.from, this.at), factor);
    this.changed();
  }

  press(event, stage) {
    stage.setPointerCapture(event.pointerId);
    if (!this.fingers.size) this.pressed = { from: this.from, at: this.at };
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  move(event) {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const spread = () => {
      const [a, b] = [...this.fingers.values()];
      return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
    };
    const old = spread();
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    if (old > 0 && spread() > 0) this.zoom(old / spread());
    else this.turn((event.clientX - before[0]) * 0.008, (event.clientY - before[1]) * 0.008);
  }

  /** The finger scrolls the page: whatever it had turned until that was clear goes back. */
  giveUp(event) {
    if (!this.fingers.delete(event.pointerId)) return;
    Object.assign(this, this.pressed);
    this.changed();
  }

  key(event) {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    const zooms = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 };
    if (event.key in turns) this.turn(...turns[event.key]);
    else if (event.key in zooms) this.zoom(zooms[event.key]);
    else if (event.key === "0") this.goHome();
    else return;
    event.preventDefault();
  }
}
