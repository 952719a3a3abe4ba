"use strict";

/** What is said beside a picture's name, and the class of it. */
const signOf = ({ passed, waits, mine, message }) => {
  if (passed) {
    return [" ✓ right", "watch-good"];
  }
  if (waits) {
    return [" … waits", ""];
  }
  return mine || message ? [mine ? " ✗ wrong" : " ✗ missing", "watch-bad"] : ["", ""];
};

/** The pictures of a step; an element stays as long as its picture, so that nobody loses a zoom with a save. */
class WatchPictures {
  #first = document.getElementById("watch-first");
  #room = document.getElementById("watch-pictures");
  #shown = new Map();
  #step = "";

  /** What a run has not drawn yet stays as it was. */
  show(state) {
    if (state.step.id !== this.#step || state.complete) {
      const names = new Set(state.pictures.map((picture) => picture.name));
      for (const [name, { article }] of this.#shown) {
        if (state.step.id !== this.#step || !names.has(name)) {
          article.remove();
          this.#shown.delete(name);
        }
      }
      this.#step = state.step.id;
    }
    for (const picture of state.pictures) {
      this.#showOne(picture, state.step);
    }
  }

  /** Where there is no picture of the student's own, the reference shows where it goes. */
  #showOne(picture, step) {
    const known = this.#shown.get(picture.name) ?? this.#add(picture, step);
    known.words.textContent =
      picture.message || (picture.passed ? "" : picture.mine ? "" : "This is what it shall look like.");
    [known.sign.textContent, known.sign.className] = signOf(picture);
    const key = [picture.reference, picture.mine, picture.flip].join(" ");
    if (key === known.key) {
      return;
    }
    known.key = key;
    known.view.hidden = !picture.mine;
    known.goal.hidden = Boolean(picture.mine) || !picture.reference;
    if (picture.mine) {
      const one = (src, name) => src && { src, name, alt: `${picture.name}: ${name}` };
      const flip = one(picture.flip, "FLIP map");
      known.view.setPictures({
        reference: one(picture.reference, "reference"),
        mine: one(picture.mine, "yours"),
        flip,
      });
    } else if (picture.reference) {
      known.goal.src = picture.reference;
    }
  }

  #add(picture, step) {
    const attributes = { label: picture.name, group: `step-${step.number}` };
    const view = make("compare-pictures", picture.inspect ? { ...attributes, inspect: picture.inspect } : attributes);
    const goal = make("img", { class: "watch-goal", alt: `${picture.name}: the reference` });
    const sign = make("span");
    const words = make("p");
    const article = make("article", { class: "watch-picture" }, make("h2", {}, picture.name, sign), words, goal, view);
    (this.#first.childElementCount ? this.#room : this.#first).append(article);
    const known = { article, view, goal, sign, words, key: null };
    this.#shown.set(picture.name, known);
    return known;
  }
}

/** The page: shows one state after the other. */
class WatchPage {
  #pictures = new WatchPictures();
  #words = document.getElementById("watch-words");
  #step = "";

  show(state) {
    document.getElementById("watch-title").textContent = `${state.step.number} ${state.step.title}`;
    document.title = `${{ good: "✓ ", bad: "✗ ", warn: "! " }[state.verdict.tone] ?? ""}${state.step.number} ${state.step.title}`;
    const verdict = document.getElementById("watch-verdict");
    const took =
      state.seconds !== null && !state.full && state.verdict.tone !== "plain" ? ` (${state.seconds.toFixed(1)} s)` : "";
    WatchPage.#say(verdict, state.verdict.text + took);
    verdict.dataset.tone = state.verdict.tone;
    WatchPage.#offer(state.next);
    const saved = state.saved ? `, saved ${state.saved}` : "";
    this.tell(
      state.over ? "over" : state.phase,
      state.over ? "Not watching any more." : `${state.file}${saved}: ${state.doing}`,
    );
    const stale = state.phase === "looking" && !state.complete;
    this.#words.parentElement.dataset.stale = String(stale && state.step.id === this.#step && !state.known);
    if (!stale || state.known || state.step.id !== this.#step) {
      this.#words.replaceChildren(...watchWords(state));
    }
    this.#pictures.show(state);
    this.#step = state.step.id;
  }

  /** The step after one that is done. */
  static #offer(next) {
    const offer = document.getElementById("watch-next");
    offer.hidden = !next;
    offer.replaceChildren(
      ...(next
        ? [
            `Next: ${next.number} ${next.title}. Press `,
            make("kbd", {}, "n"),
            " in the terminal, or type ",
            make("code", {}, next.command),
          ]
        : []),
    );
  }

  tell(phase, text) {
    const doing = document.getElementById("watch-doing");
    doing.dataset.phase = phase;
    WatchPage.#say(doing, text);
  }

  /** What stays the same is not read out again. */
  static #say(element, text) {
    if (element.textContent !== text) {
      element.textContent = text;
    }
  }
}

/** Follows the server until it says that it is over, or goes away. */
function watchServer(page) {
  const source = new EventSource("events");
  source.addEventListener("message", (event) => {
    const state = JSON.parse(event.data);
    page.show(state);
    if (state.over) {
      source.close();
    }
  });
  source.addEventListener("error", () =>
    page.tell("over", "Not watching any more. Type ./raysteps watch to go on, and open its new address."),
  );
}

const watchPage = new WatchPage();
const watchFirst = JSON.parse(document.getElementById("data").textContent);
watchPage.show(watchFirst);
if (!watchFirst.over) {
  watchServer(watchPage);
}
