// Files to read beside the one that is written: contracts, tests, headers of the framework, scenes.

import { element } from "./page-data.js";

/** For a text beside the source. */
const HAS_ROOM = matchMedia("(min-width: 64rem), (min-width: 40rem) and (min-height: 40rem)");

let newest = 0; // what was asked for last

/** A link that opens a file here, at a line; without scripts, or by another button of the mouse, in its own place. */
export function textLink(name, place, line = 0) {
  const words = line ? `${name}:${line}` : name;
  return make("a", { href: place, class: "play-text", "data-line": line }, make("code", {}, words));
}

/** Beside the source, which can be written meanwhile; over it where there is no room for both. */
function open(dialog) {
  if (HAS_ROOM.matches) {
    dialog.show();
  } else {
    dialog.showModal();
  }
}

/** What was read is of another step. */
export function closeText() {
  ++newest;
  element("play-reading").close();
}

async function read(link) {
  const turn = ++newest;
  const answer = await fetch(link.href);
  const lines = (answer.ok ? await answer.text() : "This file cannot be loaded.").split("\n");
  if (turn !== newest) {
    return; // another text was asked for meanwhile, or another step
  }
  const at = Number(link.dataset.line ?? 0) - 1;
  const part = (from, to) => lines.slice(from, to).join("\n");
  const marked = make("mark", {}, part(at, at + 1));
  const pieces = at < 0 ? [part(0)] : [`${part(0, at)}\n`, marked, `\n${part(at + 1)}`];
  element("play-reading-title").textContent = decodeURI(link.pathname.split("/texts/").at(-1)).replace(/\.txt$/, "");
  element("play-reading-text").replaceChildren(...pieces);
  const dialog = element("play-reading");
  if (!dialog.open) {
    open(dialog);
  }
  element("play-reading-text").focus({ preventScroll: true });
  element("play-reading-text").scrollTop = 0;
  marked.scrollIntoView({ block: "center" });
}

/** Everywhere in the page. */
export function openTexts(tellFault) {
  const dialog = element("play-reading");
  HAS_ROOM.addEventListener("change", () => {
    if (dialog.open) {
      const { activeElement } = document;
      dialog.close();
      open(dialog);
      activeElement.focus({ preventScroll: true }); // in vain where the text lies over it now
    }
  });
  dialog.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") {
      dialog.close(); // a browser does so only for what lies over all else
    }
  });
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a.play-text");
    if (link && !event.ctrlKey && !event.metaKey && !event.shiftKey) {
      event.preventDefault();
      read(link).catch(tellFault);
    }
  });
}
