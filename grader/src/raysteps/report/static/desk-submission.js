"use strict";

const deskWhole = "";

/** One submission: its code, what the grader saw of it, and what people said. */
class DeskSubmission {
  /**
   * @param {HTMLElement} room
   * @param {{say: Function, go: Function, author: Function, nextWith: Function, place: Function}} desk
   */
  constructor(room, desk) {
    this.room = room;
    this.desk = desk;
    this.view = null;
    this.step = deskWhole;
    this.code = null;
    this.form = null;
  }

  get name() {
    return this.view?.row.name ?? null;
  }

  /** Another submission begins with what is wrong first; the same one stays where it is. */
  show(view) {
    const same = this.view !== null && this.name === view.row.name;
    const at = same && this.code ? this.code.at : 0;
    this.view = view;
    const known = this.hasTab(this.step) || this.step === deskWhole;
    if (!same && (!known || this.step === deskWhole)) {
      this.step = view.steps.find(({ code }) => code.length)?.id ?? deskWhole;
    } else if (!known) {
      this.step = deskWhole;
    }
    this.draw();
    this.room.dataset.name = this.name;
    if (this.code) {
      this.code.choose(at);
    }
  }

  current() {
    return this.view.steps.find(({ id }) => id === this.step);
  }

  threads(kind, step = this.step) {
    return this.view.threads.filter((one) => one.kind === kind && one.step === step);
  }

  hasTab(step) {
    return this.view.steps.some(({ id }) => id === step);
  }

  /** What was said of the step; with the whole also what is about a step that has no tab now. */
  talkThreads(kind) {
    return this.view.threads.filter(
      (one) => one.kind === kind && (this.hasTab(one.step) ? one.step : deskWhole) === this.step,
    );
  }

  draw() {
    this.form = null;
    const step = this.current();
    const side = step ? this.side(step) : this.whole();
    const body = step ? [this.codePart(step), side] : [side];
    this.room.replaceChildren(this.head(), this.tabs(), make("div", { class: "desk-body" }, ...body));
  }

  choose(step) {
    if (this.keeps()) {
      return;
    }
    this.step = step;
    this.draw();
    this.room.querySelector(".desk-tab[aria-pressed=true]").focus();
  }

  head() {
    const { row, late, submitted, fault, notes, look_again: again } = this.view;
    const title = make("h2", { id: "submission-title", tabindex: -1 }, row.who);
    const more = [row.more, this.desk.place(row.name), submitted && `handed in ${submitted.replace("T", " ")}`];
    const points = make("p", { class: "desk-points" }, make("strong", {}, `${row.points || "no"} points`));
    if (row.changed.length) {
      points.append(` (${this.view.automatic} by the grader)`);
    }
    if (row.final !== row.points) {
      points.append(`, ${row.final} after lateness`);
    }
    const act = (label, key, pressed, more_ = {}) =>
      makeButton(`${label} `, { "aria-keyshortcuts": key, ...more_ }, pressed);
    const buttons = [
      ["Class", "u", () => this.desk.go(null)],
      ["Previous", "k", () => this.desk.step(-1)],
      ["Next", "j", () => this.desk.step(1)],
      ["Next unread", "n", () => this.desk.nextUnread()],
    ].map(([label, key, pressed]) => {
      const button = act(label, key, pressed);
      button.append(make("kbd", { "aria-hidden": "true" }, key));
      return button;
    });
    const read = act("Read", "r", () => this.toggleRead(), { "aria-pressed": String(row.read), id: "read" });
    read.append(make("kbd", { "aria-hidden": "true" }, "r"));
    const said = [fault, ...notes, late].filter(Boolean);
    return make(
      "header",
      { class: "desk-head" },
      make("div", {}, title, make("p", { class: "muted small" }, more.filter(Boolean).join(" · "))),
      points,
      make("div", { class: "desk-buttons" }, ...buttons, read),
      ...said.map((text) => make("p", { class: "muted small desk-wide" }, text)),
      ...again.map((text) => make("p", { class: "desk-look desk-wide" }, `Look again: ${text}`)),
    );
  }

