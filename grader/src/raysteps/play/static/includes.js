// What a source includes before anything else stands in it: what is compiled once and kept.

/** The same as first_includes of play_page.py, which says what is compiled before the page is given out. */
export function firstIncludes(source) {
  const [first] = /^(?:[ \t]*(?:#[ \t]*include[^\n]*|\/\/[^\n]*)?\r?\n)*/.exec(source);
  const lines = first.split("\n").map((line) => line.replace(/^[ \t]+|[ \t\r]+$/g, ""));
  return lines
    .filter((line) => line.startsWith("#"))
    .map((line) => `${line}\n`)
    .join("");
}
