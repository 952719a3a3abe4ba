"use strict";

/** Which pixels of a comparison are pointed at: under the mouse, under the cursor of the keys, and the one that is kept. */
class CompareMarks {
  #ui;
  #names;
  #inspect;
  #hover = null;
  /** @type {{x: number, y: number} | null} */
  cursor = null;
  /** @type {{x: number, y: number} | null} */
  kept = null;
  /** @type {{x: number, y: number} | null} the one to inspect until one is kept */
  #offered = null;
  /** @type {(place: {x: number, y: number}) => void} */
  onPixel = () => {};
  /** @type {(place: {x: number, y: number}) => void} of the pixel to inspect */
  onChoice = () => {};

  /**
   * @param {Record<string, any>} ui of `makeControls`
   * @param {{reference: string, mine: string}} names
   * @param {string | null} inspect the command that inspects a pixel, with {x} and {y}
   */
  constructor(ui, names, inspect) {
    this.#ui = ui;
    this.#names = names;
    this.#inspect = inspect;
  }

  /** The worst pixel is worth a look; where none is wrong, the one in the middle. */
  offer(pair) {
    this.#offered = pair.worst ?? { x: pair.width >> 1, y: pair.height >> 1 };
    this.#tellChoice();
  }

  /** The pixel under the pointer; without one the readout goes back to the cursor, or to the pixel that is kept. */
  point(pair, pixel) {
    if (pixel?.x !== this.#hover?.x || pixel?.y !== this.#hover?.y) {
      this.#hover = pixel;
      this.#tell(pair, pixel ?? this.cursor ?? this.kept);
    }
  }

  /** Moves the cursor, from the middle of the picture at first. */
  step(pair, right, down) {
    const from = this.cursor ?? this.kept ?? { x: pair.width >> 1, y: pair.height >> 1 };
    const within = (value, most) => Math.min(most - 1, Math.max(0, value));
    this.cursor = { x: within(from.x + right, pair.width), y: within(from.y + down, pair.height) };
    this.#tell(pair, this.cursor);
    this.#say(pair, this.cursor);
  }

  /** Keeps a pixel, which is the one to inspect then. */
  keep(pair, pixel) {
    this.kept = pixel;
    this.cursor = null;
    this.#tell(pair, pixel);
    this.#say(pair, pixel);
    this.#tellChoice();
  }

  #tell(pair, pixel) {
    tellPixel(this.#ui.cells, pair, pixel);
    if (pixel) {
      this.onPixel(pixel);
    }
  }

  #say(pair, pixel) {
    this.#ui.say.textContent = pixelInWords(pair, this.#names, pixel);
  }

  #tellChoice() {
    const { x, y } = this.kept ?? this.#offered;
    this.onChoice({ x, y });
    if (this.#inspect) {
      this.#ui.command.textContent = this.#inspect.replace("{x}", x).replace("{y}", y);
      this.#ui.inspect.hidden = false;
    }
  }
}
