"use strict";

const deskKeys = [
  ["j k", "the next or previous submission, of those that the table shows"],
  ["Enter", "opens the submission in the table that has the focus"],
  ["n", "the next one that nobody has read"],
  ["m", "the next one with the same mistake"],
  ["r", "marks as read, or not"],
  ["1 … 9", "a step; 0 is the submission as a whole"],
  ["l", "to the code; there ↑ ↓, PageUp, PageDown, Home, End go from line to line"],
  ["c", "a comment at the line; so does a click on its number. Shift + C: on the step"],
  ["p", "changes the points of the step, or of the whole"],
  ["g", "types in a regrade request"],
  ["a", "answers the next open request"],
  ["Ctrl + Enter", "saves what you type; Esc drops it"],
  ["u", "back to the table"],
  ["/", "searches the table; Enter or Esc goes on to its first row"],
  ["?", "this help"],
];

const counted = (number, noun) => `${number} ${noun}${number === 1 ? "" : "s"}`;
const deskMarks = [
  ["open", ({ open }) => open && counted(open, "open request"), "bad"],
  ["look", ({ look }) => look.filter((mark) => mark !== "open request").join(", "), "bad"],
  ["changed", ({ changed }) => changed.length && "changed", ""],
  ["comments", ({ comments }) => comments && counted(comments, "comment"), ""],
];

/** From its beginning: where it is longer than the screen, the focus on its only button would show its end. */
function openHelp() {
  document.getElementById("help").showModal();
  document.getElementById("help-title").focus();
}

class Desk {
  constructor() {
    this.rows = null;
    this.view = new DeskSubmission(document.getElementById("submission"), this);
    document.getElementById("shown").textContent = "reading the class …";
    this.room = document.getElementById("class");
    this.table = document.querySelector(".class-table");
    this.wanted = null;
  }

  // What the server says.

  async ask(place, said) {
    try {
      const options = said
        ? { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(said) }
        : {};
      const answer = await fetch(place, options);
      const isJson = answer.headers.get("Content-Type")?.startsWith("application/json");
      const told = isJson ? await answer.json() : { error: (await answer.text()).trim() };
      if (!answer.ok) {
        return { error: told.error, status: answer.status };
      }
      this.tellFiles(told.files ?? told);
      return told;
    } catch {
      return { error: "The desk does not answer: look at its terminal, and start it again where it has ended." };
    }
  }

  /** Until all files hold what was said. */
  tellFiles({ state, trouble }) {
    if (!state) {
      return;
    }
    const words = {
      written: "✓ files written",
      writing: "writing files …",
      waiting: "files wait: something else is at work there",
      failed: `files not written: ${trouble}`,
    };
    const badge = document.getElementById("files");
    badge.textContent = words[state];
    badge.className = `badge ${{ written: "good", failed: "bad" }[state] ?? "warn"}`;
    clearTimeout(this.again);
    if (state === "writing" || state === "waiting") {
      this.again = setTimeout(() => this.ask("files"), state === "writing" ? 300 : 3000);
    }
  }

  trouble(words) {
    const place = document.getElementById("trouble");
    place.hidden = !words;
    place.textContent = words;
  }

  author() {
    return document.getElementById("author").value.trim();
  }

  async say(name, said) {
    if (!said.author) {
      document.getElementById("author").focus();
      return { error: "Say who you are, above: students read who wrote something." };
    }
    const told = await this.ask(`submission/${encodeURIComponent(name)}`, said);
    if (told.status === 409) {
      const now = await this.ask(`submission/${encodeURIComponent(name)}`);
      return { error: told.error, conflict: now.error ? null : now };
    }
    if (told.error) {
      return told;
    }
    this.update(told.row);
    return { view: told };
  }

  // The table.

  facts(row) {
    return {
      ...row,
      unread: !row.read,
      asks: row.open > 0,
      look: row.look.length > 0,
      changed: row.changed.length > 0,
      late: row.days > 0,
    };
  }

