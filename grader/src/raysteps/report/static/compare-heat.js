"use strict";

/** Black over violet and red to pale yellow: each colour is lighter than the one before it, also without colour vision. */
const heatStops = [
  [0, [0, 0, 0]],
  [0.2, [58, 12, 96]],
  [0.45, [164, 36, 106]],
  [0.7, [238, 98, 66]],
  [0.88, [252, 186, 92]],
  [1, [255, 250, 205]],
];

/**
 * @param {number} value from 0 to 1
 * @returns {number[]} red, green and blue
 */
function heatColour(value) {
  const after = Math.max(
    1,
    heatStops.findIndex(([at]) => at >= value),
  );
  const [[from, dark], [to, light]] = [heatStops[after - 1], heatStops[after]];
  const share = (value - from) / (to - from);
  return dark.map((channel, at) => Math.round(channel + share * (light[at] - channel)));
}

/**
 * Draws the colours in their order, from left to right.
 * @param {HTMLCanvasElement} canvas
 */
function drawHeatLegend(canvas) {
  canvas.width = 256;
  canvas.height = 1;
  const context = canvas.getContext("2d");
  const image = context.createImageData(256, 1);
  for (let at = 0; at < 256; ++at) {
    image.data.set([...heatColour(at / 255), 255], at * 4);
  }
  context.putImageData(image, 0, 0);
}
