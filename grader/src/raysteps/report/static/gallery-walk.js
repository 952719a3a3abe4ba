"use strict";

/** Where the visitor is: a scene, and the steps to the left and to the right. Nothing of it is on the page. */
class GalleryWalk {
  /** @param {{steps: object[], scenes: {reference: ({picture: number | null} | null)[]}[]}} data */
  constructor(data) {
    this.steps = data.steps.length;
    this.pictures = data.scenes.map(({ reference }) => reference);
    this.scenes = data.scenes.length;
    this.scene = 0;
    this.mode = "steps";
    this.begin();
  }

  /** Whether the scene has a picture after that step, or a word why there is none. */
  shows(step, scene = this.scene) {
    return (this.pictures[scene][step] ?? null) !== null;
  }

  get shown() {
    return [...Array(this.steps).keys()].filter((step) => this.shows(step));
  }

  /** Before the walk: the first step of the scene beside the last one that adds something to see. */
  begin() {
    const { shown } = this;
    const picture = (step) => this.pictures[this.scene][step].picture;
    const adding = shown.filter((step, at) => at > 0 && picture(step) !== picture(shown[at - 1]));
    this.left = shown[0];
    this.right = adding.at(-1) ?? shown[0];
    this.overview = true;
  }

  /** Another scene, at the same steps where it shows them. */
  enter(scene) {
    this.scene = scene;
    if (this.overview || !this.shows(this.left) || !this.shows(this.right)) {
      this.begin();
    }
  }

  /** @param {number} by 1 forward, -1 back; both sides move, into another scene where this one ends */
  move(by) {
    const { shown } = this;
    const to = this.beside(by);
    if (this.overview && by > 0 && shown.length > 1) {
      this.go(shown[1]);
    } else if (!this.overview && by < 0 && !this.shows(Math.min(this.left, this.right) - 1)) {
      this.begin();
    } else if (to !== null && this.left !== this.right && this.shows(this.left + by) && this.shows(this.right + by)) {
      this.left += by;
      this.right += by;
    } else if (to !== null) {
      this.go(to);
    }
  }

  /** The step to move on to, if some scene shows it. */
  beside(by) {
    const to = Math.max(this.left, this.right) + by;
    return !this.overview && this.pictures.some((_, scene) => this.shows(to, scene)) ? to : null;
  }

  get canMoveOn() {
    return this.overview ? this.shown.length > 1 : this.beside(1) !== null;
  }

  get canMoveBack() {
    return !this.overview;
  }

  /** Shows what a step has added: it beside the one before, in this scene or in the first that shows it. */
  go(step) {
    if (!this.shows(step)) {
      this.scene = this.pictures.findIndex((_, scene) => this.shows(step, scene));
    }
    this.overview = false;
    this.right = step;
    this.left = this.shows(step - 1) ? step - 1 : step;
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
    if (within(scene, this.scenes) && this.shows(left, scene) && this.shows(right, scene)) {
      Object.assign(this, { scene, left, right, overview: false });
    }
  }

  write() {
    return this.overview && this.scene === 0 ? "" : `#${this.scene + 1}/${this.left + 1}/${this.right + 1}`;
  }
}
