// What the compiler and the linker say, below the editor and at its lines.

import { data, element } from "./page-data.js";
import { linkerWords, shorten } from "./report.js";

/** What the compiler says: `{file, line, column, severity, message}`, notes behind what they belong to. */
function problemsIn(text) {
  const found = text.matchAll(/^(.+?):(\d+):(\d+): (?:fatal )?(error|warning|note): (.*)$/gm);
  return [...found].map(([, file, line, column, kind, message]) => ({
    file,
    line: Number(line),
    column: Number(column),
    severity: kind === "note" ? "info" : kind,
    message,
  }));
}

/** What an error means that many meet first. */
function otherWords({ severity, message }) {
  const start = shorten(message);
  const known = data.words.inOtherWords.find(([pattern]) => severity === "error" && new RegExp(pattern).test(start));
  return known ? [make("strong", {}, ...coded(` ${known[1]}`))] : [];
}

/** `goTo` leads to its line; none where another file has it. */
function problem(found, goTo) {
  const { file, line, severity, message } = found;
  const where = `${file.split("/").at(-1)}:${line}`;
  const place = goTo ? make("button", { type: "button", class: "play-place" }, where) : make("code", {}, where);
  if (goTo) {
    place.addEventListener("click", () => goTo(line));
  }
  return make("p", { class: `play-problem play-${severity}` }, place, ` ${severity}: ${message}`, ...otherWords(found));
}

/** Of a build of the step that is open. */
export function tellProblems(step, built, editor) {
  const room = element("play-problems");
  room.replaceChildren();
  const mine = [];
  for (const { number, text } of built.says) {
    const source = data.kit.steps[number].source;
    const problems = problemsIn(text);
    for (const one of problems) {
      const isMine = number === step.number && one.file === source;
      mine.push(...(isMine ? [one] : []));
      room.append(problem(one, isMine ? (line) => editor.goTo(line) : null));
    }
    const words = linkerWords(text, data.words);
    if (words) {
      room.append(make("p", { class: "play-problem play-error" }, words));
    } else if (!problems.length && text.trim()) {
      room.append(make("pre", { tabindex: 0 }, text.trim()));
    }
  }
  room.tabIndex = room.hasChildNodes() ? 0 : -1; // it scrolls; Tab finds nothing where nothing is said
  editor.mark(mine);
}
