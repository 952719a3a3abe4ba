// Noisy pictures: as images/noise.py compares them, with the same bounds and words.

import { percent } from "./pictures.js";

const PART = 8; // pixels along a side
const DEVIATIONS = 7.5;
const RELATIVE = 2e-3;
const ABSOLUTE = 5e-4;

/** What `raytrace --estimates` writes: of each pixel three means and their variances. */
export function readEstimates(bytes) {
  const head = new TextDecoder("latin1").decode(bytes?.subarray(0, 64));
  const found = /^raysteps-estimates (\d+) (\d+)\n/.exec(head);
  if (!found) {
    return null;
  }
  const [width, height] = [Number(found[1]), Number(found[2])];
  const view = new DataView(bytes.buffer, bytes.byteOffset + found[0].length);
  if (view.byteLength !== 24 * width * height) {
    return null;
  }
  const values = new Float64Array(6 * width * height);
  for (let at = 0; at < values.length; at++) {
    values[at] = view.getFloat32(4 * at, true);
  }
  return { width, height, values };
}

/** Means and variances of parts of the picture, each with its number of pixels. */
function inParts({ width, height, values }) {
  const across = Math.ceil(width / PART);
  const parts = Array.from({ length: across * Math.ceil(height / PART) }, () => ({
    pixels: 0,
    sums: Array(6).fill(0),
  }));
  for (let pixel = 0; pixel < width * height; pixel++) {
    const [x, y] = [pixel % width, Math.floor(pixel / width)];
    const part = parts[Math.floor(y / PART) * across + Math.floor(x / PART)];
    part.pixels++;
    for (let number = 0; number < 6; number++) {
      part.sums[number] += values[6 * pixel + number];
    }
  }
  return parts.map(({ pixels, sums }) => ({
    pixels,
    mean: sums.slice(0, 3).map((sum) => sum / pixels),
    variance: sums.slice(3).map((sum) => sum / pixels ** 2),
  }));
}

function whole(parts) {
  const all = parts.reduce((sum, { pixels }) => sum + pixels, 0);
  const sum = (value) =>
    [0, 1, 2].map((channel) => parts.reduce((total, part) => total + value(part, part.pixels / all)[channel], 0));
  return {
    mean: sum(({ mean }, share) => mean.map((light) => share * light)),
    variance: sum(({ variance }, share) => variance.map((one) => share ** 2 * one)),
  };
}

/** How far each channel is off, and how far it may be; `usual`: the reference's mean variance. */
function off(mine, right, { factor, most: mostNoise }, usual) {
  return [0, 1, 2].map((channel) => {
    const allowed = mostNoise * factor * Math.max(right.variance[channel], usual[channel]);
    const own = Math.max(Math.min(mine.variance[channel], allowed), factor * right.variance[channel]);
    const bound = DEVIATIONS * Math.sqrt(own + right.variance[channel]);
    const most = bound + RELATIVE * Math.abs(right.mean[channel]) + ABSOLUTE;
    return { by: mine.mean[channel] - right.mean[channel], most };
  });
}

const isWrong = (channels) => channels.some(({ by, most }) => Math.abs(by) > most);
const brief = (number, digits = 3) => String(Number(number.toPrecision(digits)));
const numbers = (light) => `(${light.map((channel) => brief(channel)).join(", ")})`;

function lostPixels({ width, values }) {
  let first = -1;
  let lost = 0;
  for (let pixel = 0; pixel < values.length / 6; pixel++) {
    const six = values.subarray(6 * pixel, 6 * pixel + 6);
    if (!six.every(Number.isFinite) || six.subarray(3).some((variance) => variance < 0)) {
      first = lost++ ? first : pixel;
    }
  }
  const where = `x=${first % width}, y=${Math.floor(first / width)}`;
  return lost
    ? `${percent((6 * lost) / values.length)} of the pixels have light that is no finite number; the first is ${where}.`
    : "";
}

function partsOff(own, rights, noise, across) {
  const usual = [0, 1, 2].map(
    (channel) => rights.reduce((sum, { variance }) => sum + variance[channel], 0) / rights.length,
  );
  const all = own.map((part, number) => off(part, rights[number], noise, usual));
  const share = all.filter(isWrong).length / all.length;
  if (share === 0) {
    return "";
  }
  const far = all.map((channels) => Math.max(...channels.map(({ by, most }) => Math.abs(by / most))));
  const worst = far.indexOf(Math.max(...far));
  const place = (number) => PART * number + PART / 2;
  return (
    `The light of ${percent(share)} of the picture is wrong by more than chance explains; farthest off is the part ` +
    `around x=${place(worst % across)}, y=${place(Math.floor(worst / across))}: its mean light is ` +
    `${numbers(own[worst].mean)}, expected ${numbers(rights[worst].mean)}.`
  );
}

function pictureOff(mine, right, noise) {
  const channels = off(mine, right, noise, right.variance);
  if (!isWrong(channels)) {
    return "";
  }
  const how = channels.reduce((sum, { by }) => sum + by, 0) < 0 ? "dark" : "bright";
  const chance = brief(Math.max(...channels.map(({ most }) => most)), 2);
  return (
    `The picture is too ${how}: its mean light is ${numbers(mine.mean)}, expected ${numbers(right.mean)}; ` +
    `chance explains at most ${chance} of that.`
  );
}

function tooNoisy(mine, right, factor, most) {
  const sum = ({ variance }) => variance.reduce((total, one) => total + one, 0);
  const ratio = sum(right) > 0 ? sum(mine) / (factor * sum(right)) : sum(mine) > 0 ? Infinity : 1;
  return ratio > most
    ? `The picture is too noisy: its variance is ${brief(ratio)} times the reference's with as many samples; at most ` +
        `${brief(most)} times is expected. Its mean light is right, as far as that can be told.`
    : "";
}

/**
 * Whether chance explains how far the picture is from the reference's.
 * @param {{width: number, height: number, values: Float64Array}} mine
 * @param {{width: number, height: number, most: number, factor: number, parts: number[][]}} noise what the page knows of
 *   the reference's: six numbers for each part
 */
export function compareEstimates(mine, noise) {
  const fails = (message) => ({ passed: message === "", message });
  if (mine.width !== noise.width || mine.height !== noise.height) {
    return fails(`The picture has another size: ${mine.width}x${mine.height} pixels.`);
  }
  const lost = lostPixels(mine);
  if (lost) {
    return fails(lost);
  }
  const own = inParts(mine);
  const rights = own.map(({ pixels }, number) => ({
    pixels,
    mean: noise.parts[number].slice(0, 3),
    variance: noise.parts[number].slice(3),
  }));
  const [all, right] = [whole(own), whole(rights)];
  return fails(
    pictureOff(all, right, noise) ||
      partsOff(own, rights, noise, Math.ceil(mine.width / PART)) ||
      tooNoisy(all, right, noise.factor, noise.most),
  );
}
