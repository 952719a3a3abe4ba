// The pictures of a step: drawn by a program that was built, shown as they grow, and judged as the grader does.

import { compareEstimates, readEstimates } from "./noise.js";
import { AFTER_A_STOP, data, element } from "./page-data.js";
import { compare, draw, readImage, readPpm } from "./pictures.js";
import { Runner, whyNothing } from "./programs.js";

const NO_ESTIMATES = "The estimates that the program wrote beside the picture cannot be read.";
const ESTIMATES = ["--estimates", "/out/estimates"]; // of a noisy picture

/** Draws one picture at a time. */
export class Painter {
  #runner = new Runner();
  #files = new Map();
  #print;
  #offer;

  /** `print` hears what programs print, `offer` of each new picture with its scene. */
  constructor(print, offer) {
    this.#print = print;
    this.#offer = offer;
  }

  stop() {
    this.#runner.stop("hand");
  }

  async #fileOf(name) {
    if (!this.#files.has(name)) {
      const answer = await fetch(name);
      if (!answer.ok) {
        throw new Error(`${name}: cannot be loaded (${answer.status})`);
      }
      this.#files.set(name, new Uint8Array(await answer.arrayBuffer()));
    }
    return this.#files.get(name);
  }

  /** All pictures of the step, one after the other, as they grow; gives their verdicts. `current` says whether anybody
   * still waits, `start` is when the save was. */
  async paint({ step, module, current, start }) {
    const verdicts = [];
    let limit = step.seconds;
    for (const picture of step.pictures) {
      const shown = this.#frame(picture, step);
      const task = {
        module,
        words: ["raytrace", "/scene.nff", ...picture.args, ...data.words.raytrace, ...(picture.noise ? ESTIMATES : [])],
        files: { "/scene.nff": await this.#fileOf(picture.scene) },
        wanted: ["/out/picture.ppm", "/out/stats.json", "/out/estimates"],
      };
      if (!current()) {
        return [];
      }
      const ran = await this.#runner.run(task, limit, (tile) => current() && shown.tile(tile));
      if (!current()) {
        return [];
      }
      limit /= ran.stopped ? AFTER_A_STOP : 1;
      this.#print(ran);
      const verdict = await this.#judge(picture, ran, shown);
      verdicts.push(verdict);
      shown.root.dataset.seconds = ((performance.now() - start) / 1000).toFixed(2);
    }
    return verdicts;
  }

  /** Where a picture stands: the canvas on which it grows, and then the comparison. */
  #frame(picture, step) {
    const id = `picture-${picture.name}`;
    let root = element(id);
    if (!root) {
      const canvas = make("canvas", { class: "play-canvas", role: "img", "aria-label": `${picture.name}: yours` });
      const goal = make("img", { class: "play-goal", src: picture.reference, alt: `${picture.name}: the reference` });
      root = make(
        "article",
        { class: "play-picture", id },
        make("h3", {}, picture.name, make("span", {}), this.#numbersButton()),
        make("p", { class: "play-words" }),
        make("div", { class: "play-pair" }, canvas, goal),
      );
      this.#offer(root, picture, () => this.#fileOf(picture.scene));
      element(picture === step.pictures[0] ? "play-first" : "play-pictures").append(root);
    }
    const [canvas] = root.getElementsByTagName("canvas");
    const pair = root.querySelector(".play-pair");
    const beginGrowing = () => {
      if (pair.hidden || !canvas.dataset.grows) {
        canvas.width = picture.width;
        canvas.height = picture.height;
        canvas.dataset.grows = "yes";
        pair.hidden = false;
        root.querySelector("compare-pictures")?.setAttribute("hidden", "");
      }
    };
    return {
      root,
      tile: (tile) => {
        beginGrowing();
        draw(canvas, tile);
      },
      done: () => delete canvas.dataset.grows,
    };
  }

  /** Shows and hides what a comparison tells of single pixels. */
  #numbersButton() {
    const button = make("button", { type: "button", class: "play-numbers", "aria-pressed": "false" }, "Numbers");
    button.addEventListener("click", () => {
      const isOn = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(isOn));
      button.closest(".play-picture").classList.toggle("play-with-numbers", isOn);
    });
    return button;
  }

  async #judge(picture, ran, shown) {
    shown.done();
    const bytes = ran.code === 0 ? ran.made["/out/picture.ppm"] : null;
    const mine = bytes ? readPpm(bytes) : null;
    const reference = await readImage(picture.reference);
    const estimates = mine && picture.noise ? readEstimates(ran.made["/out/estimates"]) : null;
    const verdict = estimates
      ? compareEstimates(estimates, picture.noise)
      : mine && !picture.noise
        ? compare(mine, reference, picture.maxWrong)
        : { passed: false, message: mine ? NO_ESTIMATES : whyNothing(ran, "The picture", data.words.endless) };
    const stats = ran.made?.["/out/stats.json"];
    if (verdict.passed && picture.maxShare !== null && stats) {
      const { share_tested: share } = JSON.parse(new TextDecoder().decode(stats));
      Object.assign(verdict, this.#judgeWork(share, picture.maxShare));
    }
    const sign = shown.root.querySelector("h3 > span");
    sign.textContent = verdict.passed ? " ✓ right" : mine ? " ✗ wrong" : " ✗ missing";
    sign.className = verdict.passed ? "watch-good" : "watch-bad";
    shown.root.querySelector(".play-words").textContent = verdict.message;
    if (mine) {
      this.#showPair(picture, mine, shown.root);
    }
    return verdict;
  }

  #judgeWork(share, most) {
    if (!share) {
      return { passed: false, message: data.words.noTests };
    }
    const percent = (part) => Number((100 * part).toPrecision(3));
    const message = data.words.tooManyTests.replace("{share}", percent(share)).replace("{most}", percent(most));
    return share <= most ? {} : { passed: false, message };
  }

  #showPair(picture, mine, root) {
    const canvas = make("canvas", { width: mine.width, height: mine.height });
    draw(canvas, mine);
    let view = root.querySelector("compare-pictures");
    if (!view) {
      view = make("compare-pictures", { label: picture.name, group: "play" });
      root.append(view);
    }
    view.removeAttribute("hidden");
    const one = (src, name) => ({ src, name, alt: `${picture.name}: ${name}` });
    view.setPictures({ reference: one(picture.reference, "reference"), mine: one(canvas.toDataURL(), "yours") });
    root.querySelector(".play-pair").hidden = true;
  }
}
