"use strict";

/** Which part of a picture is seen, in shares of the picture, so that pictures and windows of any size can share it. */
class SharedView {
  /** @type {Map<string, SharedView>} */
  static #groups = new Map();

  constructor() {
    this.zoom = 1; // 1 shows the whole picture
    this.whole = false; // whether a pixel of a picture takes a whole number of the screen's, where it takes one
    this.x = 0.5;
    this.y = 0.5;
    /** @type {Set<() => void>} */
    this.watchers = new Set();
  }

  /**
   * @param {string | null} group
   * @returns {SharedView} the same one for all of a group; one of its own without a group
   */
  static of(group) {
    if (!group) {
      return new SharedView();
    }
    if (!SharedView.#groups.has(group)) {
      SharedView.#groups.set(group, new SharedView());
    }
    return SharedView.#groups.get(group);
  }

  /** Sets zoom and centre, and tells everybody who shares them. */
  set(zoom, x, y) {
    this.zoom = Math.max(1, zoom);
    this.x = this.zoom === 1 ? 0.5 : Math.min(1, Math.max(0, x));
    this.y = this.zoom === 1 ? 0.5 : Math.min(1, Math.max(0, y));
    for (const watcher of this.watchers) {
      watcher();
    }
  }
}

/** So large, in CSS pixels, one pixel of a picture may become. */
const comparePixelMost = 96;

/** @param {number} scale CSS pixels of the screen for one of a picture @returns {number} not larger; pixels stay alike */
function wholeScale(scale) {
  const pixels = Math.floor(scale * window.devicePixelRatio + 1e-6);
  return pixels < 1 ? scale : pixels / window.devicePixelRatio;
}

/** A part of the stage that shows a picture: turns places on the stage into pixels and back. Lengths are CSS pixels. */
class Pane {
  /**
   * @param {{left: number, top: number, width: number, height: number}} box
   * @param {{width: number, height: number}} picture
   * @param {SharedView} view
   */
  constructor(box, picture, view) {
    this.box = box;
    this.picture = picture;
    this.fit = Math.min(box.width / picture.width, box.height / picture.height);
    this.most = Math.max(1, comparePixelMost / this.fit);
    this.whole = view.whole;
    this.wanted = Math.min(view.zoom, this.most);
    this.zoom = this.#shown(this.wanted);
    this.scale = this.fit * this.zoom;
    this.x = Pane.#centre(view.x, box.width / (this.scale * picture.width));
    this.y = Pane.#centre(view.y, box.height / (this.scale * picture.height));
    this.left = box.left + box.width / 2 - this.x * picture.width * this.scale;
    this.top = box.top + box.height / 2 - this.y * picture.height * this.scale;
  }

  /** A picture that fills its box leaves no gap at its border. */
  static #centre(wanted, seen) {
    return seen >= 1 ? 0.5 : Math.min(1 - seen / 2, Math.max(seen / 2, wanted));
  }

  /** The zoom that is shown where this one is wanted. */
  #shown(zoom) {
    return this.whole ? wholeScale(this.fit * zoom) / this.fit : zoom;
  }

  contains(left, top) {
    const { box } = this;
    return left >= box.left && top >= box.top && left < box.left + box.width && top < box.top + box.height;
  }

  /** @returns {{x: number, y: number} | null} the pixel at a place on the stage */
  pixelAt(left, top) {
    const x = Math.floor((left - this.left) / this.scale);
    const y = Math.floor((top - this.top) / this.scale);
    const inside = x >= 0 && y >= 0 && x < this.picture.width && y < this.picture.height;
    return inside && this.contains(left, top) ? { x, y } : null;
  }

  /** Whether a pixel is within the box. */
  shows({ x, y }) {
    return this.contains(this.left + (x + 0.5) * this.scale, this.top + (y + 0.5) * this.scale);
  }

  /** The view after zooming by a factor while the place under the pointer stays. */
  zoomed(view, factor, left, top) {
    const zoom = Math.min(this.most, Math.max(1, this.wanted * factor));
    const [wide, high] = [this.picture.width * this.fit, this.picture.height * this.fit];
    const [dx, dy] = [left - this.box.left - this.box.width / 2, top - this.box.top - this.box.height / 2];
    const keep = 1 / this.zoom - 1 / this.#shown(zoom);
    view.set(zoom, this.x + (dx / wide) * keep, this.y + (dy / high) * keep);
  }

  /** The view after zooming towards its middle, which may be a pixel so near to the border that it cannot be there yet. */
  zoomedAtCentre(view, factor) {
    view.set(Math.min(this.most, this.wanted * factor), view.x, view.y);
  }

  /** The view after the picture was pulled by so much. */
  pulled(view, right, down) {
    const [wide, high] = [this.picture.width * this.scale, this.picture.height * this.scale];
    view.set(this.wanted, this.x - right / wide, this.y - down / high);
  }

  /** Centres a pixel, and zooms in as far as that its surroundings can be told apart. */
  centred(view, { x, y }) {
    const wanted = Math.max(this.wanted, Math.min(this.most, 16 / this.fit));
    view.set(wanted, (x + 0.5) / this.picture.width, (y + 0.5) / this.picture.height);
  }
}