  tabs() {
    const tab = (id, words, tone, key) =>
      makeButton(
        words,
        { class: `desk-tab ${tone}`, "aria-pressed": String(id === this.step), "aria-keyshortcuts": key < 10 && key },
        () => this.choose(id),
      );
    const tabs = this.view.steps.map(({ id, number, points, max, status }) =>
      tab(id, `${number} ${status.sign} ${points} of ${max}`, status.tone, Number(number)),
    );
    tabs.forEach((button, at) => {
      const { title, status } = this.view.steps[at];
      button.append(make("span", { class: "hidden-text" }, `, ${title}: ${status.words}`));
    });
    const nav = make("nav", { class: "desk-tabs", "aria-label": "Steps" }, ...tabs);
    nav.append(tab(deskWhole, "Whole", "", 0));
    return nav;
  }

  codePart(step) {
    const at = this.threads("comment").filter(({ line, withdrawn }) => line && !withdrawn);
    const part = make("section", { class: "desk-code", "aria-labelledby": "code-title" });
    part.append(make("h3", { id: "code-title" }, make("code", {}, step.file || step.id)));
    if (step.code.length) {
      this.code = new DeskCode(
        step,
        at,
        (thread) => this.card(thread),
        (line) => this.comment(line),
      );
      part.append(this.code.element);
    } else {
      this.code = null;
      const why = step.has_code
        ? "The file is empty."
        : "No code of this step was handed in, or the kit that graded it did not keep it: grade-class with --resume does.";
      part.append(make("p", { class: "muted" }, why));
    }
    return part;
  }

  /** Points, talk and checks of a step. */
  side(step) {
    const onMistake = (title) => {
      const mistake = this.desk.mistake(step.id, title);
      return mistake >= 0 && (() => this.desk.nextWith(mistake));
    };
    const part = make("section", { class: "desk-side", "aria-label": `Step ${step.number} ${step.title}` });
    part.append(
      make("h3", {}, `${step.number} ${step.title}`),
      this.points(step),
      this.talk(),
      ...deskChecks(step, onMistake),
    );
    return part;
  }

  whole() {
    this.code = null;
    const part = make("section", { class: "desk-side", "aria-label": "The submission as a whole" });
    const [thread] = this.threads("points", deskWhole);
    const extra =
      thread && !thread.withdrawn ? `${thread.points >= 0 ? "+" : ""}${thread.points} points: ${thread.text}` : "";
    part.append(make("h3", {}, "The submission as a whole"), ...deskSaid(extra));
    if (this.view.steps.length) {
      part.append(this.pointsButton(deskWhole, "whole", "Add or take points", "p"));
    }
    part.append(...(thread ? deskHistory(thread) : []), this.talk());
    return part;
  }

  pointsButton(part, id, words, key) {
    const button = makeButton(words, { "data-part": id, ...(key ? { "aria-keyshortcuts": key } : {}) }, () =>
      this.changePoints(part),
    );
    return button;
  }

  points(step) {
    const items = [
      ...step.parts,
      { name: "", said: "all of the step", points: step.points, most: step.max, automatic: step.automatic },
    ];
    const rows = items.map(({ name, said, points, most, automatic }) => {
      const [thread] = this.threads("points").filter((one) => one.part === name);
      const changed = thread && !thread.withdrawn;
      const shown = make("td", { class: "number" }, make("strong", {}, String(points)), ` of ${most}`);
      if (Number(points) !== Number(automatic)) {
        shown.append(make("small", { class: "muted" }, ` grader: ${automatic}`));
      }
      const words = make("th", { scope: "row" }, name || "step", make("small", { class: "muted" }, ` ${said}`));
      if (changed) {
        words.append(make("p", { class: "desk-reason" }, `${thread.history.at(-1).author}: ${thread.text}`));
      }
      words.append(...(thread ? deskHistory(thread) : []));
      const button = this.pointsButton(name, name || "step", "Change", name ? "" : "p");
      button.setAttribute("aria-label", `Change the points for ${name || "the step"}`);
      return make("tr", {}, words, shown, make("td", {}, button));
    });
    const table = make("table", { class: "desk-parts" }, make("tbody", {}, ...rows));
    return make("div", { class: "scroll" }, table);
  }

