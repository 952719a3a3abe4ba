"use strict";

/** A channel may differ by so much, of 255, before a pixel is wrong; the grader's rule. */
const compareTolerance = 2;

/**
 * The pixels of a picture, and a canvas to draw them from.
 * @typedef {{width: number, height: number, data: Uint8ClampedArray, canvas: HTMLCanvasElement}} Raster
 */

/**
 * @param {number} width
 * @param {number} height
 * @param {(data: Uint8ClampedArray) => void} fill writes red, green, blue, alpha of each pixel
 * @returns {Raster}
 */
function makeRaster(width, height, fill) {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  fill(image.data);
  context.putImageData(image, 0, 0);
  return { width, height, data: image.data, canvas };
}

/**
 * @param {HTMLImageElement} image
 * @returns {Promise<Raster | null>} null where there is no picture
 */
async function readRaster(image) {
  try {
    await image.decode();
  } catch {
    return null;
  }
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  return { width: canvas.width, height: canvas.height, data, canvas };
}

/** Two pictures, and what can be said of their difference. */
class PicturePair {
  /**
   * @param {Raster | null} reference
   * @param {Raster | null} mine
   * @param {Raster | null} flip gray, from 0 the same to 255
   */
  constructor(reference, mine, flip) {
    this.reference = reference;
    this.mine = mine;
    this.comparable = Boolean(reference && mine && reference.width === mine.width && reference.height === mine.height);
    const fits = this.comparable && flip && flip.width === mine.width && flip.height === mine.height;
    this.flip = fits ? flip : null;
    this.width = Math.max(reference?.width ?? 0, mine?.width ?? 0);
    this.height = Math.max(reference?.height ?? 0, mine?.height ?? 0);
    this.wrong = 0;
    /** @type {number[]} how many pixels have a channel that is so far off, from 0 to 255 */
    this.gaps = new Array(256).fill(0);
    /** @type {{x: number, y: number} | null} */
    this.first = null;
    /** @type {{x: number, y: number} | null} */
    this.worst = null;
    if (this.comparable) {
      this.#count();
    }
  }

  #count() {
    let largest = 0;
    for (let at = 0; at < this.width * this.height; ++at) {
      const gap = this.#gap(at * 4);
      this.gaps[gap] += 1;
      if (gap > compareTolerance) {
        const place = { x: at % this.width, y: Math.floor(at / this.width) };
        this.wrong += 1;
        this.first ??= place;
        if (gap > largest) {
          largest = gap;
          this.worst = place;
        }
      }
    }
  }

  #gap(at) {
    const [a, b] = [this.reference.data, this.mine.data];
    return Math.max(Math.abs(a[at] - b[at]), Math.abs(a[at + 1] - b[at + 1]), Math.abs(a[at + 2] - b[at + 2]));
  }

  /**
   * @param {Raster | null} raster
   * @returns {number[] | null} red, green and blue, or null outside of the picture
   */
  static colour(raster, x, y) {
    if (!raster || x < 0 || y < 0 || x >= raster.width || y >= raster.height) {
      return null;
    }
    const at = (y * raster.width + x) * 4;
    return [...raster.data.subarray(at, at + 3)];
  }

  /** @returns {number[] | null} how far apart the channels are */
  difference(x, y) {
    const mine = PicturePair.colour(this.mine, x, y);
    const reference = PicturePair.colour(this.reference, x, y);
    return this.comparable && mine && reference ? mine.map((value, channel) => value - reference[channel]) : null;
  }

  /** @returns {Raster} the difference, 8 times brighter */
  get differenceRaster() {
    this.differenceMade ??= makeRaster(this.width, this.height, (data) => {
      for (let at = 0; at < data.length; ++at) {
        data[at] = at % 4 === 3 ? 255 : 8 * Math.abs(this.reference.data[at] - this.mine.data[at]);
      }
    });
    return this.differenceMade;
  }

  /** @returns {Raster} FLIP's map in colours */
  get heatRaster() {
    this.heatMade ??= makeRaster(this.width, this.height, (data) => {
      for (let at = 0; at < data.length; at += 4) {
        data.set([...heatColour(this.flip.data[at] / 255), 255], at);
      }
    });
    return this.heatMade;
  }
}
