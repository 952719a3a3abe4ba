// Reads the XML report of the visible tests, and says what was expected and what came instead in the words of the
// grader: this follows toolchain/catch2.py line by line, and a test compares the two.

const BINARY = /[()[\]{}]|,\s|\s(?:==|!=|<=|>=|<|>)\s/g;
const FLOAT = /(?<![\w.])(\d[\d.]{0,40}(?:e[-+]\d{1,4})?|nan|inf)f(?!\w)/g;
const LITERAL = /(?<![\w.])(\d[\d.]{0,40}?(?:e[-+]?\d{1,4})?)(?:\.0)?F(?!\w)/g;
const QUALIFIER = /\b(?:glm|std)::(?:vector<\w{1,40}>(?=\{))?/g;
const CAST = /static_cast<[\w:]{1,40}>\(([\w.]{1,40})\)/g;
const HEX = / \(0x[0-9a-f]{1,16}\)/g;
const MATCHED = " is expected to ";
const VERBS = { "be ": "= ", "have ": "has ", "point ": "points " };
const TROUBLE = { Exception: "threw: ", FatalErrorCondition: "crashed: " };
const MAX_LETTERS = 2000;

export function shorten(text, limit = MAX_LETTERS) {
  return text.length <= limit ? text : `${text.slice(0, limit)} ...`;
}

/** What the linker says, in the words of the grader, or nothing where it says something else. What only the student's
 * own objects ask for is a helper; all else is a function of a contract. */
export function linkerWords(said, words) {
  const twice = /duplicate symbol: (.+)/.exec(said);
  if (twice) {
    return words.twice.replace("{}", () => shorten(twice[1], 200));
  }
  const missed = [...said.matchAll(/error: ([^\n]+): undefined symbol: ([^\n]+)/g)];
  const asked = missed.filter(([, object]) => !object.includes("/own-"));
  const names = new Set(
    (asked.length ? asked : missed).map(([, , name]) => asInAHeader(name, words).replaceAll("raysteps::", "")),
  );
  const shown = [...names].slice(0, asked.length ? names.size : 5).map((name) => shorten(name, 200));
  return sentenceOf(shown, asked.length ? words.missing : words.undefined);
}

/** One of two sentences, about one name or about several; nothing where there is none. */
export function sentenceOf(names, [one, several]) {
  const [last, ...before] = [...names].reverse();
  return before.length
    ? several.replace("{} and {}", () => `${before.reverse().join(", ")} and ${last}`)
    : last && one.replace("{}", () => last);
}

/** A name as a header writes it. The patterns are Python's, where \1 is what $1 is here. */
function asInAHeader(name, words) {
  const written = (text, [pattern, plain]) => text.replace(new RegExp(pattern, "g"), plain.replaceAll("\\", "$"));
  return words.asInAHeader.reduce(written, name);
}

function textOf(element) {
  return element ? shorten(element.textContent.trim()) : "";
}

function value(text) {
  return text.trim().replace(FLOAT, "$1").replace(HEX, "");
}

function nameOf(text) {
  return text.trim().replace(QUALIFIER, "").replace(CAST, "$1").replace(LITERAL, "$1");
}

function note(text) {
  const at = text.indexOf(" := ");
  return at < 0 ? text : text.slice(0, at + 4) + value(text.slice(at + 4));
}

/** The commas and comparisons that stand in no brackets. */
function marks(text) {
  const found = [];
  let depth = 0;
  for (const mark of text.matchAll(BINARY)) {
    if ("([{".includes(mark[0])) {
      depth++;
    } else if (")]}".includes(mark[0])) {
      depth--;
    } else if (depth === 0) {
      found.push(mark);
    }
  }
  return found;
}

function split(text) {
  const found = marks(text).find((mark) => mark[0][0] !== ",");
  return found ? [text.slice(0, found.index), found[0].trim(), text.slice(found.index + found[0].length)] : null;
}

function ofMatcher(original, expanded) {
  const at = expanded.lastIndexOf(MATCHED);
  if (at < 0) {
    return null;
  }
  const got = expanded.slice(0, at);
  let wanted = expanded.slice(at + MATCHED.length);
  const commas = marks(original).filter((mark) => mark[0][0] === ",");
  const name = commas.length ? original.slice(0, commas.at(-1).index).trim() : original;
  for (const [verb, said] of Object.entries(VERBS)) {
    if (wanted.startsWith(verb)) {
      wanted = said + wanted.slice(verb.length);
    }
  }
  return [`${name} ${value(wanted)}`, `${name} = ${value(got)}`];
}

function child(element, name) {
  return [...element.children].find((one) => one.tagName === name) ?? null;
}

function compared(element) {
  const original = nameOf(textOf(child(element, "Original")));
  const expanded = textOf(child(element, "Expanded"));
  const matched = ofMatcher(original, expanded);
  if (matched) {
    return matched;
  }
  const asked = split(original);
  const values = split(expanded);
  if (asked && values && asked[1] === values[1]) {
    const sign = asked[1] === "==" ? "=" : asked[1];
    return [`${asked[0]} ${sign} ${value(values[2])}`, `${asked[0]} = ${value(values[0])}`];
  }
  const negated = /^!\((.+)\)$/s.exec(original);
  if (negated && ["!true", "!(true)"].includes(expanded)) {
    return [`${negated[1]} = false`, `${negated[1]} = true`];
  }
  if (["false", "true"].includes(expanded)) {
    return [`${original} = ${expanded === "false"}`, `${original} = ${expanded}`];
  }
  return [original, value(expanded)];
}

function location(element) {
  const name = (element.getAttribute("filename") ?? "").replaceAll("\\", "/").split("/").at(-1);
  return name ? `${name}:${element.getAttribute("line") ?? ""}` : "";
}

function failureOf(element, notes) {
  const where = location(element);
  if (element.tagName === "Expression" && element.getAttribute("success") === "false") {
    const problem = child(element, "Exception") ?? child(element, "FatalErrorCondition");
    let [expected, got] = compared(element);
    if (problem) {
      expected = nameOf(textOf(child(element, "Original")));
      got = TROUBLE[problem.tagName] + textOf(problem);
    }
    return { expected, got, where, notes: notes.join("\n") };
  }
  if (element.tagName === "Failure") {
    return { expected: "", got: "", where, notes: [...notes, textOf(element)].join("\n") };
  }
  if (element.tagName in TROUBLE) {
    const got = TROUBLE[element.tagName] + textOf(element);
    return { expected: "the test comes to its end", got, where, notes: notes.join("\n") };
  }
  return null;
}

function firstFailure(room, sections = []) {
  let notes = [...sections];
  for (const element of room.children) {
    if (["Info", "Warning"].includes(element.tagName)) {
      notes.push(note(textOf(element)));
      continue;
    }
    const found =
      element.tagName === "Section"
        ? firstFailure(element, [...sections, element.getAttribute("name") ?? ""])
        : failureOf(element, notes);
    if (found) {
      return found;
    }
    if (element.tagName === "Expression") {
      notes = [...sections];
    }
  }
  return null;
}

function outcome(element) {
  const passed = child(element, "OverallResult")?.getAttribute("success") === "true";
  const failure = passed ? null : firstFailure(element);
  if (failure && !/^\w+_test\.cpp:/.test(failure.where)) {
    failure.where = [location(element), failure.where].filter(Boolean).join(", fails in ");
  }
  return { name: element.getAttribute("name") ?? "", passed, failure };
}

/** What a step wrote into the streams that Catch2 takes to itself while a test runs; a crash leaves no report. */
export function printedIn(xml) {
  if (!xml) {
    return "";
  }
  const root = new DOMParser().parseFromString(xml, "application/xml");
  return [...root.querySelectorAll("StdOut, StdErr")].map((room) => room.textContent.trim()).join("\n");
}

/**
 * The test cases of a complete report, or nothing where it was cut short.
 * @param {string} xml
 */
export function readReport(xml) {
  const root = new DOMParser().parseFromString(xml, "application/xml").documentElement;
  const totals = root.tagName.startsWith("Catch") ? child(root, "OverallResultsCases") : null;
  if (!totals) {
    return null;
  }
  const groups = [root, ...[...root.children].filter((one) => one.tagName === "Group")];
  return groups.flatMap((room) => [...room.children].filter((one) => one.tagName === "TestCase")).map(outcome);
}
