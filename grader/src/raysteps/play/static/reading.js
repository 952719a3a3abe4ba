// Files to read beside the one that is written: contracts, tests, headers of the framework, scenes.

const element = (id) => document.getElementById(id);

/** A link that opens a file here, at a line; without scripts, or by another button of the mouse, in its own place. */
export function textLink(name, place, line = 0) {
  const words = line ? `${name}:${line}` : name;
  return make("a", { href: place, class: "play-text", "data-line": line }, make("code", {}, words));
}

async function read(link) {
  const answer = await fetch(link.href);
  const lines = (answer.ok ? await answer.text() : "This file cannot be loaded.").split("\n");
  const at = Number(link.dataset.line ?? 0) - 1;
  const part = (from, to) => lines.slice(from, to).join("\n");
  const marked = make("mark", {}, part(at, at + 1));
  const pieces = at < 0 ? [part(0)] : [`${part(0, at)}\n`, marked, `\n${part(at + 1)}`];
  element("play-reading-title").textContent = decodeURI(link.pathname.split("/texts/").at(-1)).replace(/\.txt$/, "");
  element("play-reading-text").replaceChildren(...pieces);
  element("play-reading").showModal();
  element("play-reading-text").scrollTop = 0;
  marked.scrollIntoView({ block: "center" });
}

/** Everywhere in the page. */
export function openTexts(tellFault) {
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a.play-text");
    if (link && !event.ctrlKey && !event.metaKey && !event.shiftKey) {
      event.preventDefault();
      read(link).catch(tellFault);
    }
  });
}