  fill(element, row) {
    const link = make("a", { href: `#${row.name}` }, row.who);
    const head = make("th", { scope: "row" }, link);
    if (row.more) {
      head.append(make("small", {}, row.more));
    }
    if (!row.read) {
      head.classList.add("desk-unread");
      link.append(make("span", { class: "hidden-text" }, ", not read yet"));
    }
    const cells = row.statuses.map((status, at) => {
      const points = row.keys[at];
      return make("td", { class: status }, points === null ? "" : String(points));
    });
    const total = row.status === "graded" || row.final ? row.final : row.status;
    const marks = deskMarks.flatMap(([, words, tone]) => {
      const text = words(row);
      return text ? [make("span", { class: `desk-mark ${tone}` }, text), " "] : [];
    });
    element.replaceChildren(
      head,
      ...cells,
      make("td", { class: "total" }, total),
      make("td", { class: "marks" }, ...marks),
    );
  }

  update(row) {
    const found = this.rows.rows.find(({ facts }) => facts.name === row.name);
    if (found) {
      found.facts = this.facts(row);
      this.fill(found.element, row);
    }
  }

  heading(data) {
    const steps = data.steps.map(({ number, points, title }, at) =>
      make(
        "th",
        { scope: "col", "data-column": at + 1 },
        number,
        make("small", {}, String(points), make("span", { class: "hidden-text" }, ` points, ${title}`)),
      ),
    );
    const final = make(
      "th",
      { scope: "col", class: "total", "data-column": data.steps.length + 1 },
      data.late ? "final" : "total",
    );
    const who = make("th", { scope: "col", class: "who", "data-column": 0 }, "submission");
    this.table.tHead.rows[0].append(who, ...steps, final, make("th", { scope: "col", class: "marks" }, "marks"));
  }

  async start() {
    const data = await this.ask("class");
    if (data.error) {
      this.trouble(data.error);
      return;
    }
    this.mistakes = data.mistakes;
    document.getElementById("course").textContent = data.course;
    document.getElementById("author").value = sessionStorage.getItem("desk-author") ?? data.author;
    this.heading(data);
    const elements = data.rows.map((row) => {
      const element = document.createElement("tr");
      this.fill(element, row);
      return element;
    });
    this.table.tBodies[0].append(...elements);
    this.rows = new ClassRows(
      this.table,
      data.rows.map((row) => this.facts(row)),
    );
    makeSortable(this.table, this.rows);
    const form = document.getElementById("filters");
    document
      .getElementById("step")
      .append(...data.steps.map(({ number, title }, at) => make("option", { value: at }, `${number} ${title}`)));
    document
      .getElementById("status")
      .append(...Object.entries(data.statuses).map(([status, words]) => make("option", { value: status }, words)));
    document
      .getElementById("legend")
      .append(
        ...Object.entries(data.statuses).map(([status, words]) =>
          make("li", {}, make("span", { class: `sign ${status}` }), ` ${words}`),
        ),
      );
    this.filter = new ClassFilter(form, this.rows, data.mistakes, data.letters);
    form.hidden = false;
    this.filter.apply();
    this.follow();
  }

  /** Names in the order of the table, of the rows that it shows. */
  shown() {
    return Array.from(this.table.tBodies[0].rows)
      .filter(({ hidden }) => !hidden)
      .map((element) => this.rows.rows.find((row) => row.element === element).facts);
  }

  place(name) {
    const names = this.shown().map((facts) => facts.name);
    return names.includes(name) ? `${names.indexOf(name) + 1} of ${names.length}` : "";
  }

  mistake(step, title) {
    return this.mistakes.findIndex((one) => one.step === step && one.title === title);
  }

  // From one submission to another: the address names it.

  go(name, searching = false) {
    if (this.view.keeps()) {
      return;
    }
    this.searching = searching;
    location.hash = name ?? "";
  }

  /** The next one in the table, round its end, that is as wanted. */
  next(wanted, direction = 1) {
    const facts = this.shown();
    const current = this.wanted; // whoever presses a key twice means two
    const here = facts.findIndex(({ name }) => name === current);
    const at = here < 0 && direction < 0 ? facts.length : here;
    for (let step = 1; step <= facts.length; step += 1) {
      const found = facts[(at + direction * step + facts.length * 2) % facts.length];
      if (wanted(found) && found.name !== current) {
        this.go(found.name);
        return true;
      }
    }
    return false;
  }

