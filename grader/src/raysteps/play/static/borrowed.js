// Functions that a step's manifest bars, since they do what it is about: told before the step is linked.

import { sentenceOf } from "./report.js";

const NO_CODE = /\/\*.*?\*\/|\/\/[^\n]*|"(?:\\.|[^"\\\n])*"/gs;

/** Line and column where the first of these names is mentioned, the beginning of the source where none is. */
function placeOf(names, source) {
  const code = source.replace(NO_CODE, (left) => left.replace(/[^\n]/g, " "));
  const at = Math.max(0, code.search(new RegExp(`\\b(?:${names.join("|")})\\b`)));
  const lines = code.slice(0, at).split("\n");
  return `${lines.length}:${lines.at(-1).length + 1}`;
}

/** Errors, as the compiler writes them, where the step asks for such functions; else nothing. `asked`: the linker's
 * names of all that its object asks for. */
export function borrowedWords({ barred, source: path }, asked, source) {
  const isAsked = (pattern) => asked.some((name) => new RegExp(pattern).test(name));
  return barred
    .map(({ symbols, words }) => {
      const names = Object.keys(symbols).filter((name) => isAsked(symbols[name]));
      return names.length ? `${path}:${placeOf(names, source)}: error: ${sentenceOf(names, words)}\n` : "";
    })
    .join("");
}
