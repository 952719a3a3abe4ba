// A pixel's inside: the program inspect, linked with what was built last, asked about the pixel that is chosen in a
// picture, and its words as a tree.

import { Runner, whyNothing } from "./programs.js";

const LINK_SECONDS = 60;
const RECORD = "/out/record.json";
const RAY = /^(?:(?:eye|shadow|reflected|refracted) ray|ray mirrored inside the glass)(?:, depth \d+)?/;
const LABEL_WIDTH = 12; // of the column in which some lines begin
const LABEL = /^[A-Za-z]+(?: \w+)* {2,}$|^transmitted |^tone mapping|^for a screen/;

/** Lines with an indentation as `{text, label, below}`; a line that goes on with the one before stands below it. */
function nested(lines) {
  const top = { level: -1, below: [] };
  const path = [top];
  for (const line of lines) {
    const level = line.search(/\S/);
    const [begin, rest] = [line.slice(level, level + LABEL_WIDTH), line.slice(level + LABEL_WIDTH)];
    const label = LABEL.test(begin) ? begin.trim() : "";
    const entry = { level, label, text: (label ? rest : begin + rest).trim(), below: [] };
    while (path.at(-1).level >= level) {
      path.pop();
    }
    path.at(-1).below.push(entry);
    path.push(entry);
  }
  return top.below;
}

/** The tree of rays: entries of lines, of which those of rays and boxes have what the stage beside them asks for. */
class RayTree {
  #rays;

  /** @param {object} record whose rays come in the order of the lines */
  constructor(record) {
    this.#rays = insideRays(record.ray);
  }

  element(line, ray = null) {
    const title = RAY.exec(line.text)?.[0];
    if (title) {
      return this.#ray(line, title);
    }
    const words = [...(line.label ? [make("strong", { class: "inside-label" }, line.label), " "] : []), line.text];
    if (!line.below.length) {
      return make("p", { class: "inside-line" }, ...words);
    }
    const isBoxes = line.label === "boxes";
    const below = isBoxes ? [this.#boxes(line, ray)] : line.below.map((one) => this.element(one, ray));
    return make("details", { class: isBoxes ? "boxes" : "inside-part" }, make("summary", {}, ...words), ...below);
  }

  #ray({ text, below }, title) {
    const { id, ray } = this.#rays.shift();
    const names = { class: "ray", id: `mine-${id}`, "data-ray": id, "data-space": "mine" };
    const words = [make("strong", { class: "ray-title" }, title), text.slice(title.length)];
    const hidden = make("span", { class: "hidden-text" }, ` the ${title} on the stage`);
    const button = make("button", { type: "button", "data-show": "" }, "Show", hidden);
    if (!below.length) {
      return make("div", names, ...words, " ", button);
    }
    const body = make("div", { class: "ray-body" }, button, ...below.map((one) => this.element(one, ray)));
    return make("details", { ...names, open: true }, make("summary", {}, ...words), body);
  }

  /** The boxes that were entered, each with its place among all that were asked. */
  #boxes({ below }, ray) {
    const entered = ray.boxes.flatMap((box, at) => (box.enter === null ? [] : [at + 1]));
    const line = ({ text }, at) => make("li", at < entered.length ? { "data-box": entered[at] } : {}, text);
    return make("ol", { tabindex: 0, "aria-label": "Boxes that were entered" }, ...below.map(line));
  }
}

/** The dialog in which a pixel is looked into. */
export class Inside {
  #compiler;
  #endless;
  #runner = new Runner();
  #built = null; // step, sources and, once somebody has asked, the program

  constructor(compiler, endless) {
    this.#compiler = compiler;
    this.#endless = endless;
  }

  /** Below a picture; the pixel that its comparison tells of is the one to look into. */
  offer(root, picture, sceneOf) {
    const button = make("button", { type: "button", class: "play-look", hidden: true });
    let pixel = null;
    root.append(button);
    root.addEventListener("choose", ({ detail }) => {
      if (root.lastElementChild !== button) {
        root.append(button); // below the comparison
      }
      pixel = detail;
      button.textContent = `Look inside pixel (${pixel.x}, ${pixel.y})`;
      button.hidden = false;
    });
    button.addEventListener("click", () => this.#look(picture, pixel, sceneOf));
  }

  /** What is asked from now on. */
  built(step, sources) {
    this.#built = { step, sources, module: null };
    this.#allow(true);
  }

  /** While something else is built there is nothing to ask. */
  stop() {
    this.#runner.stop("hand");
    this.#built = null;
    this.#allow(false);
  }

  #allow(isAllowed) {
    for (const button of document.querySelectorAll(".play-look")) {
      button.disabled = !isAllowed;
    }
  }

  async #module(built) {
    if (!built.module) {
      const { step, sources } = built;
      const { program, stopped } = await this.#compiler.build(step.number, sources, LINK_SECONDS, { inspects: true });
      if (!program) {
        throw new Error(stopped ?? "the linker refuses it");
      }
      built.module = await WebAssembly.compile(program);
    }
    return built.module;
  }

  async #look(picture, { x, y }, sceneOf) {
    const dialog = document.getElementById("play-inside");
    const status = document.getElementById("play-inside-status");
    const body = document.getElementById("play-inside-body");
    document.getElementById("play-inside-title").textContent = `Inside pixel (${x}, ${y}) of ${picture.name}`;
    body.replaceChildren();
    status.textContent = "Following the pixel ...";
    dialog.addEventListener("close", () => body.replaceChildren(), { once: true });
    dialog.showModal();
    this.#allow(false); // one question at a time
    try {
      const built = this.#built;
      const task = {
        module: await this.#module(built),
        words: ["inspect", `/${picture.scene}`, String(x), String(y), ...picture.inspect, "--json", RECORD],
        files: { [`/${picture.scene}`]: await sceneOf() },
        wanted: [RECORD],
      };
      const ran = await this.#runner.run(task, built.step.seconds);
      if (!dialog.open) {
        return; // nobody waits for it
      }
      if (ran.code === 0) {
        this.#show(body, ran.stdout, JSON.parse(new TextDecoder().decode(ran.made[RECORD])));
      }
      status.textContent = ran.code === 0 ? "" : whyNothing(ran, "The inside of the pixel", this.#endless);
    } catch (error) {
      status.textContent = `The pixel cannot be followed: ${error.message}.`;
    } finally {
      this.#allow(this.#built !== null);
    }
  }

  /** The words are those of `./raysteps inspect`, behind whatever the steps have printed. */
  #show(body, said, record) {
    const { x, y } = record.pixel;
    const start = said.lastIndexOf(`pixel (${x}, ${y}) of `);
    if (start < 0) {
      throw new Error("your functions print so much that no more is kept");
    }
    const text = said.slice(start).trimEnd();
    const [head, rays, end] = text.split("\n\n").map((part) => nested(part.split("\n")));
    const tree = new RayTree(record);
    const elements = (lines) => lines.map((line) => tree.element(line));
    body.append(document.getElementById("play-inside-parts").content.cloneNode(true));
    body.querySelector(".inside-facts").append(...elements(head));
    body.querySelector(".trees").append(...elements(rays), ...elements(end));
    body.querySelector("pixel-inside").begin({ mine: record });
  }
}
