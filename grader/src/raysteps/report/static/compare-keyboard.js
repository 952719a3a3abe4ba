"use strict";

const compareArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @returns {number | null} where a key moves the divider to */
function dividerAfter(key, split) {
  switch (key) {
    case "ArrowLeft":
    case "ArrowDown":
      return split - 0.02;
    case "ArrowRight":
    case "ArrowUp":
      return split + 0.02;
    case "PageDown":
      return split - 0.1;
    case "PageUp":
      return split + 0.1;
    case "Home":
      return 0;
    case "End":
      return 1;
    default:
      return null;
  }
}

/**
 * Does what a key asks for.
 * @param {KeyboardEvent} event
 * @param {{stage: HTMLElement, divider: HTMLElement}} ui
 * @param {Record<string, Function>} act
 * @returns {boolean} whether the key meant something
 */
function compareKey(event, ui, act) {
  const { key, target } = event;
  if (event.ctrlKey || event.altKey || event.metaKey || target instanceof HTMLInputElement) {
    return false;
  }
  const arrow = compareArrows[key];
  const onPicture = ui.stage.contains(target);
  if (arrow && onPicture && event.shiftKey) {
    act.push(...arrow);
    return true;
  }
  if (target === ui.divider) {
    const moved = dividerAfter(key, act.splitNow());
    if (moved !== null) {
      act.splitTo(moved);
      return true;
    }
  }
  if (target === ui.stage && arrow) {
    act.step(...arrow);
    return true;
  }
  if (target === ui.stage && (key === "Enter" || key === " ")) {
    if (key === " " && act.blinks()) {
      act.play();
    } else {
      act.keep();
    }
    return true;
  }
  if (/^[1-5]$/.test(key)) {
    act.view(compareViews[Number(key) - 1].id);
    return true;
  }
  const others = {
    "+": () => act.zoom(2),
    "=": () => act.zoom(2),
    "-": () => act.zoom(0.5),
    _: () => act.zoom(0.5),
    0: () => act.fit(),
    f: () => act.go("first"),
    w: () => act.go("worst"),
  };
  const other = others[key.toLowerCase()];
  other?.();
  return Boolean(other);
}
