"use strict";

/** The views in their order; a key from 1 to 5 chooses one. */
const compareViews = [
  { id: "slider", label: "Slider", needsBoth: true },
  { id: "blink", label: "Blink", needsBoth: true },
  { id: "side", label: "Side by side", needsBoth: false },
  { id: "difference", label: "Difference ×8", needsBoth: true },
  { id: "flip", label: "FLIP", needsBoth: true },
];

/**
 * One picture on the stage: where it is, what is drawn, which part of the stage it may use, and its name.
 * @typedef {{pane: Pane, layer: Layer | null, clip: object, name: string, at: "left" | "right"}} Shown
 */

/** @returns {Layer | null} a picture as it is, with its colours as numbers */
function pictureLayer(raster, tone) {
  return raster && { raster: tonedRaster(raster, tone), numbers: (x, y) => PicturePair.colour(raster, x, y) };
}

function differenceLayer(pair, tone) {
  const raster = tonedRaster(pair.differenceRaster, tone);
  return { raster, numbers: (x, y) => pair.difference(x, y).map(signedWords) };
}

function flipLayer(pair) {
  return { raster: pair.heatRaster, numbers: (x, y) => [flipWords(pair, x, y)] };
}

/** Whether two pictures are clearly larger one above the other than side by side. */
function stacks(pair, { width, height }) {
  const fit = (wide, high) => Math.min(wide / pair.width, high / pair.height);
  return fit(width, height / 2) > 1.2 * fit(width / 2, height);
}

/** Two parts of a box, with a gap between them. */
function halves(whole, stacked) {
  const gap = 2;
  const [width, height] = [(whole.width - gap) / 2, (whole.height - gap) / 2];
  return stacked
    ? [
        { ...whole, height },
        { ...whole, top: height + gap, height },
      ]
    : [
        { ...whole, width },
        { ...whole, left: width + gap, width },
      ];
}

/**
 * What a view shows on a stage of this size.
 * @param {string} view
 * @param {PicturePair} pair
 * @param {{reference: string, mine: string}} names
 * @param {{width: number, height: number}} size
 * @param {SharedView} shared
 * @param {{split: number, blinkMine: boolean, tone: Tone}} state `split` is the divider's place, from 0 to 1
 * @returns {Shown[]}
 */
function shownIn(view, pair, names, size, shared, state) {
  const whole = { left: 0, top: 0, ...size };
  const show = (role, box, clip, at) => {
    const raster = pair[role];
    const picture = raster ?? { width: pair.width || 4, height: pair.height || 3 };
    return {
      pane: new Pane(box, picture, shared),
      layer: pictureLayer(raster, state.tone),
      clip,
      name: raster ? names[role] : `${names[role]}: no picture`,
      at,
    };
  };
  const single = (layer, name) => [{ pane: new Pane(whole, pair, shared), layer, clip: whole, name, at: "left" }];
  switch (view) {
    case "slider": {
      const cut = size.width * state.split;
      return [
        show("reference", whole, { ...whole, width: cut }, "left"),
        show("mine", whole, { ...whole, left: cut, width: size.width - cut }, "right"),
      ];
    }
    case "blink":
      return [show(state.blinkMine ? "mine" : "reference", whole, whole, state.blinkMine ? "right" : "left")];
    case "difference":
      return single(differenceLayer(pair, state.tone), "difference × 8");
    case "flip":
      return single(flipLayer(pair), "FLIP: what a person sees differ");
    default: {
      const [one, other] = halves(whole, stacks(pair, size));
      return [show("reference", one, one, "left"), show("mine", other, other, "right")];
    }
  }
}
