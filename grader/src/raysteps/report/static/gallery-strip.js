"use strict";

/** The strip of steps: small pictures of the chosen scene, and which of them are to the left and to the right. */
class GalleryStrip {
  /** @param {HTMLElement} element */
  constructor(element) {
    this.element = element;
    this.cards = [...element.querySelectorAll(".card")];
    element.addEventListener("focusin", ({ target }) => {
      if (target.matches(":focus-visible")) {
        target.closest(".card").scrollIntoView({ block: "nearest", inline: "nearest" }); // browsers leave half a card
      }
    });
  }

  /** Only the pictures of the chosen scene are ever read. */
  picturesOf(scene, pictures) {
    for (const [index, card] of this.cards.entries()) {
      const image = card.querySelector("img");
      const picture = scene.reference[index]?.picture ?? null;
      card.classList.toggle("elsewhere", scene.reference[index] === null);
      image.hidden = picture === null;
      if (picture !== null) {
        image.src = pictures[picture];
      }
    }
  }

  /** @param {GalleryWalk} walk */
  mark(walk) {
    const own = walk.mode === "mine";
    for (const [index, card] of this.cards.entries()) {
      const [left, right] = [index === walk.left && !own, index === walk.right];
      card.classList.toggle("chosen", left || right);
      card.querySelector(".pick").hidden = own || !walk.shows(index);
      card.querySelector(".thumb").toggleAttribute("aria-current", right);
      card.querySelector("[data-side=left]").setAttribute("aria-pressed", String(left));
      card.querySelector("[data-side=right]").setAttribute("aria-pressed", String(right));
    }
    const chosen = this.cards[walk.right];
    const room = this.element.clientWidth;
    this.element.scrollTo({ left: chosen.offsetLeft - (room - chosen.offsetWidth) / 2 });
  }
}
