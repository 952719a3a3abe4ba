"use strict";

/** A list of facts; those without a text are left out, and so is a list without facts. */
function watchFacts(facts) {
  const told = facts.filter(([, text]) => text);
  const rows = told.flatMap(([label, text, mono]) => [
    make("dt", {}, label),
    make("dd", {}, ...(mono ? [make("code", { class: "watch-lines" }, text)] : coded(text))),
  ]);
  return rows.length ? [make("dl", { class: "watch-facts" }, ...rows)] : [];
}

function watchPanel(tone, ...children) {
  return make("div", { class: `panel watch-panel-${tone}` }, ...children);
}

function watchName(text) {
  return make("p", { class: "watch-name" }, ...coded(text));
}

/** Lines that keep their columns: wide ones scroll in their own box. */
function watchLines(text, label) {
  return make("pre", { tabindex: 0, role: "region", "aria-label": label }, text);
}

/** The first line is a sentence, what follows are lines of the source. */
function watchMessage(message, tone) {
  const [first, ...lines] = message.replace(/^It does not build: /, "").split("\n");
  const source = lines.length ? [watchLines(lines.join("\n"), "lines of the source")] : [];
  return watchPanel(tone, make("p", {}, ...coded(first)), ...source);
}

function watchMessages(state) {
  const tone = { bad: "bad", plain: "plain" }[state.verdict.tone] ?? "warn";
  const parts = state.messages.map((message) => watchMessage(message, tone));
  if (state.log) {
    const summary = make("summary", {}, "All that the compiler said");
    parts.push(make("details", {}, summary, watchLines(state.log, "what the compiler said")));
  }
  return parts;
}

function watchDiagnosis(found) {
  const facts = [
    ["You see", found.sees],
    ["Cause", found.cause],
    ["Hint", found.hint],
    ["Or", found.alike.join("; ")],
  ];
  return watchPanel("warn", watchName(`${found.word}: ${found.title}`), ...watchFacts(facts));
}

function watchTest(test) {
  const message = test.message ? [make("p", { class: "watch-lines" }, ...coded(test.message))] : [];
  const facts = [
    ["expected", test.expected, true],
    ["got", test.actual, true],
    ["where", test.place, true],
  ];
  return watchPanel("bad", watchName(test.name), ...watchFacts(facts), ...message);
}

function watchHidden(item) {
  const facts = [
    ["given", item.given, true],
    ["expected", item.expected, true],
    ["got", item.actual, true],
    ["again", item.again, true],
  ];
  return watchPanel("bad", watchName(item.name), make("p", {}, ...coded(item.message)), ...watchFacts(facts));
}

/** A heading with the numbers, then what failed. */
function watchKind(title, items, makeOne) {
  if (!items.all) {
    return [];
  }
  const wrong = items.all - items.passed - items.waits;
  const [sign, tone] = wrong ? ["✗", "watch-bad"] : items.waits ? ["…", ""] : ["✓", "watch-good"];
  const words = `${sign} ${items.passed} of ${items.all} right${items.waits ? `, ${items.waits} wait` : ""}`;
  return [make("h2", {}, `${title}: `, make("span", { class: tone }, words)), ...items.failed.map(makeOne)];
}

/** Sentences are broken where the panel ends; only pseudocode keeps its columns. */
function watchHint(hint) {
  const inColumns = /\S {2,}\S/.test(hint.text);
  const text = inColumns ? watchLines(hint.text, "the hint") : make("p", {}, ...coded(hint.text));
  return watchPanel("plain", watchName(`Hint ${hint.level} of ${hint.of}`), text);
}

/** Everything but the pictures. */
function watchWords(state) {
  return [
    ...state.diagnoses.map(watchDiagnosis),
    ...watchMessages(state),
    ...watchKind("Tests", state.tests, watchTest),
    ...watchKind("Hidden", state.hidden, watchHidden),
    ...state.hints.map(watchHint),
  ];
}
