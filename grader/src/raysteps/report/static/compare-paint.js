"use strict";

/** From this size on, in CSS pixels, the numbers of a pixel are written on it. */
const compareNumbersFrom = 44;

/**
 * What is drawn into a pane: a picture, and what stands on its pixels when they are large.
 * @typedef {{raster: Raster, numbers: (x: number, y: number) => (string | number)[]}} Layer
 */

/**
 * @param {CanvasRenderingContext2D} context scaled to CSS pixels
 * @param {Pane} pane
 * @param {Layer} layer
 * @param {{left: number, top: number, width: number, height: number}} clip
 */
function paintLayer(context, pane, layer, clip) {
  context.save();
  context.beginPath();
  context.rect(clip.left, clip.top, clip.width, clip.height);
  context.clip();
  const { canvas, width, height } = layer.raster;
  context.imageSmoothingEnabled = pane.scale * devicePixelRatio < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(canvas, pane.left, pane.top, width * pane.scale, height * pane.scale);
  if (pane.scale >= compareNumbersFrom) {
    paintNumbers(context, pane, layer, clip);
  }
  context.restore();
}

function paintNumbers(context, pane, { raster, numbers }, clip) {
  const size = Math.min(14, pane.scale / 4);
  context.font = `${size}px ui-monospace, Menlo, Consolas, "Liberation Mono", monospace`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  const from = (place, start) => Math.max(0, Math.floor((place - start) / pane.scale));
  const to = (place, start, most) => Math.min(most, Math.ceil((place - start) / pane.scale));
  for (let y = from(clip.top, pane.top); y < to(clip.top + clip.height, pane.top, raster.height); ++y) {
    for (let x = from(clip.left, pane.left); x < to(clip.left + clip.width, pane.left, raster.width); ++x) {
      const [red, green, blue] = PicturePair.colour(raster, x, y);
      context.fillStyle = 0.299 * red + 0.587 * green + 0.114 * blue > 110 ? "#000" : "#fff";
      const lines = numbers(x, y);
      lines.forEach((text, line) => {
        const down = (line - (lines.length - 1) / 2) * size * 1.2;
        context.fillText(String(text), pane.left + (x + 0.5) * pane.scale, pane.top + (y + 0.5) * pane.scale + down);
      });
    }
  }
}

/**
 * A frame around a pixel, if there is one, that is seen on any colour; a small pixel gets a ring.
 * @param {{x: number, y: number} | null} pixel
 * @param {"mark" | "cursor"} kind
 */
function paintFrame(context, pane, pixel, kind) {
  if (!pixel) {
    return;
  }
  const { x, y } = pixel;
  context.save();
  context.beginPath();
  context.rect(pane.box.left, pane.box.top, pane.box.width, pane.box.height);
  context.clip();
  const room = Math.max(pane.scale, kind === "mark" ? 12 : 5);
  const [left, top] = [pane.left + (x + 0.5) * pane.scale - room / 2, pane.top + (y + 0.5) * pane.scale - room / 2];
  context.beginPath();
  if (kind === "mark" && pane.scale < 12) {
    context.arc(left + room / 2, top + room / 2, room * 0.7, 0, 2 * Math.PI);
  } else {
    context.rect(left - 1, top - 1, room + 2, room + 2);
  }
  context.lineWidth = 4;
  context.strokeStyle = "#000";
  context.stroke();
  context.lineWidth = 2;
  context.strokeStyle = kind === "mark" ? "#ffd43b" : "#fff";
  context.stroke();
  context.restore();
}
