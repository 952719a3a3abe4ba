"use strict";

/**
 * How pictures are shown, not what they are: the readout always tells the numbers of the file.
 * @typedef {{exposure: number, gamma: number, channel: "all" | "red" | "green" | "blue" | "gray"}} Tone
 */

/** @returns {Tone} as the file has it */
function plainTone() {
  return { exposure: 0, gamma: 1, channel: "all" };
}

const compareChannels = [
  ["all", "RGB", "All channels"],
  ["red", "R", "Red only"],
  ["green", "G", "Green only"],
  ["blue", "B", "Blue only"],
  ["gray", "L", "Brightness only"],
];

/** @type {WeakMap<Raster, {key: string, raster: Raster}>} */
const compareToned = new WeakMap();

/** The value that a byte is shown with: 2 to the exposure times it, to the power of 1 by gamma. */
function tonedByte(value, { exposure, gamma }) {
  return Math.round(255 * Math.min(1, (value / 255) * 2 ** exposure) ** (1 / gamma));
}

/**
 * @param {Raster} raster
 * @param {Tone} tone
 * @returns {Raster} the picture as it is shown
 */
function tonedRaster(raster, tone) {
  const key = `${tone.exposure} ${tone.gamma} ${tone.channel}`;
  if (key === "0 1 all") {
    return raster;
  }
  if (compareToned.get(raster)?.key !== key) {
    compareToned.set(raster, { key, raster: makeToned(raster, tone) });
  }
  return compareToned.get(raster).raster;
}

function makeToned({ width, height, data: from }, tone) {
  const table = Uint8ClampedArray.from({ length: 256 }, (_, value) => tonedByte(value, tone));
  const only = { red: 0, green: 1, blue: 2 }[tone.channel];
  return makeRaster(width, height, (data) => {
    for (let at = 0; at < data.length; at += 4) {
      const gray = tone.channel === "gray" ? 0.2126 * from[at] + 0.7152 * from[at + 1] + 0.0722 * from[at + 2] : 0;
      for (let channel = 0; channel < 3; ++channel) {
        const value = tone.channel === "gray" ? Math.round(gray) : from[at + (only ?? channel)];
        data[at + channel] = table[value];
      }
      data[at + 3] = 255;
    }
  });
}

/** The sliders and buttons for it, folded until somebody wants them. */
function makeToneControls(act) {
  const ui = {};
  const row = (name, label, attributes) => {
    const input = make("input", { type: "range", "aria-label": label, ...attributes });
    const told = make("output", { class: "compare-tone-value" });
    input.addEventListener("input", () => act.tone({ [name]: Number(input.value) }));
    ui[name] = { input, told };
    return make("div", { class: "compare-tone-row" }, make("span", { "aria-hidden": "true" }, label), input, told);
  };
  const rows = [
    row("exposure", "Exposure", { min: -4, max: 8, step: 0.5, value: 0 }),
    row("gamma", "Gamma", { min: 0.4, max: 3, step: 0.1, value: 1 }),
  ];
  ui.channels = compareChannels.map(([id, label, words]) =>
    makeButton(label, { "data-channel": id, "aria-pressed": "false", "aria-label": words, title: words }, () =>
      act.tone({ channel: id }),
    ),
  );
  const channels = make("div", { role: "group", "aria-label": "Channels", class: "compare-group" }, ...ui.channels);
  const reset = makeButton("As it is", {}, () => act.tone(plainTone()));
  ui.root = make(
    "details",
    { class: "compare-tone" },
    make("summary", {}, "Exposure, gamma, channels"),
    ...rows,
    make("div", { class: "compare-tone-row" }, channels, reset),
  );
  return ui;
}

/** @param {Tone} tone */
function tellTone(ui, tone) {
  const { exposure, gamma, channels } = ui.tone;
  exposure.input.value = String(tone.exposure);
  exposure.told.textContent = `${signedWords(tone.exposure)} stops`;
  gamma.input.value = String(tone.gamma);
  gamma.told.textContent = tone.gamma.toFixed(1);
  for (const button of channels) {
    button.setAttribute("aria-pressed", String(button.dataset.channel === tone.channel));
  }
}
