"use strict";

/** A stage is narrow below so many CSS pixels. */
const compareNarrow = 520;

/** So wide, in CSS pixels, are the frame of a small pixel and half of the divider's handle. */
const [compareMark, compareDivider] = [24, 16];

/** One comparison at work: what is looked at, and what the reader does with it. */
class CompareDesk {
  #shared;
  #frame = 0;
  #timer = 0;
  #rate = 1;
  #playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;

  /**
   * @param {string} label what is compared
   * @param {{reference: string, mine: string}} names
   * @param {SharedView} shared
   * @param {string | null} inspect the command that inspects a pixel, with {x} and {y}
   */
  constructor(label, names, shared, inspect) {
    this.names = names;
    this.pair = null;
    this.view = "slider";
    this.split = 0.5;
    this.blinkMine = false;
    this.tone = plainTone();
    this.seen = false;
    /** @type {number | null} the share of wrong pixels that a grader counted in a picture that it shows coarser */
    this.counted = null;
    this.noisy = false;
    this.#shared = shared;
    const act = this.#actions();
    this.ui = makeControls(label, names, act);
    this.marks = new CompareMarks(this.ui, names, inspect);
    listenToPointers(this.ui, act);
    this.ui.root.addEventListener("keydown", (event) => {
      if (this.pair && compareKey(event, this.ui, act)) {
        event.preventDefault();
      }
    });
    tellTone(this.ui, this.tone);
    this.#tellView();
  }

  #actions() {
    return {
      view: (id) => this.choose(id),
      zoom: (factor) => this.#shown[0]?.pane.zoomedAtCentre(this.#shared, factor),
      zoomAt: (factor, left, top) => this.#zoomAt(factor, left, top),
      fit: () => this.#shared.set(1, 0.5, 0.5),
      pull: (right, down) => this.#shown[0]?.pane.pulled(this.#shared, right, down),
      push: (right, down) => this.#shown[0]?.pane.pulled(this.#shared, -right * 40, -down * 40),
      canZoom: (factor) => this.#shown.some(({ pane }) => (factor < 1 ? pane.zoom > 1 : pane.zoom < pane.most)),
      zoomed: () => this.#shared.zoom > 1,
      splits: () => this.view === "slider",
      split: (left) => this.#splitTo(left / this.#size.width),
      splitNow: () => this.split,
      splitTo: (split) => this.#splitTo(split),
      hover: (left, top) => this.pair && this.marks.point(this.pair, this.#pixelAt(left, top)),
      leave: () => this.pair && this.marks.point(this.pair, null),
      pick: (left, top) => this.#keep(this.#pixelAt(left, top)),
      keep: () => this.#keep(this.marks.cursor ?? this.marks.kept),
      step: (right, down) => this.#step(right, down),
      go: (which) => this.#go(which),
      blinks: () => this.view === "blink",
      play: () => this.#play(!this.#playing),
      swap: () => this.#swap(),
      tone: (change) => this.#shade(change),
      rate: (rate) => {
        this.#rate = rate;
        this.#play(true);
      },
    };
  }

