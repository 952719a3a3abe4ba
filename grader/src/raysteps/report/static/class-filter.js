"use strict";

/** Which rows are wanted: what the form says, and the mistake that was chosen. */
class ClassFilter {
  /**
   * @param {HTMLFormElement} form
   * @param {ClassRows} rows
   * @param {{step: string, title: string}[]} mistakes
   * @param {Object<string, string>} letters what is typed for letters that do not decompose
   */
  constructor(form, rows, mistakes, letters) {
    this.form = form;
    this.rows = rows;
    this.mistakes = mistakes;
    this.letters = letters;
    this.mistake = null;
    this.chosen = document.getElementById("chosen");
    this.shown = document.getElementById("shown");
    form.addEventListener("input", () => this.apply());
    form.addEventListener("submit", (event) => event.preventDefault());
    document.getElementById("show-all").addEventListener("click", () => this.clear());
  }

  clear() {
    this.form.reset();
    this.mistake = null;
    this.apply();
  }

  value(name) {
    const field = this.form.elements.namedItem(name);
    return field === null ? "" : field.type === "checkbox" ? field.checked : field.value;
  }

  /** Only those who made this mistake; null for all. */
  choose(mistake) {
    this.mistake = mistake;
    this.apply();
  }

  /** As Python makes the words of a row. */
  searchable(text) {
    const bare = text
      .toLowerCase()
      .normalize("NFKD")
      .replace(/\p{Mn}/gu, "");
    return Array.from(bare, (letter) => this.letters[letter] ?? letter).join("");
  }

  matchesStep(facts) {
    const [step, status] = [this.value("step"), this.value("status")];
    if (status === "") {
      return step === "" || facts.statuses[Number(step)] !== "";
    }
    const fits = status.startsWith("!")
      ? (found) => found !== "" && found !== status.slice(1)
      : (found) => found === status;
    return step === "" ? facts.statuses.some(fits) : fits(facts.statuses[Number(step)]);
  }

  /** A box that is ticked wants those rows only of which its name is true. */
  matchesBoxes(facts) {
    const boxes = this.form.querySelectorAll("input[type=checkbox]");
    return Array.from(boxes).every((box) => !box.checked || facts[box.id]);
  }

  apply() {
    const search = this.searchable(this.value("search")).split(/\s+/).filter(Boolean);
    const hidden = this.rows.namesHidden;
    const count = this.rows.filter(({ facts }) => {
      const words = hidden ? facts.alias : facts.words;
      return (
        search.every((word) => words.includes(word)) &&
        this.matchesStep(facts) &&
        this.matchesBoxes(facts) &&
        (this.mistake === null || facts.mistakes.includes(this.mistake))
      );
    });
    this.tell(count);
  }

  tell(count) {
    const all = this.rows.rows.length;
    this.shown.textContent = count === all ? `${all} submissions` : `${count} of ${all} submissions`;
    this.chosen.hidden = this.mistake === null;
    if (this.mistake !== null) {
      const { step, title } = this.mistakes[this.mistake];
      this.chosen.textContent = `Only those with this mistake in step ${step}: ${title.replaceAll("`", "")}`;
    }
    for (const button of document.querySelectorAll("button[data-mistake]")) {
      button.setAttribute("aria-pressed", String(Number(button.dataset.mistake) === this.mistake));
    }
  }
}
