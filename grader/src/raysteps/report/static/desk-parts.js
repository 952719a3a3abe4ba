"use strict";

/** A labelled field of a form. */
function deskField(label, field) {
  return make("label", { class: "desk-field" }, label, " ", field);
}

function deskFacts(pairs) {
  const rows = pairs.filter(([, text]) => text);
  return rows.length
    ? [
        make(
          "dl",
          { class: "facts" },
          ...rows.map(([name, text]) => make("div", {}, make("dt", {}, name), make("dd", {}, ...coded(text)))),
        ),
      ]
    : [];
}

function deskCheck(title, ...children) {
  return make("div", { class: "check" }, make("p", {}, make("strong", {}, title)), ...children);
}

function deskSaid(text) {
  return text ? [make("p", { class: "said" }, ...coded(text))] : [];
}

/** A message: its sentences, and its lines of code, which keep their columns. */
function deskMessage(blocks) {
  return blocks.flatMap(([isCode, text]) =>
    isCode ? make("pre", { class: "log", tabindex: "0" }, text) : deskSaid(text),
  );
}

/** What explains a wrong step; a known mistake leads to the next one who made it. */
function deskDiagnosis(found, onMistake) {
  const parts = [make("p", { class: "cause" }, make("strong", {}, found.sure), " ", ...coded(found.title))];
  parts.push(...deskFacts(found.lines));
  if (onMistake) {
    parts.push(makeButton("Next with this mistake", { "aria-keyshortcuts": "m" }, onMistake));
  }
  return make("div", { class: "diagnosis" }, ...parts);
}

function deskTest(test) {
  return deskCheck(
    `✗ ${test.name}`,
    ...deskFacts([
      ["Expected", test.expression],
      ["Got", test.expanded],
      ["Where", test.location],
    ]),
    ...deskSaid(test.message),
  );
}

function deskHidden(item) {
  return deskCheck(`✗ ${item.name}, ${item.percent} of its points`, ...deskSaid(item.message), ...deskFacts(item.case));
}

function deskPicture(image) {
  const sides = [
    ["reference", image.shown.pictures.reference],
    ["the student's", image.shown.pictures.mine],
  ].filter(([, side]) => side);
  const figures = sides.map(([who, { src, width, height }]) =>
    make(
      "figure",
      {},
      make("img", { src, width, height, alt: `${image.name}, ${who}` }),
      make("figcaption", { class: "muted small" }, who),
    ),
  );
  const words = image.message || (image.facts.length ? `${image.facts.join("; ")}.` : "");
  const title = make("p", {}, make("strong", {}, `${image.passed ? "✓" : image.waits ? "…" : "✗"} ${image.name}`));
  return make(
    "div",
    { class: "desk-picture" },
    title,
    ...deskSaid(words),
    make("div", { class: "desk-pair" }, ...figures),
  );
}

function deskFolded(title, ...children) {
  return make("details", {}, make("summary", {}, title), ...children);
}

function deskList(names) {
  return make("ul", { class: "passed" }, ...names.map((name) => make("li", {}, name)));
}

/** Tests, hidden part, pictures and messages of a step, what is wrong first. */
function deskChecks(step, onMistake) {
  const parts = step.messages.flatMap(deskMessage);
  step.diagnoses.forEach((found) => {
    const title = found.title;
    parts.push(deskDiagnosis(found, onMistake(title)));
  });
  for (const [title, items, makeOne] of [
    ["Tests", step.tests, deskTest],
    ["Hidden", step.hidden, deskHidden],
  ]) {
    if (items.length) {
      const right = items.filter(({ passed }) => passed);
      parts.push(make("h4", {}, `${title}: ${right.length} of ${items.length} right`));
      parts.push(...items.filter(({ passed }) => !passed).map(makeOne));
      if (right.length) {
        parts.push(deskFolded("Those that are right", deskList(right.map(({ name }) => name))));
      }
    }
  }
  if (step.images.length) {
    parts.push(make("h4", {}, "Pictures"));
    parts.push(...[...step.images].sort((a, b) => a.passed - b.passed).map(deskPicture));
  }
  if (step.build_log) {
    const log = make("pre", { tabindex: 0, role: "region", "aria-label": "Build messages" }, step.build_log);
    const shown = deskFolded("Build messages", log);
    shown.open = step.status.id === "does-not-build";
    parts.push(shown);
  }
  return parts;
}

/** Who said what and when, and what was said before. */
function deskHistory(thread) {
  const entries = thread.history.map(({ author, at, text, answer, points, withdrawn }) => {
    const what = withdrawn ? "taken back" : points;
    return make(
      "li",
      {},
      `${at} ${author}: `,
      what ? make("b", {}, `${what} `) : "",
      text,
      answer ? ` — ${answer}` : "",
    );
  });
  return entries.length > 1 || thread.withdrawn
    ? [deskFolded("History", make("ol", { class: "desk-history" }, ...entries))]
    : [];
}