  step(direction) {
    this.next(() => true, direction);
  }

  nextUnread() {
    if (!this.next(({ unread }) => unread)) {
      this.trouble("All that the table shows are read.");
    }
  }

  nextWith(mistake) {
    if (mistake === undefined || !this.next(({ mistakes }) => mistakes.includes(mistake))) {
      this.trouble("Nobody else in the table made this mistake.");
    }
  }

  /** Whether words that are not saved hold the submission open, whatever address the browser was given. */
  stays() {
    const stays = this.view.keeps();
    if (stays) {
      this.wanted = this.view.name;
      history.replaceState(null, "", `#${this.wanted}`);
    }
    return stays;
  }

  async follow() {
    if (this.stays()) {
      return;
    }
    const name = decodeURIComponent(location.hash.slice(1));
    this.wanted = name;
    this.trouble("");
    if (!name) {
      this.leave();
      return;
    }
    const view = await this.ask(`submission/${encodeURIComponent(name)}`);
    if (this.wanted !== name || this.stays()) {
      return;
    }
    if (view.error) {
      this.trouble(view.error);
      this.leave();
      return;
    }
    this.update(view.row);
    this.room.hidden = true;
    this.view.room.hidden = false;
    this.view.show(view);
    document.title = `${view.row.who} – desk`;
    window.scrollTo(0, 0);
    document.getElementById("submission-title").focus();
  }

  leave() {
    const { name } = this.view;
    this.view.room.hidden = true;
    this.view.room.replaceChildren();
    this.view.view = null;
    this.room.hidden = false;
    document.title = "Desk";
    this.filter?.apply();
    const link = this.table.querySelector(name ? `a[href="#${CSS.escape(name)}"]` : "tbody a");
    (this.searching ? document.getElementById("search") : link)?.focus();
    this.searching = false;
  }

  /** From row to row in the table. */
  move(direction) {
    const links = Array.from(this.table.querySelectorAll("tbody tr:not([hidden]) a"));
    const at = links.indexOf(document.activeElement);
    links[Math.max(0, Math.min(links.length - 1, at + direction))]?.focus();
  }

  key(event) {
    const { key, target } = event;
    if (target.id === "search" && (key === "Enter" || key === "Escape")) {
      this.move(1);
      event.preventDefault();
      return;
    }
    if (
      event.ctrlKey ||
      event.altKey ||
      event.metaKey ||
      target.closest("input:not([type=checkbox]), textarea, select, dialog")
    ) {
      return;
    }
    const isOpen = this.view.view !== null;
    const acts = {
      "?": openHelp,
      n: () => this.nextUnread(),
      j: () => (isOpen ? this.step(1) : this.move(1)),
      k: () => (isOpen ? this.step(-1) : this.move(-1)),
      u: () => this.go(null),
      "/": () => (isOpen ? this.go(null, true) : document.getElementById("search").focus()),
    };
    const act = acts[key];
    if (act) {
      act();
    } else if (!isOpen || !this.view.key(key)) {
      return;
    }
    event.preventDefault();
  }
}

function startDesk() {
  const desk = new Desk();
  document
    .getElementById("help-keys")
    .append(
      ...deskKeys.map(([keys, words]) => make("div", {}, make("dt", {}, make("kbd", {}, keys)), make("dd", {}, words))),
    );
  document.getElementById("help-open").addEventListener("click", openHelp);
  document.getElementById("author").addEventListener("input", ({ target }) => {
    sessionStorage.setItem("desk-author", target.value);
  });
  window.addEventListener("hashchange", () => desk.follow());
  window.addEventListener("beforeunload", (event) => {
    if (desk.view.hasWords()) {
      event.preventDefault();
    }
  });
  document.addEventListener("keydown", (event) => desk.key(event));
  desk.start();
}

startDesk();
