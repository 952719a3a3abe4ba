// The hints of a step, one after the other.

import { element } from "./page-data.js";

/** Words flow, and keep `code` apart; what has columns, as pseudocode has, keeps them. */
function hint(text) {
  const pieces = text.split("`").map((piece, at) => (at % 2 ? make("code", {}, piece) : piece));
  const hasColumns = /\S {2}|^ /m.test(text);
  return hasColumns ? make("pre", { class: "play-hint", tabindex: 0 }, ...pieces) : make("p", {}, ...pieces);
}

/** Shows one more, until there is none. */
export function nextHint({ hints }) {
  const room = element("play-hints");
  const text = hints[room.childElementCount];
  if (text) {
    const title = make("summary", {}, `Hint ${room.childElementCount + 1} of ${hints.length}`);
    room.append(make("details", { open: true }, title, hint(text.trim())));
    room.lastElementChild.scrollIntoView({ block: "nearest" });
  }
  element("play-hint").disabled = room.childElementCount >= hints.length;
}