  get #size() {
    return { width: this.ui.stage.clientWidth, height: this.ui.stage.clientHeight };
  }

  /** What is on the stage, by what is known now: between two frames a view may change more than once. */
  get #shown() {
    const size = this.#size;
    return this.pair?.width && size.width ? shownIn(this.view, this.pair, this.names, size, this.#shared, this) : [];
  }

  /** The stage has the shape of the pictures; where it is narrow, two of them stand one above the other. */
  shape(width, height) {
    const { stage } = this.ui;
    const twice = this.view === "side" && stage.clientWidth < compareNarrow ? 2 : 1;
    stage.style.aspectRatio = `${width} / ${height * twice}`;
  }

  /** When the stage has another size. */
  resized() {
    if (this.pair?.width) {
      this.shape(this.pair.width, this.pair.height);
    }
    this.refresh();
  }

  /** Takes the pictures when they were read. */
  take(pair) {
    this.pair = pair;
    tellPair(this.ui, pair, this.names, this);
    this.marks.offer(pair);
    const impossible = this.ui.views.some(({ dataset, disabled }) => disabled && dataset.view === this.view);
    this.choose(!pair.comparable ? "side" : impossible ? "slider" : this.view);
  }

  /** Nothing is drawn, and no memory of a canvas is held, while nobody sees it. */
  see(seen) {
    this.seen = seen;
    this.#tick();
    if (seen) {
      this.refresh();
    } else {
      this.ui.canvas.width = this.ui.canvas.height = 0;
    }
  }

  choose(view) {
    const button = this.ui.views.find(({ dataset }) => dataset.view === view);
    if (button && !button.disabled) {
      this.view = view;
      this.#tellView();
      this.#tick();
      this.resized();
    }
  }

  /** Draws before the next frame. */
  refresh() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      if (this.seen && this.pair?.width && this.#size.width) {
        this.#draw();
      }
    });
  }

  #draw() {
    this.#placeDivider(this.split);
    const { canvas, names } = this.ui;
    const size = this.#size;
    canvas.width = Math.round(size.width * devicePixelRatio);
    canvas.height = Math.round(size.height * devicePixelRatio);
    const context = canvas.getContext("2d");
    context.scale(devicePixelRatio, devicePixelRatio);
    const all = this.#shown;
    names.left.textContent = names.right.textContent = "";
    for (const { pane, layer, clip, name, at } of all) {
      names[at].textContent = name;
      if (layer) {
        paintLayer(context, pane, layer, clip);
      }
    }
    for (const { pane } of this.view === "slider" ? all.slice(0, 1) : all) {
      paintFrame(context, pane, this.marks.kept, "mark");
      paintFrame(context, pane, this.marks.cursor, "cursor");
    }
    const { pane } = all[0];
    this.ui.zoom.textContent = `${Math.round(pane.scale * 100)} %`;
    this.ui.stage.classList.toggle("zoomed", this.#shared.zoom > 1);
    this.ui.stage.classList.toggle("stacked", all.length > 1 && all[1].pane.box.top > 0);
  }

  #tellView() {
    const { ui, view } = this;
    for (const button of ui.views) {
      button.setAttribute("aria-pressed", String(button.dataset.view === view));
    }
    ui.stage.dataset.view = view;
    ui.divider.hidden = view !== "slider";
    ui.blink.hidden = view !== "blink";
    ui.legend.hidden = view !== "flip";
    ui.play.textContent = this.#playing ? "Pause" : "Play";
    this.#splitTo(this.split);
  }

  #shade(change) {
    Object.assign(this.tone, change);
    tellTone(this.ui, this.tone);
    this.refresh();
  }

  #splitTo(split) {
    this.#placeDivider(Math.min(1, Math.max(0, split)));
    this.refresh();
  }

  /** The divider jumps over the pixel that was chosen, so that it never hides it. */
  #besidePixel(split) {
    const pixel = this.marks?.cursor ?? this.marks?.kept;
    const [shown] = pixel && this.view === "slider" ? this.#shown : [];
    if (!shown?.pane.shows(pixel)) {
      return split;
    }
    const { width } = this.#size;
    const middle = shown.pane.left + (pixel.x + 0.5) * shown.pane.scale;
    const room = Math.max(shown.pane.scale, compareMark) / 2 + compareDivider;
    const [left, right] = [(middle - room) / width, (middle + room) / width];
    if (split <= left || split >= right) {
      return split;
    }
    return (split > this.split && right <= 1) || left < 0 ? Math.min(1, right) : left;
  }

  #placeDivider(wanted) {
    this.split = this.#besidePixel(wanted);
    const percent = Math.round(this.split * 100);
    this.ui.divider.style.left = `${this.split * 100}%`;
    this.ui.divider.setAttribute("aria-valuenow", String(percent));
    this.ui.divider.setAttribute(
      "aria-valuetext",
      `${percent} % ${this.names.reference}, ${100 - percent} % ${this.names.mine}`,
    );
  }

  #zoomAt(factor, left, top) {
    const under = this.#shown.find(({ pane }) => pane.contains(left, top)) ?? this.#shown[0];
    under?.pane.zoomed(this.#shared, factor, left, top);
  }

  #pixelAt(left, top) {
    return this.#shown.map(({ pane }) => pane.pixelAt(left, top)).find(Boolean) ?? null;
  }

  #step(right, down) {
    this.marks.step(this.pair, right, down);
    const [{ pane }] = this.#shown;
    if (!pane.shows(this.marks.cursor)) {
      pane.centred(this.#shared, this.marks.cursor);
    }
    this.refresh();
  }

  #keep(pixel) {
    if (pixel && this.pair) {
      this.marks.keep(this.pair, pixel);
      this.refresh();
    }
  }

  #go(which) {
    const pixel = this.pair[which];
    if (pixel) {
      this.#keep(pixel);
      this.#shown[0].pane.centred(this.#shared, pixel);
    }
  }

  #swap() {
    this.blinkMine = !this.blinkMine;
    this.refresh();
  }

  #play(playing) {
    this.#playing = playing;
    this.#tellView();
    this.#tick();
  }

  #tick() {
    clearInterval(this.#timer);
    if (this.seen && this.view === "blink" && this.#playing) {
      this.#timer = setInterval(() => this.#swap(), 1000 / this.#rate);
    }
  }
}
