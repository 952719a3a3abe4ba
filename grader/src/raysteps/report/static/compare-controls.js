"use strict";

/**
 * Makes an element; attributes by name, children in their order.
 * @param {string} tag
 * @param {Record<string, string | number | boolean>} attributes
 * @param {(Node | string)[]} children
 */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false) {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  element.append(...children);
  return element;
}

/** The parts of a message: what stands between back-quotes as code. */
const coded = (text) => text.split(/`([^`\n]+)`/).map((piece, at) => (at % 2 ? make("code", {}, piece) : piece));

function makeButton(label, attributes, pressed) {
  const button = make("button", { type: "button", ...attributes }, label);
  button.addEventListener("click", pressed);
  return button;
}

const compareKeys = [
  ["← →", "move the divider when it has the focus, else the cursor from pixel to pixel (↑ ↓ too)"],
  ["Shift + arrows", "move the picture; so does dragging"],
  ["+ − 0", "zoom in, zoom out, fit; so does the wheel after a click on the picture, or with Ctrl"],
  ["100 %", "one pixel of the picture on one CSS pixel"],
  ["1 … 5", "slider, blink, side by side, difference, FLIP"],
  ["F W", "first and worst wrong pixel"],
  ["Enter", "keep the pixel under the cursor; so does a click"],
  ["Space", "stop and start blinking"],
];

function makeHelp() {
  const rows = compareKeys.map(([keys, does]) =>
    make("tr", {}, make("th", { scope: "row" }, keys), make("td", {}, does)),
  );
  return make(
    "details",
    { class: "compare-help" },
    make("summary", {}, "Keys"),
    make("table", {}, make("tbody", {}, ...rows)),
  );
}

function makeReadout(names) {
  const cells = {};
  const row = (id, label) => {
    cells[id] = make("td");
    return make("tr", {}, make("th", { scope: "row" }, label), cells[id]);
  };
  const rows = [
    row("place", "Pixel"),
    row("reference", names.reference),
    row("mine", names.mine),
    row("difference", "Difference"),
    row("flip", "FLIP"),
  ];
  return { readout: make("table", { class: "compare-readout" }, make("tbody", {}, ...rows)), cells };
}

/**
 * All elements of a comparison, without any behaviour but calling back.
 * @param {string} label what is compared
 * @param {{reference: string, mine: string}} names
 * @param {Record<string, (...words: any[]) => void>} act
 */
function makeControls(label, names, act) {
  const ui = {};
  ui.views = compareViews.map(({ id, label: text }, at) =>
    makeButton(text, { "data-view": id, "aria-pressed": "false", title: `${text} (key ${at + 1})` }, () =>
      act.view(id),
    ),
  );
  const whole = "100 % shows one pixel of the picture on one CSS pixel";
  ui.zoom = make("output", { class: "compare-zoom", title: whole }, "100 %");
  const bar = make(
    "div",
    { class: "compare-bar" },
    make("div", { role: "group", "aria-label": "View", class: "compare-group" }, ...ui.views),
    make(
      "div",
      { role: "group", "aria-label": "Zoom", class: "compare-group" },
      makeButton("−", { "aria-label": "Zoom out" }, () => act.zoom(0.5)),
      ui.zoom,
      makeButton("+", { "aria-label": "Zoom in" }, () => act.zoom(2)),
      makeButton("Fit", {}, () => act.fit()),
    ),
  );

  ui.canvas = make("canvas", { "aria-hidden": "true" });
  ui.names = {
    left: make("span", { class: "compare-name left" }),
    right: make("span", { class: "compare-name right" }),
  };
  ui.divider = make(
    "div",
    {
      class: "compare-divider",
      role: "slider",
      tabindex: 0,
      "aria-orientation": "horizontal",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
      "aria-label": `Divider between ${names.reference} and ${names.mine}`,
    },
    make("span", { "aria-hidden": "true" }, "⇔"),
  );
  ui.stage = make(
    "div",
    {
      class: "compare-stage",
      tabindex: 0,
      role: "application",
      "aria-label": `${label}: ${names.reference} and ${names.mine}`,
      "aria-roledescription": "picture comparison",
    },
    ui.canvas,
    ui.names.left,
    ui.names.right,
    ui.divider,
  );

  ui.play = makeButton("Pause", {}, () => act.play());
  ui.rate = make("input", { type: "range", min: 0.5, max: 3, step: 0.5, value: 1, "aria-label": "Changes a second" });
  ui.rate.addEventListener("input", () => act.rate(Number(ui.rate.value)));
  ui.blink = make(
    "div",
    { class: "compare-below", hidden: true },
    ui.play,
    makeButton("Swap", {}, () => act.swap()),
    make("span", { class: "muted" }, "slow"),
    ui.rate,
    make("span", { class: "muted" }, "fast"),
  );
  const scale = make("canvas", { "aria-hidden": "true" });
  drawHeatLegend(scale);
  ui.legend = make(
    "div",
    { class: "compare-below", hidden: true },
    make("span", {}, "0 same"),
    scale,
    make("span", {}, "1 different"),
  );

  ui.tone = makeToneControls(act);
  ui.count = make("p", { class: "compare-count" }, "The pictures are read when they are seen.");
  ui.first = makeButton("First wrong pixel", { disabled: true }, () => act.go("first"));
  ui.worst = makeButton("Worst pixel", { disabled: true }, () => act.go("worst"));
  const { readout, cells } = makeReadout(names);
  ui.cells = cells;
  ui.command = make("code", { tabindex: 0 });
  ui.copy = makeButton("Copy", {}, () => {});
  makeCopyButton(ui.copy, ui.command);
  ui.inspect = make("div", { class: "compare-command", hidden: true }, ui.command, ui.copy);
  ui.histogram = makeHistogram();
  ui.say = make("p", { role: "status", class: "hidden-text" });
  const panel = make(
    "div",
    { class: "compare-panel" },
    ui.count,
    make("div", { class: "compare-group" }, ui.first, ui.worst),
    readout,
    ui.inspect,
    ui.tone.root,
    ui.histogram.root,
    makeHelp(),
    ui.say,
  );
  ui.root = make(
    "div",
    { class: "compare" },
    bar,
    make(
      "div",
      { class: "compare-body" },
      make("div", { class: "compare-show" }, ui.stage, ui.blink, ui.legend),
      panel,
    ),
  );
  return ui;
}
