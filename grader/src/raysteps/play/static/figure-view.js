// A view of a live figure: lines, dots and areas of a world of two dimensions, drawn as SVG.

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = 12; // around what a view shows, in its own pixels
const WIDTH = 320;

export function svg(tag, attributes = {}, ...children) {
  const node = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) {
    node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

/** What a view shows: the world's x runs to the right, y up; both have the same scale unless the view has its own. */
export class View {
  #scene = svg("g", { "aria-hidden": "true" });
  #canvas = document.createElement("canvas");
  #box;
  #scale;

  constructor(description) {
    const [left, bottom, right, top] = description.box;
    const scale = (WIDTH - 2 * MARGIN) / (right - left);
    this.#box = description.box;
    this.#scale = [scale, description.stretch ?? scale];
    const height = 2 * MARGIN + (top - bottom) * this.#scale[1];
    this.draw = description.draw;
    this.node = svg("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "group", "aria-label": description.label });
    this.node.append(this.#scene);
    const title = make("strong", {}, "To be drawn here");
    const toCome = make("p", { class: "live-to-come" }, title, make("br"), `${description.label}.`);
    this.room = make("div", { class: "live-view" }, this.node, toCome);
  }

  /** Where a point of the world is. */
  at([x, y]) {
    const [left, , , top] = this.#box;
    return [MARGIN + (x - left) * this.#scale[0], MARGIN + (top - y) * this.#scale[1]];
  }

  /** The point of the world below a pointer. */
  under(event) {
    const seen = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.node.getScreenCTM().inverse());
    const [left, , , top] = this.#box;
    return [left + (seen.x - MARGIN) / this.#scale[0], top - (seen.y - MARGIN) / this.#scale[1]];
  }

  clear() {
    this.#scene.replaceChildren();
  }

  #add(tag, look, attributes) {
    this.#scene.append(svg(tag, { class: `live-${look}`, ...attributes }));
  }

  /** A line through points of the world. */
  line(points, look) {
    const places = points.filter((point) => point.every(Number.isFinite)).map((point) => this.at(point).join(","));
    this.#add("polyline", look, { points: places.join(" ") });
  }

  /** A rectangle between two corners. */
  outline([x, y], [x1, y1], look) {
    const corners = [
      [x, y],
      [x1, y],
      [x1, y1],
      [x, y1],
    ];
    this.line([...corners, corners[0]], look);
  }

  segment(from, to, look) {
    this.line([from, to], look);
  }

  /** A segment with a head at its end. */
  arrow(from, to, look) {
    this.segment(from, to, look);
    const [[x0, y0], [x1, y1]] = [this.at(from), this.at(to)];
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length > 1) {
      const [x, y] = [(8 * (x1 - x0)) / length, (8 * (y1 - y0)) / length];
      const head = [x1, y1, x1 - x - y / 2, y1 - y + x / 2, x1 - x + y / 2, y1 - y - x / 2];
      this.#add("polygon", `${look} live-head`, { points: head.join(" ") });
    }
  }

  dot(point, look, radius = 4) {
    const [cx, cy] = this.at(point);
    if (Number.isFinite(cx + cy)) {
      this.#add("circle", look, { cx, cy, r: radius });
    }
  }

  /** Many dots, which are one thing to draw. */
  dots(points, look, radius) {
    const places = points.map((point) => this.at(point)).filter((place) => place.every(Number.isFinite));
    this.#add("path", `${look} live-dots`, {
      d: places.map((place) => `M${place}h0`).join(""),
      "stroke-width": 2 * radius,
    });
  }

  circle(center, radius, look) {
    const [cx, cy] = this.at(center);
    this.#add("circle", look, { cx, cy, r: radius * this.#scale[0] });
  }

  /** What is filled between two corners, whichever: glass, or a box. */
  area(corner, other) {
    const [[x, y], [x1, y1]] = [this.at(corner), this.at(other)];
    const [width, height] = [Math.abs(x1 - x), Math.abs(y1 - y)];
    if (Number.isFinite(width + height)) {
      this.#add("rect", "area", { x: Math.min(x, x1), y: Math.min(y, y1), width, height });
    }
  }

  words(point, text) {
    const [x, y] = this.at(point);
    if (Number.isFinite(x + y)) {
      this.#scene.append(svg("text", { class: "live-words", x, y }, text));
    }
  }

  /** A picture between two corners, six hexadecimal digits a pixel, so many in a row. */
  picture(corner, other, digits, width) {
    const pixels = Uint8ClampedArray.from({ length: (digits.length / 6) * 4 }, (_, at) =>
      at % 4 === 3 ? 255 : Number.parseInt(digits.substr(6 * (at >> 2) + 2 * (at % 4), 2), 16),
    );
    const data = new ImageData(pixels, width);
    Object.assign(this.#canvas, { width, height: data.height }).getContext("2d").putImageData(data, 0, 0);
    const [[x, y], [x1, y1]] = [this.at(corner), this.at(other)];
    this.#add("image", "picture", { x, y, width: x1 - x, height: y1 - y, href: this.#canvas.toDataURL() });
  }

  /** A rectangle between two corners, filled with red, green and blue in bytes. */
  swatch(corner, other, bytes) {
    const [[x, y], [x1, y1]] = [this.at(corner), this.at(other)];
    this.#add("rect", "swatch", { x, y, width: x1 - x, height: y1 - y, fill: `rgb(${bytes.join(" ")})` });
  }
}
