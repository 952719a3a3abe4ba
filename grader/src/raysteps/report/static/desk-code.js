"use strict";

/** The code of a step: lines with numbers, one of which is the current one, and what was said at them. */
class DeskCode {
  /**
   * @param {object} step
   * @param {object[]} threads that are shown at a line
   * @param {(thread: object) => Node} card of a thread
   * @param {(line: number) => void} comment begins a comment
   */
  constructor(step, threads, card, comment) {
    this.lines = step.code.map((text, at) => {
      const number = makeButton(String(at + 1), { class: "line-number", tabindex: -1 }, () => {
        this.choose(at);
        comment(at + 1);
      });
      number.setAttribute("aria-label", `Line ${at + 1}: comment`);
      const cards = threads.filter(({ line }) => line === at + 1).map(card);
      return make("li", {}, number, make("code", {}, text || " "), ...cards);
    });
    this.element = make("ol", { class: "desk-lines", "aria-label": `Code of ${step.file}` }, ...this.lines);
    this.at = 0;
    this.element.addEventListener("keydown", (event) => this.move(event));
    if (this.lines.length) {
      this.button(0).tabIndex = 0;
    }
  }

  button(at) {
    return this.lines[at].firstElementChild;
  }

  choose(at) {
    this.button(this.at).tabIndex = -1;
    this.at = Math.max(0, Math.min(this.lines.length - 1, at));
    this.button(this.at).tabIndex = 0;
  }

  focus(at = this.at) {
    if (this.lines.length) {
      this.choose(at);
      this.button(this.at).focus();
    }
  }

  move(event) {
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: 20, PageUp: -20, Home: -Infinity, End: Infinity };
    const step = steps[event.key];
    if (step !== undefined && event.target.classList.contains("line-number")) {
      event.preventDefault();
      this.focus(Math.max(0, Math.min(this.lines.length - 1, this.at + step)));
    }
  }

  /** Puts a form below a line. */
  place(line, form) {
    this.lines[line - 1].append(form);
  }
}
