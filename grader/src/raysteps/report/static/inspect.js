"use strict";

/** The stage with its controls, and the tree of rays in words beside it; each follows the other. */
class PixelInside extends HTMLElement {
  connectedCallback() {
    if (this.dataset.from) this.begin(JSON.parse(document.getElementById(this.dataset.from).textContent));
  }

  disconnectedCallback() {
    this.stop();
    this.view?.end();
  }

  piece(name) {
    return this.querySelector(`[data-part="${name}"]`);
  }

  /** @param {Record<string, object>} records by the names that entries of the tree have; there already */
  begin(records) {
    this.spaces = Object.fromEntries(Object.entries(records).map(([name, record]) => [name, spaceOf(record)]));
    try {
      this.choose(Object.keys(records)[0]);
    } catch (error) {
      this.withoutStage(error.message);
      return;
    }
    this.piece("boxes").addEventListener("input", () => this.step(Number(this.piece("boxes").value)));
    this.piece("play").addEventListener("click", () => this.play());
    this.piece("eye").addEventListener("click", () => this.view.fromTheEye());
    this.piece("side").addEventListener("click", () => this.view.fromTheSide());
    this.piece("solid").addEventListener("change", (event) => {
      this.view.solid = event.target.checked;
      this.view.later();
    });
    for (const button of this.querySelectorAll("button[data-space]")) {
      button.addEventListener("click", () => this.choose(button.dataset.space));
    }
    this.addEventListener("click", (event) => this.clicked(event));
  }

  /** @param {string} why there is nothing to see: what can be read is still there */
  withoutStage(why) {
    this.stop();
    this.piece("trouble").textContent = `${why} The tree of rays tells the same in words.`;
    this.piece("trouble").hidden = false;
    this.piece("stage").hidden = true;
    this.dataset.flat = "";
  }

  /** The system takes a stage away, such as after a sleep, and may give it back. @param {HTMLCanvasElement} canvas */
  survive(canvas) {
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      if (canvas === this.piece("canvas")) this.withoutStage("The graphics card has taken the stage away.");
    });
    canvas.addEventListener("webglcontextrestored", () => {
      if (canvas === this.piece("canvas")) this.goOn();
    });
  }

  /** On a new stage: the same ray, as many boxes, from the same side. */
  goOn() {
    const { id } = this.ray;
    const { from, at } = this.view.orbit;
    const boxes = Number(this.piece("boxes").value);
    this.piece("stage").hidden = false;
    try {
      this.choose(this.name);
    } catch (error) {
      this.withoutStage(error.message);
      return;
    }
    this.piece("trouble").hidden = true;
    delete this.dataset.flat;
    Object.assign(this.view.orbit, { from, at });
    this.select(id);
    this.step(boxes);
  }

  /** @param {string} name whose rays: mine or the reference's */
  choose(name) {
    this.name = name;
    const canvas = this.piece("canvas").cloneNode();
    this.piece("canvas").replaceWith(canvas);
    this.view?.end();
    this.view = new InsideView(canvas, this.spaces[name]);
    this.view.solid = this.piece("solid").checked;
    this.survive(canvas);
    const hasBoxes = this.spaces[name].rays.some((ray) => ray.boxes.length);
    this.toggleAttribute("data-without-boxes", !hasBoxes);
    for (const button of this.querySelectorAll("button[data-space]")) {
      button.setAttribute("aria-pressed", String(button.dataset.space === name));
    }
    this.select(this.spaces[name].rays[0].id);
  }

  /** @param {string} id of a ray of the space that is shown */
  select(id) {
    this.stop();
    this.ray = this.spaces[this.name].rays.find((ray) => ray.id === id);
    for (const entry of this.querySelectorAll(".ray[data-chosen]")) delete entry.dataset.chosen;
    const entry = document.getElementById(`${this.name}-${id}`);
    entry.dataset.chosen = "";
    this.piece("ray").textContent = entry.querySelector(".ray-title").textContent;
    const scrubber = this.piece("boxes");
    scrubber.max = String(this.ray.boxes.length);
    scrubber.disabled = this.piece("play").disabled = this.ray.boxes.length === 0;
    this.step(this.ray.boxes.length);
  }

  /** @param {number} count how many boxes of the chosen ray are shown */
  step(count) {
    this.piece("boxes").value = String(count);
    this.view.show(this.ray, count);
    this.piece("box").textContent = this.boxWords(count);
    for (const line of this.querySelectorAll("li[aria-current]")) line.removeAttribute("aria-current");
    const entry = document.getElementById(`${this.name}-${this.ray.id}`);
    entry.querySelector(`:scope > .ray-body > .boxes li[data-box="${count}"]`)?.setAttribute("aria-current", "step");
  }

  boxWords(count) {
    const total = this.ray.boxes.length;
    if (total === 0) return "No boxes were asked for this ray.";
    if (count === 0) return `Before the first of ${total} boxes.`;
    const box = this.ray.boxes[count - 1];
    const level = box.level === null ? "" : `, level ${box.level}`;
    return `Box ${count} of ${total}${level}: ${box.entered ? "entered" : "missed"}.`;
  }

  play() {
    if (this.timer) return this.stop();
    let count = Number(this.piece("boxes").value) % this.ray.boxes.length;
    this.piece("play").textContent = "Stop";
    this.timer = setInterval(() => {
      this.step(++count);
      if (count >= this.ray.boxes.length) this.stop();
    }, 450);
    return undefined;
  }

  stop() {
    clearInterval(this.timer);
    this.timer = 0;
    this.piece("play").textContent = "Play";
  }

  /** A ray's button chooses it; a line of its boxes moves the scrubber there. */
  clicked(event) {
    const entry = event.target.closest(".ray");
    if (!entry) return;
    const button = event.target.closest("button[data-show]");
    const box = event.target.closest("li[data-box]");
    if (!button && !box) return;
    if (entry.dataset.space !== this.name) this.choose(entry.dataset.space);
    this.select(entry.dataset.ray);
    if (box) this.step(Number(box.dataset.box));
    if (button) this.piece("stage").scrollIntoView({ block: "nearest" });
  }
}

customElements.define("pixel-inside", PixelInside);
