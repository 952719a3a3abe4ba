"use strict";

/** A list of facts; those without a text are left out. */
function watchFacts(facts) {
  const list = make("dl", { class: "watch-facts" });
  for (const [label, text, mono] of facts) {
    if (text) {
      list.append(make("dt", {}, label), make("dd", {}, mono ? make("code", { class: "watch-lines" }, text) : text));
    }
  }
  return list;
}

function watchPanel(tone, ...children) {
  return make("div", { class: `panel watch-panel-${tone}` }, ...children);
}

function watchName(text) {
  return make("p", { class: "watch-name" }, text);
}

/** @param {{message: string, log: string, tone: string}} build */
function watchMessages(state) {
  const parts = [];
  for (const message of state.messages) {
    const [first, ...lines] = message.split("\n");
    const tone = state.verdict.tone === "plain" ? "plain" : "warn";
    parts.push(watchPanel(lines.length ? "bad" : tone, make("p", {}, first), ...(lines.length ? [make("pre", {}, lines.join("\n"))] : [])));
  }
  if (state.log) {
    parts.push(make("details", {}, make("summary", {}, "All that the compiler said"), make("pre", {}, state.log)));
  }
  return parts;
}

function watchDiagnosis(found) {
  const facts = [["You see", found.sees], ["Cause", found.cause], ["Hint", found.hint], ["Or", found.alike.join("; ")]];
  return watchPanel("warn", watchName(`${found.word}: ${found.title}`), watchFacts(facts));
}

function watchTest(test) {
  const message = test.message ? [make("p", { class: "watch-lines" }, test.message)] : [];
  const facts = [["expected", test.expected, true], ["actual", test.actual, true], ["where", test.place, true]];
  return watchPanel("bad", watchName(test.name), watchFacts(facts), ...message);
}

function watchHidden(item) {
  const facts = [
    ["given", item.given, true], ["expected", item.expected, true], ["actual", item.actual, true], ["again", item.again, true],
  ];
  return watchPanel("bad", watchName(item.name), make("p", {}, item.message), watchFacts(facts));
}

/** A heading with the numbers, then what failed. */
function watchKind(title, items, makeOne) {
  if (!items.all) {
    return [];
  }
  const right = items.passed === items.all;
  const sign = make("span", { class: right ? "watch-good" : "watch-bad" }, `${right ? "✓" : "✗"} ${items.passed} of ${items.all}`);
  return [make("h2", {}, `${title}: `, sign), ...items.failed.map(makeOne)];
}

function watchHint(hint) {
  return watchPanel("plain", watchName(`Hint ${hint.level} of ${hint.of}`), make("p", { class: "watch-lines" }, hint.text));
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
