"use strict";

/** Farther than this, in CSS pixels, a press is no click but a pull. */
const compareClick = 4;

/**
 * Mouse, pen, touch and wheel on the stage.
 * @param {{stage: HTMLElement, divider: HTMLElement}} ui
 * @param {{zoomAt: Function, pull: Function, hover: Function, leave: Function, pick: Function, split: Function,
 *   splits: () => boolean, zoomed: () => boolean, canZoom: (factor: number) => boolean}} act places are CSS pixels on the stage
 */
function listenToPointers({ stage, divider }, act) {
  /** @type {Map<number, {left: number, top: number}>} */
  const fingers = new Map();
  let travelled = 0;
  let dividing = false;
  const place = (event) => {
    const box = stage.getBoundingClientRect();
    return { left: event.clientX - box.left - stage.clientLeft, top: event.clientY - box.top - stage.clientTop };
  };
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { left: (a.left + b.left) / 2, top: (a.top + b.top) / 2, apart: Math.hypot(a.left - b.left, a.top - b.top) };
  };

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) {
      return;
    }
    stage.setPointerCapture(event.pointerId);
    dividing = !fingers.size && divider.contains(event.target);
    travelled = fingers.size ? Infinity : 0;
    fingers.set(event.pointerId, place(event));
  });
  stage.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = fingers.get(event.pointerId);
    if (!before) {
      act.hover(now.left, now.top);
      return;
    }
    const wide = fingers.size === 2 ? spread() : null;
    fingers.set(event.pointerId, now);
    travelled += Math.hypot(now.left - before.left, now.top - before.top);
    if (wide) {
      const after = spread();
      act.zoomAt(after.apart / Math.max(1, wide.apart), after.left, after.top);
      act.pull(after.left - wide.left, after.top - wide.top);
    } else if (dividing || (travelled > compareClick && act.splits() && !act.zoomed())) {
      act.split(now.left);
    } else if (travelled > compareClick) {
      act.pull(now.left - before.left, now.top - before.top);
    }
  });
  const lift = (event) => {
    const known = fingers.delete(event.pointerId);
    if (known && event.type === "pointerup" && travelled <= compareClick && !dividing) {
      act.pick(place(event).left, place(event).top);
    }
  };
  stage.addEventListener("pointerup", lift);
  stage.addEventListener("pointercancel", lift);
  stage.addEventListener("pointerleave", () => act.leave());
  stage.addEventListener("dblclick", (event) => act.zoomAt(2, place(event).left, place(event).top));
  stage.addEventListener(
    "wheel",
    (event) => {
      const factor = 1.0025 ** -(event.deltaY * (event.deltaMode === 1 ? 16 : 1));
      if (event.ctrlKey || event.metaKey || (stage.matches(":focus-within") && act.canZoom(factor))) {
        event.preventDefault();
        act.zoomAt(factor, place(event).left, place(event).top);
      }
    },
    { passive: false },
  );
}
