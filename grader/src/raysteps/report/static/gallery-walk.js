"use strict";

/** Where the visitor is: a scene, and the steps to the left and to the right. Nothing of it is on the page. */
class GalleryWalk {
  /** @param {{steps: object[], scenes: object[]}} data */
  constructor(data) {
    this.steps = data.steps.length;
    this.scenes = data.scenes.length;
    this.scene = 0;
    this.mode = "steps";
    this.begin();
  }

  /** Before the walk: the first step beside the last one that adds something to see. */
  begin() {
    this.left = 0;
    this.right = Math.min(7, this.steps - 1);
    this.overview = true;
  }

  /** @param {number} by 1 forward, -1 back; both sides move */
  move(by) {
    if (this.overview && by > 0) {
      this.go(Math.min(1, this.steps - 1));
    } else if (!this.overview && by < 0 && Math.min(this.left, this.right) === 0) {
      this.begin();
    } else if (!this.overview && Math.max(this.left, this.right) + by < this.steps) {
      this.left += by;
      this.right += by;
    }
  }

  get canMoveOn() {
    return this.overview || Math.max(this.left, this.right) + 1 < this.steps;
  }

  get canMoveBack() {
    return !this.overview;
  }

  /** Shows what a step has added: it beside the one before. */
  go(step) {
    this.overview = false;
    this.right = step;
    this.left = Math.max(0, step - 1);
  }

  /** @param {"left" | "right"} side */
  pick(side, step) {
    this.overview = false;
    this[side] = step;
  }

  /** What an address says, such as #2/3/8: scene and steps, counted from 1. */
  read(hash) {
    const found = /^#(\d{1,3})\/(\d{1,2})\/(\d{1,2})$/.exec(hash);
    const [scene, left, right] = found ? found.slice(1).map((word) => Number(word) - 1) : [-1, -1, -1];
    const within = (value, end) => value >= 0 && value < end;
    if (within(scene, this.scenes) && within(left, this.steps) && within(right, this.steps)) {
      Object.assign(this, { scene, left, right, overview: false });
    }
  }

  write() {
    return this.overview && this.scene === 0 ? "" : `#${this.scene + 1}/${this.left + 1}/${this.right + 1}`;
  }
}
