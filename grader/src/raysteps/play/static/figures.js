// Live figures: what functions say to the reader's numbers, drawn in the handout. In the page to work in they are those
// of the student's last build, on the site the kit's own. This is how a figure is moved, asked and described; what each
// of them draws stands in drawings.js.

import { said } from "./drawing-words.js";
import { drawingsOf } from "./drawings.js";
import { svg, View } from "./figure-view.js";
import { Runner } from "./programs.js";

const SECONDS = 4; // for one answer
const REST = 600; // milliseconds without a change, until what is seen is read out
let lastId = 0;

/** One figure: sliders, views with handles, and a text that says what is seen. */
class Figure {
  #description;
  #values = {};
  #inputs = {};
  #views = [];
  #handles = [];
  #says;
  #announced;
  #resting;
  #isDragged = false;
  #ask;
  #named;

  /** `ask` is called when the reader has changed a number, `named` says in a text whose functions these are. */
  constructor(description, ask, named) {
    this.#description = description;
    this.#ask = ask;
    this.#named = named;
    const title = `live-${++lastId}`;
    this.#says = make("p", { class: "live-says" }, "");
    this.#announced = make("p", { class: "hidden-text", role: "status" }, "");
    this.node = make(
      "section",
      { class: "live", "aria-labelledby": title, "data-figure": description.name },
      make("h3", { id: title }, named(description.title)),
      make("p", {}, named(description.intro)),
      make("div", { class: "live-views" }),
      this.#says,
      this.#announced,
      make("div", { class: "live-sliders" }),
    );
    for (const [name, number] of Object.entries(description.numbers)) {
      this.#values[name] = number.start;
      this.node.querySelector(".live-sliders").append(this.#slider(name, number));
    }
    for (const one of description.views) {
      const view = new View(one);
      this.#views.push(view);
      this.node.querySelector(".live-views").append(view.room);
      for (const handle of one.handles) {
        this.#addHandle(view, handle);
      }
    }
    const back = make("button", { type: "button" }, "Back to the start");
    back.addEventListener("click", () => {
      const starts = Object.entries(description.numbers).map(([name, { start }]) => [name, start]);
      this.#change(Object.fromEntries(starts));
    });
    this.node.append(back);
    this.#showNumbers();
  }

  /** What the reader has set, and the words that ask for it. */
  question() {
    const values = { ...this.#values };
    return { values, words: [this.#description.name, ...this.#description.ask(values)].map(String) };
  }

  #slider(name, { label, min, max, step }) {
    const id = `live-${++lastId}`;
    const input = make("input", { id, type: "range", min, max, step });
    const output = make("output", { for: id, "aria-hidden": "true" });
    input.addEventListener("input", () => this.#change({ [name]: Number(input.value) }));
    this.#inputs[name] = { input, output };
    return make("div", {}, make("label", { for: id }, label), " ", output, input);
  }

  /** Keeps each number to its steps, and within its bounds. */
  #change(wanted) {
    for (const [name, value] of Object.entries(wanted)) {
      const { min, max, step } = this.#description.numbers[name];
      const kept = min + step * Math.round((Math.min(max, Math.max(min, value)) - min) / step);
      this.#values[name] = Number(Math.min(max, kept).toFixed(6));
    }
    this.#showNumbers();
    this.#ask();
  }

  #valueInWords(name) {
    const { words, unit = "" } = this.#description.numbers[name];
    return words ? this.#named(words[this.#values[name]]) : said(this.#values[name]) + unit;
  }

  #showNumbers() {
    for (const [name, limit] of Object.entries(this.#description.limits?.(this.#values) ?? {})) {
      this.#inputs[name].input.max = limit;
      this.#values[name] = Math.min(limit, this.#values[name]);
    }
    for (const [name, { input, output }] of Object.entries(this.#inputs)) {
      input.value = this.#values[name];
      output.textContent = this.#valueInWords(name);
      input.setAttribute("aria-valuetext", output.textContent);
    }
    for (const { node, view, handle } of this.#handles) {
      const [x, y] = view.at(handle.place(this.#values));
      node.setAttribute("transform", `translate(${x} ${y})`);
      const [name] = handle.moves;
      node.setAttribute("aria-valuenow", this.#values[name]);
      node.setAttribute("aria-valuemin", this.#inputs[name].input.min);
      node.setAttribute("aria-valuemax", this.#inputs[name].input.max);
      const texts = handle.moves.map((one) => `${this.#description.numbers[one].label} ${this.#valueInWords(one)}`);
      node.setAttribute("aria-valuetext", texts.join(", "));
    }
  }

  #addHandle(view, handle) {
    const node = svg("g", { class: "live-handle", role: "slider", tabindex: 0, "aria-label": handle.label });
    node.append(svg("circle", { r: 22, class: "live-reach" }), svg("circle", { r: 7, class: "live-grip" }));
    view.node.append(node);
    this.#handles.push({ node, view, handle });
    node.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      const nearest = this.#nearest(view, event);
      nearest.focus({ preventScroll: true }); // it would move away below the pointer
      nearest.setPointerCapture(event.pointerId);
      this.#isDragged = true;
    });
    node.addEventListener("lostpointercapture", () => {
      this.#isDragged = false;
      this.#announce();
    });
    node.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false }); // no scrolling instead
    node.addEventListener("pointermove", (event) => {
      if (node.hasPointerCapture(event.pointerId)) {
        this.#change(handle.drag(view.under(event)));
      }
    });
    node.addEventListener("keydown", (event) => {
      const [across, up = across] = handle.moves;
      const of = { ArrowRight: [across, 1], ArrowLeft: [across, -1], ArrowUp: [up, 1], ArrowDown: [up, -1] };
      if (event.key in of) {
        event.preventDefault();
        const [name, by] = of[event.key];
        this.#change({ [name]: this.#values[name] + by * this.#description.numbers[name].stride });
      }
    });
  }

  /** Handles that lie one above the other are told apart by where they are taken. */
  #nearest(view, event) {
    const [x, y] = view.at(view.under(event));
    const far = ({ handle }) => {
      const [atX, atY] = view.at(handle.place(this.#values));
      return Math.hypot(atX - x, atY - y);
    };
    const mine = this.#handles.filter((one) => one.view === view);
    return mine.reduce((best, one) => (far(one) < far(best) ? one : best)).node;
  }

  /** Only words; where it waits for somebody, also those that say what will be drawn. */
  tell(text, isWaiting) {
    for (const view of this.#views) {
      view.clear();
    }
    this.node.dataset.state = isWaiting ? "waiting" : "failed";
    this.#say(text);
  }

  /** Of the functions that are stubs, whether what is drawn does without them all. */
  isDrawnWithout(names) {
    return names.every((name) => this.#description.onlyNumbers?.includes(name));
  }

  /** The answer to a question with these numbers, which may have been changed since, and what is a stub. */
  show(values, answer, missing) {
    for (const view of this.#views) {
      view.clear();
      view.draw(view, values, answer);
    }
    this.node.dataset.state = "drawn";
    this.#say(missing.length ? waits("The numbers wait", missing) : this.#description.says(values, answer));
  }

  #say(text) {
    this.#says.textContent = this.#named(text);
    this.#announce();
  }

  /** A screen reader hears of it when it rests: not at each frame of a drag. */
  #announce() {
    clearTimeout(this.#resting);
    if (!this.#isDragged) {
      this.#resting = setTimeout(() => {
        this.#announced.textContent = this.#says.textContent;
      }, REST);
    }
  }
}

/** The functions that were asked and are stubs: these say so, and answer with nothing. */
function unwritten({ stderr = "" }) {
  return [...stderr.matchAll(/: (\S+) is not written yet/g)].map(([, name]) => name);
}

function waits(what, names) {
  const listed = [names.slice(0, -1).join(", "), names.at(-1)].filter(Boolean).join(" and ");
  return `${what} for ${listed}: not written yet.`;
}

/** What a program printed last, if it is an answer. */
function answerOf(ran) {
  try {
    return ran.code === 0 ? JSON.parse(ran.stdout.trim().split("\n").at(-1)) : null;
  } catch {
    return null; // it was ended before, or printed more than is kept
  }
}

/** Why there is no answer. */
function whyNot(ran, missing) {
  if (missing.length) {
    return waits("It waits", missing);
  }
  if (ran.stopped) {
    return `Your code gave no answer within ${SECONDS} s. Is there an endless loop?`;
  }
  if (ran.crashed) {
    return `Your code crashed: ${ran.crashed}.`;
  }
  const words = ran.stderr.trim().replace("raysteps play: ", "");
  return words ? `Your code gave up: ${words}` : "Your code ended the program before there was an answer.";
}

const OWNERS = { your: "the kit's", yours: "the kit's", Your: "The kit's", Yours: "The kit's" };

/** The figures of the step that is shown. */
export class Figures {
  #runner;
  #named;
  #first;
  #figures = [];
  #module = null;
  #waiting = new Set(); // figures whose numbers have changed since they were asked
  #isAsking = false;

  /** `first` is said until there is a program; with `ofKit` the functions are not the reader's. */
  constructor(first, { ofKit = false, runner = new Runner() } = {}) {
    this.#first = first;
    this.#runner = runner;
    this.#named = (text) => (ofKit ? text.replace(/\b[Yy]ours?\b/g, (word) => OWNERS[word]) : text);
  }

  /** Puts the figures of a step below the worked example of its handout; gives them. */
  open(number, handout) {
    this.stop();
    this.#module = null;
    this.#figures = drawingsOf(number).map((one) => {
      const figure = new Figure(one, () => this.#ask(figure), this.#named);
      return figure;
    });
    this.tell(this.#first);
    const titles = [...handout.querySelectorAll("h2")];
    const at = titles.findIndex((one) => one.textContent.startsWith("A worked example"));
    const room = titles[at]?.parentElement ?? handout; // on the site each title has one of its own
    const next = titles[at + 1]?.parentElement === room ? titles[at + 1] : null;
    const nodes = this.#figures.map(({ node }) => node);
    for (const node of nodes) {
      room.insertBefore(node, next);
    }
    return nodes;
  }

  /** Draws with what was built. */
  built(module) {
    this.stop();
    this.#module = module;
    for (const figure of this.#figures) {
      this.#ask(figure);
    }
  }

  /** Says the same in all, as long as nothing can be drawn. */
  tell(text) {
    for (const figure of this.#figures) {
      figure.tell(text, true);
    }
  }

  stop() {
    this.#waiting.clear();
    this.#runner.stop("hand");
  }

  /** One question at a time; of several that come meanwhile the last. */
  async #ask(figure) {
    if (!this.#module) {
      return;
    }
    this.#waiting.add(figure);
    if (this.#isAsking) {
      return;
    }
    this.#isAsking = true;
    for (const next of this.#waiting) {
      this.#waiting.delete(next);
      try {
        await this.#answer(next);
      } catch (error) {
        next.tell(`The figure has a fault: ${error.message}.`);
      }
    }
    this.#isAsking = false;
  }

  async #answer(figure) {
    const { values, words } = figure.question();
    const task = { module: this.#module, words: ["figure", ...words], files: {}, wanted: [] };
    const ran = await this.#runner.run(task, SECONDS);
    const missing = unwritten(ran);
    const waited = figure.isDrawnWithout(missing) ? [] : missing;
    let answer = null;
    try {
      answer = waited.length ? null : answerOf(ran);
      if (answer) {
        figure.show(values, answer, missing);
      }
    } catch (error) {
      figure.tell(`Your code's answer cannot be drawn: ${error.message}.`);
      return;
    }
    if (!answer && ran.stopped !== "hand") {
      figure.tell(whyNot(ran, waited), waited.length > 0);
    }
  }
}
