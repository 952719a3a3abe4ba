// The hints of a step, one after the other.

import { element } from "./page-data.js";

/** Words flow, and keep `code` apart; what has columns, as pseudocode has, keeps them, and its lines. */
function hint(text) {
  if (!/\S {2}|^ /m.test(text)) {
    return make("p", {}, ...coded(text));
  }
  const pre = make("pre", { class: "play-hint", tabindex: 0 });
  for (const line of text.split("\n")) {
    const span = make("span", {}, ...coded(line));
    span.style.setProperty("--hang", line.search(/\S|$/) + 2); // where it goes on, if there is no room for it
    pre.append(span);
  }
  return pre;
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
