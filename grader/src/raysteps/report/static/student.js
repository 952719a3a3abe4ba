"use strict";

/** Unfolds the step that the address names, or the step around the picture that it names. */
function unfoldTarget() {
  const target = document.getElementById(location.hash.slice(1));
  if (target instanceof HTMLDetailsElement) {
    for (let room = target; room; room = room.parentElement.closest("details")) {
      room.open = true;
    }
    target.scrollIntoView();
  }
}

/** The button that unfolds all steps, and folds them again. */
function listenToUnfold(button, steps) {
  const tell = () => {
    button.textContent = steps.every(({ open }) => open) ? "Fold all" : "Unfold all";
  };
  button.hidden = false;
  button.addEventListener("click", () => {
    const open = !steps.every((step) => step.open);
    steps.forEach((step) => {
      step.open = open;
    });
  });
  for (const step of steps) {
    step.addEventListener("toggle", tell);
  }
  tell();
}

/** The comparison in a picture's place in its step. */
function comparisonAt(id) {
  return document.getElementById(id)?.querySelector("compare-pictures");
}

/** The same scene, larger, where a picture has it. */
function largeAt(id) {
  return document.getElementById(id)?.querySelector("figure.large");
}

/** Large, above all steps: one of the student's pictures after the other, chosen from a list. */
class PictureViewer {
  #room;
  #links;

  constructor(section) {
    this.#room = section.querySelector(".viewer-room");
    this.#links = [...section.querySelectorAll(".own a")];
    section.hidden = false;
    this.#links.forEach((link, at) => {
      link.addEventListener("click", (event) => {
        event.preventDefault();
        this.#show(at);
      });
    });
    section.addEventListener("keydown", ({ key, ctrlKey, altKey, metaKey }) => {
      const step = { n: 1, p: -1 }[key];
      if (step && !ctrlKey && !altKey && !metaKey) {
        this.#show((this.#at + step + this.#links.length) % this.#links.length);
      }
    });
    this.#show(0);
  }

  get #at() {
    return this.#links.findIndex((link) => link.hasAttribute("aria-current"));
  }

  #show(at) {
    const link = this.#links[at];
    const from = comparisonAt(link.hash.slice(1));
    const view = this.#room.querySelector("compare-pictures")?.view ?? "slider";
    const shown = from.cloneNode(false);
    shown.append(...[...from.querySelectorAll(":scope > img")].map((image) => image.cloneNode()));
    const large = largeAt(link.hash.slice(1))?.cloneNode(true);
    const both = large ? [large, shown] : [shown];
    this.#room.replaceChildren(...("passed" in link.dataset ? both : both.reverse()));
    shown.view = view;
    for (const other of this.#links) {
      other.toggleAttribute("aria-current", false);
    }
    link.setAttribute("aria-current", "true");
    const [title, message] = this.#room.previousElementSibling.children;
    title.textContent = link.dataset.title;
    message.textContent = link.dataset.message;
  }
}

/** The pictures of a report in which all is right. */
function hangPictures() {
  for (const figure of document.querySelectorAll("figure[data-picture]")) {
    const small = comparisonAt(figure.dataset.picture)?.querySelector(':scope > img[data-role="mine"]');
    const image = largeAt(figure.dataset.picture)?.querySelector("img") ?? small;
    if (image) {
      figure.prepend(image.cloneNode());
    }
  }
}

const viewer = document.querySelector(".viewer");
if (viewer) {
  new PictureViewer(viewer);
}
hangPictures();
for (const link of document.querySelectorAll('a[href^="#step-"]')) {
  link.addEventListener("click", () => setTimeout(unfoldTarget));
}
addEventListener("hashchange", unfoldTarget);
listenToUnfold(document.getElementById("unfold"), [...document.querySelectorAll("details.step")]);
unfoldTarget();