  /** Comments that are at no line, and requests. */
  talk() {
    const free = this.talkThreads("comment").filter(({ line, withdrawn }) => !this.step || !line || withdrawn);
    const requests = this.talkThreads("request");
    const buttons = make(
      "div",
      { class: "desk-buttons" },
      makeButton("Comment", { id: "comment-free", "aria-keyshortcuts": "Shift+C" }, () => this.comment(0)),
      makeButton("Regrade request", { id: "request", "aria-keyshortcuts": "g" }, () => this.request()),
    );
    return make("div", { class: "desk-talk" }, buttons, ...[...requests, ...free].map((thread) => this.card(thread)));
  }

  card(thread) {
    const by = thread.history.at(-1);
    const parts = [];
    if (thread.kind === "request") {
      const state = thread.withdrawn ? "taken back" : thread.answer ? "answered" : "open";
      parts.push(
        make("p", {}, make("span", { class: `badge ${state === "open" ? "warn" : ""}` }, `request: ${state}`)),
      );
    }
    if (thread.step !== this.step) {
      parts.push(make("p", { class: "muted small" }, `On ${thread.step}, which was not graded this time.`));
    }
    parts.push(make("p", { class: "said" }, thread.text));
    if (thread.answer) {
      parts.push(make("p", { class: "said" }, make("span", { class: "muted" }, "Answer: "), thread.answer));
    }
    if (thread.since) {
      const where =
        thread.since === "gone"
          ? ` Line ${thread.then} was:`
          : thread.line !== thread.then
            ? ` It was line ${thread.then}.`
            : "";
      parts.push(make("p", { class: "desk-look" }, `The code has changed since.${where}`));
      if (thread.since === "gone") {
        parts.push(make("pre", { class: "desk-was" }, thread.was));
      }
    }
    const buttons = [];
    if (!thread.withdrawn) {
      const edit = thread.kind === "request" ? (thread.answer ? "Change the answer" : "Answer") : "Edit";
      buttons.push(makeButton(edit, { "data-edit": thread.subject }, () => this.edit(thread)));
      buttons.push(makeButton("Take back", {}, () => this.withdraw(thread)));
    }
    parts.push(
      make("p", { class: "muted small desk-by" }, `${by.author}, ${by.at} `, ...buttons),
      ...deskHistory(thread),
    );
    return make(
      "div",
      { class: `desk-card${thread.withdrawn ? " withdrawn" : ""}`, "data-subject": thread.subject },
      ...parts,
    );
  }

  // Forms: one is open at a time, below what it is about. What was typed goes only when it is saved or dropped.

  typed() {
    return JSON.stringify([...new FormData(this.form)]);
  }

  hasWords() {
    return Boolean(this.form?.isConnected) && this.typed() !== this.form.before;
  }

  /** Whether there is a form with words that are not saved; then it says so, and nothing else may take its place. */
  keeps() {
    if (!this.hasWords()) {
      return false;
    }
    this.tell(this.form, "This is not saved yet: Ctrl+Enter saves it, Esc drops it.");
    if (!this.form.contains(document.activeElement)) {
      this.form.querySelector("[data-first]").focus();
    }
    this.form.scrollIntoView({ block: "nearest" });
    return true;
  }

  tell(form, words) {
    const trouble = form.querySelector("[role=alert]");
    trouble.hidden = false;
    trouble.textContent = words;
  }

