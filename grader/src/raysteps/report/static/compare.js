"use strict";

/** @type {WeakMap<Element, (seen: boolean) => void>} */
const compareSeen = new WeakMap();
const compareWatch = new IntersectionObserver(
  (entries) => {
    for (const entry of entries) {
      compareSeen.get(entry.target)?.(entry.isIntersecting);
    }
  },
  { rootMargin: "150px" },
);
const compareResize = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    target.closest("compare-pictures")?.resized();
  }
});

/** `<compare-pictures>`: two pictures, and the ways to find where they differ. Nothing is read before it is seen. */
class ComparePictures extends HTMLElement {
  #desk = null;
  #shared = null;
  #seen = false;
  #reading = null;

  connectedCallback() {
    this.#shared = SharedView.of(this.getAttribute("group"));
    this.#shared.watchers.add(this.refresh);
    this.#build();
    compareSeen.set(this, (seen) => this.#see(seen));
    compareWatch.observe(this);
  }

  disconnectedCallback() {
    this.#shared.watchers.delete(this.refresh);
    compareWatch.unobserve(this);
    this.#see(false);
    this.#clear();
  }

  /**
   * Shows other pictures.
   * @param {{reference?: {src: string, name?: string, alt?: string}, mine?: object, flip?: object}} pictures
   */
  setPictures(pictures) {
    for (const image of this.querySelectorAll(":scope > img")) {
      image.remove();
    }
    for (const [role, picture] of Object.entries(pictures)) {
      if (picture) {
        const { src, name = role, alt = name } = picture;
        this.append(make("img", { "data-role": role, "data-name": name, alt, src }));
      }
    }
    if (this.#desk) {
      const view = this.#desk.view;
      this.#clear();
      this.#build();
      this.#desk.view = view;
      this.#see(this.#seen);
    }
  }

  /** The view: slider, blink, side, difference or flip. */
  get view() {
    return this.#desk?.view ?? "slider";
  }

  set view(view) {
    this.#desk?.choose(view);
  }

  refresh = () => this.#desk?.refresh();

  resized() {
    this.#desk?.resized();
  }

  #image(role) {
    return this.querySelector(`:scope > img[data-role="${role}"]`);
  }

  #build() {
    const name = (role) => this.#image(role)?.dataset.name ?? this.getAttribute(`${role}-name`) ?? role;
    const names = { reference: name("reference"), mine: name("mine") };
    Object.assign(this.dataset, { referenceName: names.reference, mineName: names.mine }); // for who prints the page
    this.#desk = new CompareDesk(
      this.getAttribute("label") ?? "Pictures",
      names,
      this.#shared,
      this.getAttribute("inspect"),
    );
    this.#desk.counted = this.hasAttribute("wrong-share") ? Number(this.getAttribute("wrong-share")) : null;
    this.#desk.noisy = this.hasAttribute("noisy");
    this.#desk.marks.onPixel = ({ x, y }) => this.#tell(x, y);
    this.#desk.marks.onChoice = (detail) => this.dispatchEvent(new CustomEvent("choose", { bubbles: true, detail }));
    const sized = this.#image("reference") ?? this.#image("mine");
    this.append(this.#desk.ui.root);
    this.#desk.shape(Number(sized?.getAttribute("width") ?? 4), Number(sized?.getAttribute("height") ?? 3));
    compareResize.observe(this.#desk.ui.stage);
    this.dataset.state = "waiting";
  }

  #clear() {
    compareResize.unobserve(this.#desk.ui.stage);
    this.#desk.see(false);
    this.#desk.ui.root.remove();
    this.#desk = null;
    this.#reading = null;
  }

  #tell(x, y) {
    const { reference, mine } = this.#desk.pair;
    const detail = { x, y, reference: PicturePair.colour(reference, x, y), mine: PicturePair.colour(mine, x, y) };
    this.dispatchEvent(new CustomEvent("pixel", { bubbles: true, detail }));
  }

  #see(seen) {
    this.#seen = seen;
    if (seen && !this.#reading) {
      this.#reading = this.#read(this.#desk);
    }
    this.#desk?.see(seen);
  }

  async #read(desk) {
    const images = ["reference", "mine", "flip"].map((role) => this.#image(role));
    const pair = new PicturePair(...(await Promise.all(images.map((image) => image && readRaster(image)))));
    if (desk !== this.#desk) {
      return; // other pictures came meanwhile
    }
    desk.take(pair);
    this.dataset.state = "ready";
  }
}

customElements.define("compare-pictures", ComparePictures);
