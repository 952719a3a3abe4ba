// The visible tests of a step: run in a program that was built, and told as the report tells them.

import { AFTER_A_STOP, data, element } from "./page-data.js";
import { Runner, whyNothing } from "./programs.js";
import { textLink } from "./reading.js";
import { printedIn, readReport } from "./report.js";

/** The functions of a source that still say that they are not written. */
function unfinished(source) {
  const code = source.replace(/\/\*.*?\*\/|\/\/[^\n]*/gs, "");
  return new Set([...code.matchAll(/RAYSTEPS_TODO\(\s*"[^"]*",\s*"([^"]*)"\s*\)/g)].map((found) => found[1]));
}

function tellTests(step, source, results) {
  const open = unfinished(source);
  const functionsOf = Object.fromEntries(step.tests.map(({ name, functions }) => [name, functions]));
  const linked = (panel) => {
    for (const room of panel.querySelectorAll("dd")) {
      const [, name, line] = /^([\w.]+):(\d+)$/.exec(room.textContent) ?? [];
      if (step.texts[name]) {
        room.replaceChildren(textLink(name, step.texts[name], line));
      }
    }
    return panel;
  };
  const isOpen = ({ name, passed }) => !passed && functionsOf[name]?.some((one) => open.has(one));
  const wrong = results.filter((one) => !one.passed && !isOpen(one));
  const waiting = results.filter(isOpen);
  const right = results.filter((one) => one.passed);
  const list = (title, some) =>
    some.length
      ? [
          make(
            "details",
            {},
            make("summary", {}, title),
            make("ul", {}, ...some.map(({ name }) => make("li", {}, name))),
          ),
        ]
      : [];
  element("play-tests").replaceChildren(
    ...wrong.map(({ name, failure, message }) =>
      linked(
        watchTest({
          name,
          message: message ?? failure?.notes ?? "",
          expected: failure?.expected,
          actual: failure?.got,
          place: failure?.where,
        }),
      ),
    ),
    ...list(
      `${waiting.length} ${waiting.length > 1 ? "tests wait" : "test waits"} for a function that is not written yet`,
      waiting,
    ),
    ...list(`${right.length} of ${results.length} tests pass`, right),
  );
}

/** Tests one program at a time. */
export class Tester {
  #runner = new Runner();
  #print;

  /** `print` hears what programs print. */
  constructor(print) {
    this.#print = print;
  }

  stop() {
    this.#runner.stop("hand");
  }

  /** Runs all tests, or each by itself where the program did not come to its end, and shows them. `source` is what was
   * compiled, `current` whether anybody still waits for it. */
  async test({ step, source, module, current }) {
    const words = ["test", "-r", "xml", "-o", "/out/report.xml"];
    const task = { module, files: {}, wanted: ["/out/report.xml"] };
    let limit = step.seconds;
    const ask = (more = []) => this.#runner.run({ ...task, words: [...words, ...more] }, limit);
    const textOf = (ran) => new TextDecoder().decode(ran.made?.["/out/report.xml"] ?? new Uint8Array());
    const reportOf = (ran) => readReport(textOf(ran));
    const together = await ask();
    limit /= together.stopped ? AFTER_A_STOP : 1;
    let results = together.code === undefined ? null : reportOf(together);
    if (results?.length !== step.tests.length) {
      results = [];
      for (const { name } of step.tests) {
        if (!current()) {
          return [];
        }
        const ran = await ask([name.replace(/([\\,["])/g, "\\$1")]);
        const [found] = (ran.code === undefined ? null : reportOf(ran)) ?? [];
        results.push(found ?? { name, passed: false, message: whyNothing(ran, "The test", data.words.endless) });
        this.#print(ran);
      }
    }
    if (current()) {
      this.#print({ ...together, stdout: `${together.stdout ?? ""}\n${printedIn(textOf(together))}` });
      tellTests(step, source, results);
    }
    return results;
  }
}