  /**
   * @param {string} title
   * @param {HTMLElement[]} fields
   * @param {() => object} said what is sent
   */
  open(title, fields, said) {
    this.cancel();
    const trouble = make("p", { class: "desk-trouble", role: "alert", hidden: true });
    const save = make("button", { type: "submit" }, "Save ", make("kbd", { "aria-hidden": "true" }, "Ctrl+Enter"));
    const cancel = makeButton("Cancel ", {}, () => this.cancel());
    cancel.append(make("kbd", { "aria-hidden": "true" }, "Esc"));
    const form = make(
      "form",
      { class: "desk-form panel", "aria-label": title },
      make("p", {}, make("strong", {}, title)),
      ...fields,
      trouble,
    );
    form.append(make("div", { class: "desk-buttons" }, save, cancel));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.send(said(), form);
    });
    form.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
        event.preventDefault();
        form.requestSubmit();
      } else if (event.key === "Escape") {
        event.stopPropagation();
        this.cancel();
      }
    });
    form.from = document.activeElement;
    this.form = form;
    form.before = this.typed();
    return form;
  }

  cancel() {
    if (this.form) {
      const { from } = this.form;
      this.form.remove();
      this.form = null;
      if (this.faster) {
        this.faster = "";
        this.show(this.view); // somebody else was faster: as it is now
        this.room.querySelector("#submission-title").focus();
      } else if (from?.isConnected) {
        from.focus();
      }
    }
  }

  put(form, after) {
    after.after(form);
    form.querySelector("[data-first]").focus();
    form.scrollIntoView({ block: "nearest" });
  }

  text(label, value, name = "text") {
    const field = make("textarea", { rows: 3, required: true, "data-first": true, name, maxlength: 20000 });
    field.value = value;
    return deskField(label, field);
  }

  async send(said, form) {
    const save = form.querySelector("button[type=submit]");
    if (save.disabled) {
      return; // it is on its way
    }
    const at = this.code ? this.code.at : 0;
    const inCode = form.closest(".desk-lines") !== null;
    const hold = (isHeld) => {
      save.disabled = isHeld;
      form.querySelectorAll("input, textarea").forEach((field) => {
        field.readOnly = isHeld;
      });
    };
    hold(true);
    const { view, error, conflict } = await this.desk.say(this.name, said);
    hold(false);
    if (error) {
      this.tell(form, conflict ? `${error}. ${this.told(conflict, said)}` : error);
    } else if (this.renew(view, form)) {
      if (inCode && this.code) {
        this.code.focus(at);
      } else {
        this.room.querySelector("#submission-title").focus();
      }
    }
  }

  /** After something was said, by this form or by none: draws it, unless somebody went on, or types into a form. */
  renew(view, form = null) {
    if (view.row.name !== this.name) {
      return false;
    }
    if (this.form !== form && this.hasWords()) {
      this.view = view;
      return false;
    }
    this.faster = "";
    this.show(view);
    return true;
  }

  /** After somebody else was faster: what they wrote; the next Save replaces it. */
  told(view, said) {
    const now = view.threads.find(
      ({ subject }) => subject === said.subject || subject === `points/${said.step}/${said.part}`,
    );
    this.view = view;
    this.faster = now?.after ?? "";
    const last = now?.history.at(-1);
    return last
      ? `Now it is: ${last.points} ${last.text} ${last.answer} (${last.author}). Save again to replace that.`
      : "";
  }

  said(kind, more) {
    return {
      kind,
      author: this.desk.author(),
      step: this.step,
      ...more,
      ...(this.faster ? { after: this.faster } : {}),
    };
  }

  comment(line) {
    if (this.keeps()) {
      return;
    }
    this.faster = "";
    const where = line
      ? `Comment at line ${line}`
      : this.step
        ? `Comment on step ${this.step.slice(0, 2)}`
        : "Comment on all";
    const field = this.text("Comment", "");
    const form = this.open(where, [field], () =>
      this.said("comment", { line, text: field.querySelector("textarea").value }),
    );
    if (line) {
      this.code.place(line, form);
      this.put(form, form.previousElementSibling);
    } else {
      this.put(form, this.room.querySelector(".desk-talk .desk-buttons"));
    }
  }

  request() {
    if (this.keeps()) {
      return;
    }
    this.faster = "";
    const field = this.text("What the student asks", "");
    const form = this.open("Regrade request", [field], () =>
      this.said("request", { text: field.querySelector("textarea").value }),
    );
    this.put(form, this.room.querySelector(".desk-talk .desk-buttons"));
  }

  edit(thread) {
    if (this.keeps()) {
      return;
    }
    this.faster = "";
    const isRequest = thread.kind === "request";
    const field = this.text(isRequest ? "Answer" : "Comment", isRequest ? thread.answer : thread.text);
    const written = () => field.querySelector("textarea").value;
    const form = this.open(isRequest ? "Answer" : "Edit the comment", [field], () =>
      this.said(thread.kind, {
        subject: thread.subject,
        after: thread.after,
        ...(this.faster ? { after: this.faster } : {}),
        text: isRequest ? thread.text : written(),
        answer: isRequest ? written() : "",
      }),
    );
    this.put(form, this.room.querySelector(`[data-subject="${CSS.escape(thread.subject)}"]`).lastElementChild);
  }

  changePoints(part) {
    if (this.keeps()) {
      return;
    }
    this.faster = "";
    const step = this.current();
    const item = step ? (step.parts.find(({ name }) => name === part) ?? step) : null;
    const [thread] = this.threads("points").filter((one) => one.part === part);
    const isChanged = thread && !thread.withdrawn;
    const number = make("input", { type: "number", step: "any", required: true, "data-first": true, name: "points" });
    number.value = String(item ? item.points : isChanged ? thread.points : "");
    const reason = this.text("Reason, which the student reads", isChanged ? thread.text : "");
    reason.querySelector("textarea").removeAttribute("data-first");
    const most = item
      ? ` of ${item.most ?? item.max}, ${item.automatic} by the grader`
      : " more (or less, with a minus)";
    const title = `Points for ${part ? `${part} of step ${step.number}` : step ? `step ${step.number}` : "the submission as a whole"}`;
    const said = (withdrawn) =>
      this.said("points", {
        part,
        after: thread?.after ?? "",
        ...(this.faster ? { after: this.faster } : {}),
        points: Number(withdrawn ? thread.points : number.value),
        text: reason.querySelector("textarea").value,
        withdrawn,
      });
    const form = this.open(
      title,
      [deskField("Points", number), make("p", { class: "muted small" }, most), reason],
      () => said(false),
    );
    if (isChanged) {
      const back = makeButton("Take the change back", {}, () => {
        if (form.reportValidity()) {
          this.send(said(true), form);
        }
      });
      form.lastElementChild.append(back);
    }
    const id = part || (step ? "step" : "whole");
    const button = this.room.querySelector(`[data-part="${id}"]`);
    this.put(form, button.closest("table") ?? button);
    number.select();
  }

  async withdraw(thread) {
    if (this.keeps()) {
      return;
    }
    this.faster = "";
    const { subject, after, text, answer, kind } = thread;
    const said = this.said(kind, { subject, after, text, answer, withdrawn: true });
    const { view, error, conflict } = await this.desk.say(this.name, said);
    this.desk.trouble(error ?? "");
    const now = view ?? conflict;
    if (now && this.renew(now)) {
      this.room.querySelector("#submission-title").focus();
    }
  }

  async toggleRead() {
    if (this.keeps()) {
      return;
    }
    const { view, error } = await this.desk.say(this.name, this.said("read", { withdrawn: this.view.row.read }));
    if (error) {
      this.desk.trouble(error);
    } else if (this.renew(view)) {
      this.room.querySelector("#read").focus();
    }
  }

  /** @returns {boolean} whether the key meant something here */
  key(key) {
    const step = /^[0-9]$/.test(key) ? this.view.steps.find(({ number }) => Number(number) === Number(key)) : null;
    if (key === "0" || step) {
      this.choose(step ? step.id : deskWhole);
    } else if (key === "c" && this.code) {
      this.comment(this.code.at + 1);
    } else if (key === "c" || key === "C") {
      this.comment(0);
    } else if (key === "p" && this.view.steps.length) {
      this.changePoints("");
    } else if (key === "g") {
      this.request();
    } else if (key === "a") {
      const open = this.view.threads.find(({ kind, answer, withdrawn }) => kind === "request" && !answer && !withdrawn);
      if (open) {
        this.choose(this.hasTab(open.step) ? open.step : deskWhole);
        this.edit(open);
      }
    } else if (key === "l") {
      this.code?.focus();
    } else if (key === "m") {
      const [mistake] = this.view.row.mistakes.filter((at) => this.desk.mistakes[at]?.step === this.step);
      this.desk.nextWith(mistake ?? this.view.row.mistakes[0]);
    } else if (key === "r") {
      this.toggleRead();
    } else {
      return false;
    }
    return true;
  }
}
