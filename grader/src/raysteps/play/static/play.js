// The page to work in: chooses a step, keeps its source, and after each save compiles it, runs its tests and draws.

import { Editor } from "./editor.js";
import { Figures } from "./figures.js";
import { DiskFolder } from "./folder.js";
import { Inside } from "./inside.js";
import { compareEstimates, readEstimates } from "./noise.js";
import { compare, draw, readImage, readPpm } from "./pictures.js";
import { Compiler, Runner, whyNothing } from "./programs.js";
import { openTexts, textLink } from "./reading.js";
import { linkerWords, printedIn, readReport } from "./report.js";
import { Turn, textsIn, Work, zipOf } from "./work.js";

const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const COMPILE_SECONDS = 60;
const ESTIMATES = ["--estimates", "/out/estimates"]; // of a noisy picture
const AFTER_A_STOP = 4; // once a program of a step has hung, the next ones get so much less time
const KEEP_AFTER = 300; // milliseconds without a key
const SOON = 3000; // milliseconds until a service worker is there, or the page begins without it
const turnOf = (step) => `raysteps-play ${step.id}`; // of the tab that writes it
const replaced = (step) => `${step.id} before its reset`; // what may be brought back, by this name in the work

/** The functions of a source that still say that they are not written. */
function unfinished(source) {
  const code = source.replace(/\/\*.*?\*\/|\/\/[^\n]*/gs, "");
  return new Set([...code.matchAll(/RAYSTEPS_TODO\(\s*"[^"]*",\s*"([^"]*)"\s*\)/g)].map((found) => found[1]));
}

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

/** Where the page is published, a service worker keeps its files. */
async function keepFiles() {
  const workers = navigator.serviceWorker; // on safe addresses only
  if (!workers || !("published" in document.documentElement.dataset)) {
    return;
  }
  try {
    await workers.register("offline.js", { updateViaCache: "none" });
    if (!workers.controller) {
      await new Promise((resolve) => {
        workers.addEventListener("controllerchange", resolve, { once: true });
        setTimeout(resolve, SOON);
      });
    }
  } catch {
    // a browser that keeps nothing, as in a private window: then all is loaded each time
  }
}

class Page {
  #work;
  #turn = new Turn();
  #isMine = false; // whether this tab writes the step
  #step = null;
  #editor;
  #compiler;
  #tester = new Runner();
  #painter = new Runner();
  #figures = new Figures("It waits for your first build: write the functions, then press Run.");
  #inside = null;
  #disk = null;
  #keepTimer = 0;
  #kept = ""; // the text that needs no keeping
  #run = 0; // counts runs: what an older one finds is not shown
  #files = new Map();

  async start() {
    await keepFiles(); // those that come next, too
    this.#work = await Work.open("raysteps-play");
    this.#disk = new DiskFolder(this.#work);
    this.#editor = new Editor(element("play-editor"), "Source of the step", () => this.#changed());
    this.#compiler = new Compiler(data.kit, (part) => this.#loading(part));
    this.#inside = new Inside(this.#compiler, data.words.endless);
    for (const step of data.steps) {
      element("play-step").append(new Option(`${step.number} ${step.title}`, step.number));
    }
    element("play-step").addEventListener("change", (event) => {
      location.hash = event.target.value;
    });
    addEventListener("hashchange", () => this.#open().catch((error) => this.tellFault(error)));
    addEventListener("pagehide", () => this.#keep());
    element("play-run").addEventListener("click", () => this.run());
    element("play-stop").addEventListener("click", () => this.stop());
    element("play-save").addEventListener("click", () => this.#saveZip());
    element("play-load").addEventListener("click", () => element("play-zip").click());
    element("play-zip").addEventListener("change", (event) => this.#openZip(event.target));
    element("play-folder").addEventListener("click", () => this.#link());
    element("play-theirs").addEventListener("click", () => this.#settle(true));
    element("play-ours").addEventListener("click", () => this.#settle(false));
    addEventListener("focus", async () => (await this.#sync(false)) && this.run());
    element("play-next").addEventListener("click", () => {
      location.hash = this.#next.number;
    });
    element("play-here").addEventListener("click", () => this.#writeHere());
    element("play-hint").addEventListener("click", () => this.#hint());
    element("play-reset").addEventListener("click", () => element("play-really").showModal());
    element("play-really").addEventListener("close", (event) => {
      if (event.target.returnValue === "reset") {
        this.#reset();
      }
    });
    element("play-back").addEventListener("click", () => this.#bringBack());
    openTexts((error) => this.tellFault(error));
    addEventListener("keydown", (event) => {
      if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
        event.preventDefault();
        this.run();
      }
    });
    if (DiskFolder.isThere()) {
      await this.#disk.reopen();
      this.#tellFolder();
    }
    await this.#open();
    await this.run();
  }

  // What is shown, and kept.

  async #open() {
    const chosen = () => data.steps.find((step) => step.number === location.hash.slice(1)) ?? data.steps[0];
    const wanted = chosen();
    if (wanted === this.#step) {
      return;
    }
    const handout = await (await fetch(`steps/${wanted.number}.html`)).text();
    await this.#keep(); // before another tab may have it
    const isMine = await this.#turn.take(turnOf(wanted), (now) => this.#changeTurn(now));
    const source = (await this.#work.read(wanted.id)) ?? wanted.stub;
    const old = await this.#work.read(replaced(wanted));
    await this.#keep();
    if (wanted !== chosen() || wanted === this.#step) {
      return; // another one was chosen while this one was read
    }
    const before = this.#step;
    this.stop();
    this.#step = wanted; // and its text with it, without a pause: what is kept is always the step's own
    this.#show(source, isMine);
    element("play-next").hidden = element("play-stale").hidden = true;
    element("play-step").value = wanted.number;
    document.title = `${wanted.number} ${wanted.title} · Raysteps`;
    element("play-file").textContent = wanted.path;
    const texts = Object.entries(wanted.texts).map(([name, place]) => textLink(name, place));
    element("play-texts").replaceChildren(...texts.flatMap((link) => [" ", link]));
    element("play-handout").innerHTML = handout;
    element("play-handout").scrollTop = 0;
    this.#figures.open(wanted.number, element("play-handout"));
    element("play-hint").disabled = !wanted.hints.length;
    for (const room of ["play-first", "play-pictures", "play-tests", "play-problems", "play-hints"]) {
      element(room).replaceChildren();
    }
    element("play-console").textContent = "";
    this.#offer(old);
    await this.#sync(false);
    if (before) {
      await this.run();
    }
  }

  get #next() {
    return data.steps[data.steps.indexOf(this.#step) + 1];
  }

  /** The text of the step, which can be changed if this tab is the one that writes it. */
  #show(source, isMine) {
    this.#isMine = isMine;
    this.#kept = source;
    this.#editor.load(source, this.#step.names, !isMine);
    element("play-elsewhere").hidden = isMine;
    for (const room of ["play-reset", "play-back", "play-load"]) {
      element(room).disabled = !isMine;
    }
  }

  /** Another tab took the step, or gave it back. */
  async #changeTurn(isMine) {
    const step = this.#step;
    const source = isMine ? ((await this.#work.read(step.id)) ?? step.stub) : this.#editor.text;
    if (step === this.#step) {
      this.#show(source, isMine);
    }
  }

  async #writeHere() {
    const step = this.#step;
    const isMine = await this.#turn.take(turnOf(step), (now) => this.#changeTurn(now), true);
    if (step === this.#step) {
      await this.#changeTurn(isMine);
      this.#editor.focus(); // the button is gone
    }
  }

  #changed() {
    clearTimeout(this.#keepTimer);
    element("play-kept").textContent = "";
    this.#keepTimer = setTimeout(() => this.#keep(), KEEP_AFTER);
  }

  async #keep() {
    clearTimeout(this.#keepTimer);
    const { text } = this.#editor;
    if (this.#step && this.#isMine && text !== this.#kept) {
      this.#kept = text;
      await this.#work.write(this.#step.id, text);
      element("play-kept").textContent = "Kept in this browser.";
    }
  }

  async #sourceOf(step) {
    return step === this.#step ? this.#editor.text : ((await this.#work.read(step.id)) ?? step.stub);
  }

  /** A text that was replaced. */
  #offer(old) {
    element("play-back").hidden = !old || old === this.#step.stub;
  }

  async #reset() {
    const step = this.#step;
    const old = this.#editor.text;
    if (old === step.stub) {
      return; // what was replaced before can still be brought back
    }
    await this.#work.write(replaced(step), old);
    if (step !== this.#step) {
      return;
    }
    this.#show(step.stub, true);
    this.#offer(old);
    await this.#work.forget(step.id);
    await this.run();
  }

  /** And what stands there now can be brought back in its place. */
  async #bringBack() {
    const step = this.#step;
    const text = await this.#work.read(replaced(step));
    if (step !== this.#step) {
      return;
    }
    const old = this.#editor.text;
    this.#show(text, true);
    this.#editor.focus(); // the button may be gone
    this.#offer(old);
    await this.#work.write(step.id, text);
    await this.#work.write(replaced(step), old);
    await this.run();
  }

  async #saveZip() {
    await this.#keep();
    const texts = {};
    for (const step of data.steps) {
      const text = await this.#work.read(step.id);
      if (text) {
        texts[step.path] = text;
      }
    }
    const link = make("a", { href: URL.createObjectURL(zipOf(texts)), download: "my-steps.zip" });
    link.click();
    URL.revokeObjectURL(link.href);
  }

  /** What was saved, in place of what is kept; that can be brought back. */
  async #openZip(input) {
    const [zip] = input.files;
    input.value = "";
    let texts = {};
    try {
      texts = await textsIn(zip);
    } catch {
      this.#say("bad", `${zip.name} cannot be read. Expected a zip that this page saved, or one that you hand in.`);
      return;
    }
    await this.#keep();
    const [opened, left] = [[], []];
    for (const step of data.steps) {
      const file = step.path.split("/").at(-1);
      const paths = Object.keys(texts);
      const path =
        paths.find((one) => `/${one}`.endsWith(`/${step.path}`)) ?? paths.find((one) => one.split("/").at(-1) === file);
      if (path === undefined) {
        continue;
      }
      if (step !== this.#step && !(await Turn.isFree(turnOf(step)))) {
        left.push(step.number);
        continue;
      }
      const old = await this.#work.read(step.id);
      if (old && old !== texts[path]) {
        await this.#work.write(replaced(step), old);
      }
      await this.#work.write(step.id, texts[path]);
      opened.push(step.number);
    }
    if (opened.includes(this.#step.number)) {
      this.#show(await this.#work.read(this.#step.id), this.#isMine);
      this.#offer(await this.#work.read(replaced(this.#step)));
    }
    await this.run();
    const elsewhere = left.length ? ` Open in another tab, and left as they are: ${left.join(", ")}.` : "";
    const found = opened.length ? `taken from it: step ${opened.join(", ")}` : "it holds no file of a step";
    element("play-kept").textContent = `${zip.name}: ${found}.${elsewhere}`;
  }

  // A folder on disk.

  #tellFolder() {
    const { name, isLinked } = this.#disk;
    const button = element("play-folder");
    button.hidden = false;
    button.textContent = isLinked ? `Unlink ${name}` : name ? `Go on with ${name}` : "Link a folder";
    if (!isLinked) {
      element("play-both").hidden = true;
    }
  }

  /** The button: takes a folder, goes on with the one of the last visit, or leaves it. */
  async #link() {
    try {
      if (this.#disk.isLinked) {
        await this.#disk.forget(data.steps);
      } else if (this.#disk.name) {
        await this.#disk.reopen(true);
      } else {
        await this.#disk.choose(data.steps);
      }
    } catch (error) {
      if (error.name !== "AbortError") {
        element("play-kept").textContent = `The folder cannot be linked: ${error.message}`;
      }
    }
    this.#tellFolder();
    if (this.#disk.isLinked) {
      await this.#syncOthers();
      await this.run();
    }
  }

  async #onDisk(action) {
    try {
      return await action();
    } catch (error) {
      this.#disk.close();
      this.#tellFolder();
      element("play-kept").textContent = `${this.#disk.name} cannot be used: ${error.message}`;
      return null;
    }
  }

  /** Takes the open step from the folder where only the file was changed, and `writes` it there where only the page's
   * text was; where both were, the reader is asked. Whether there is another text now. */
  async #sync(writes) {
    const [step, mine] = [this.#step, this.#editor.text];
    if (!this.#disk.isLinked || !this.#isMine) {
      return false;
    }
    const found = await this.#onDisk(() => this.#disk.changes(step, mine));
    if (!found || step !== this.#step || mine !== this.#editor.text) {
      return false; // it was typed in meanwhile, and is looked at again
    }
    element("play-both").hidden = found.by !== "both";
    if (found.by === "disk") {
      await this.#replace(found.text);
      await this.#disk.accept(step, found.text);
      element("play-kept").textContent = `Taken from ${this.#disk.name}, where it was changed.`;
      return true;
    }
    if (found.by === "page" && writes && (found.text !== null || mine !== step.stub)) {
      await this.#onDisk(() => this.#disk.write(step, mine));
      element("play-kept").textContent = this.#disk.isLinked ? `Saved in ${this.#disk.name}.` : "";
    }
    return false;
  }

  /** Likewise for the steps that are not open; what was changed on both sides waits until it is. */
  async #syncOthers() {
    for (const step of data.steps.filter((one) => one !== this.#step)) {
      if (!(await Turn.isFree(turnOf(step)))) {
        continue;
      }
      const kept = await this.#work.read(step.id);
      const found = await this.#onDisk(() => this.#disk.changes(step, kept ?? step.stub));
      if (found?.by === "disk") {
        await this.#work.write(replaced(step), kept ?? step.stub);
        await this.#work.write(step.id, found.text);
        await this.#disk.accept(step, found.text);
      } else if (found?.by === "page" && kept) {
        await this.#onDisk(() => this.#disk.write(step, kept));
      }
    }
  }

  /** Another text for the open step; the one that stood there can be brought back. */
  async #replace(text) {
    const [step, old] = [this.#step, this.#editor.text];
    await this.#work.write(replaced(step), old);
    await this.#work.write(step.id, text);
    if (step === this.#step) {
      this.#show(text, this.#isMine);
      this.#offer(old);
    }
  }

  /** Both were changed, and the reader has chosen. */
  async #settle(isTheirs) {
    const [step, mine] = [this.#step, this.#editor.text];
    const found = await this.#onDisk(() => this.#disk.changes(step, mine));
    if (found?.by === "both") {
      await this.#disk.accept(step, found.text); // so that only the page's text is another one
      if (isTheirs) {
        await this.#replace(found.text);
      } else {
        await this.#work.write(replaced(step), found.text);
        this.#offer(found.text);
      }
    }
    element("play-both").hidden = true;
    this.#editor.focus(); // the button is gone
    await this.run();
  }

  #hint() {
    const room = element("play-hints");
    const text = this.#step.hints[room.childElementCount];
    if (text) {
      room.append(make("pre", { class: "play-hint", tabindex: 0 }, text.trim()));
      room.lastElementChild.scrollIntoView({ block: "nearest" });
    }
    element("play-hint").disabled = room.childElementCount >= this.#step.hints.length;
  }

  #say(phase, text) {
    const room = element("play-status");
    room.dataset.phase = phase;
    if (room.textContent !== text) {
      room.textContent = text;
    }
    element("play-stop").disabled = phase !== "busy";
    element("play-loading").hidden ||= phase !== "busy";
  }

  /** What the page itself could not do. */
  tellFault(error) {
    const what = "Is its server still there? Press Run to try again, or load the page again.";
    this.#say("bad", `The page has a fault: ${error.message}. ${what}`);
  }

  #loading({ name, done, total }) {
    if (element("play-status").dataset.phase !== "busy") {
      return; // nobody waits for it
    }
    const megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`;
    const bar = element("play-loading");
    bar.hidden = total > 0 && done >= total;
    bar.max = total || 1;
    bar.value = done;
    this.#say("busy", `Loading ${name}: ${megabytes(done)}${total ? ` of ${megabytes(total)}` : ""}`);
  }

  // A run: compile, link, test, draw.

  stop() {
    this.#run++;
    this.#compiler.stop("The compiler was stopped.");
    this.#tester.stop("hand");
    this.#painter.stop("hand");
    this.#figures.stop();
    this.#inside.stop();
    this.#say("idle", "Stopped.");
  }

  async run() {
    this.stop();
    const run = this.#run;
    const step = this.#step;
    const start = performance.now();
    try {
      await this.#keep();
      await this.#sync(true);
      this.#say("busy", "Loading the compiler ...");
      await this.#compiler.prepare();
      const sources = await this.#sourcesFor(step);
      if (run !== this.#run) {
        return; // or else its job would end the one of a newer run
      }
      this.#say("busy", "Compiling ...");
      const onHeaders = () =>
        run === this.#run && this.#say("busy", "Compiling what you include (once, some seconds) ...");
      const built = await this.#compiler.build(step.number, sources, COMPILE_SECONDS, { onHeaders });
      if (run !== this.#run) {
        return;
      }
      this.#tellProblems(step, built);
      element("play-stale").hidden = built.program !== null || !element("play-first").childElementCount;
      if (!built.program) {
        this.#say("bad", built.stopped ?? "It does not compile.");
        return;
      }
      const module = await WebAssembly.compile(built.program);
      if (run !== this.#run) {
        return;
      }
      this.#figures.built(module);
      this.#inside.built(step, sources);
      this.#say("busy", "Testing and drawing ...");
      element("play-console").textContent = "";
      const current = () => run === this.#run;
      const [tests, pictures] = await Promise.all([
        this.#test(step, module, current),
        this.#paint(step, module, current, start),
      ]);
      if (current()) {
        this.#sum(step, tests, pictures, built);
      }
    } catch (error) {
      if (run === this.#run) {
        this.tellFault(error);
      }
    }
  }

  async #sourcesFor(step) {
    const own = data.model === "reference" ? [step] : data.steps.filter((one) => one.number <= step.number);
    const sources = {};
    for (const one of own) {
      sources[one.number] = await this.#sourceOf(one);
    }
    return sources;
  }

  #tellProblems(step, built) {
    const room = element("play-problems");
    room.replaceChildren();
    const mine = [];
    for (const { number, text } of built.says) {
      const source = data.kit.steps[number].source;
      const problems = problemsIn(text);
      for (const problem of problems) {
        const isMine = number === step.number && problem.file === source;
        mine.push(...(isMine ? [problem] : []));
        room.append(this.#problem(problem, isMine));
      }
      const words = linkerWords(text, data.words);
      if (words) {
        room.append(make("p", { class: "play-problem play-error" }, words));
      } else if (!problems.length && text.trim()) {
        room.append(make("pre", { tabindex: 0 }, text.trim()));
      }
    }
    this.#editor.mark(mine);
  }

  #problem({ file, line, severity, message }, isMine) {
    const where = `${file.split("/").at(-1)}:${line}`;
    const place = isMine ? make("button", { type: "button", class: "play-place" }, where) : make("code", {}, where);
    if (isMine) {
      place.addEventListener("click", () => this.#editor.goTo(line));
    }
    return make("p", { class: `play-problem play-${severity}` }, place, ` ${severity}: ${message}`);
  }

  #print(ran) {
    const text = `${ran.stdout ?? ""}\n${ran.stderr ?? ""}`.trim();
    if (text) {
      const room = element("play-console");
      const lines = new Set(`${room.textContent}\n${text}`.split("\n").filter(Boolean));
      room.textContent = [...lines].slice(-200).join("\n");
    }
  }

  // Tests.

  async #test(step, module, current) {
    const words = ["test", "-r", "xml", "-o", "/out/report.xml"];
    const task = { module, files: {}, wanted: ["/out/report.xml"] };
    let limit = step.seconds;
    const ask = (more = []) => this.#tester.run({ ...task, words: [...words, ...more] }, limit);
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
      this.#tellTests(step, results);
    }
    return results;
  }

  #tellTests(step, results) {
    const open = unfinished(this.#editor.text);
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
      ...list(`${waiting.length} wait for a function that is not written yet`, waiting),
      ...list(`${right.length} of ${results.length} tests pass`, right),
    );
  }

  // Pictures.

  async #fileOf(name) {
    if (!this.#files.has(name)) {
      this.#files.set(name, new Uint8Array(await (await fetch(name)).arrayBuffer()));
    }
    return this.#files.get(name);
  }

  async #paint(step, module, current, start) {
    const verdicts = [];
    let limit = step.seconds;
    for (const picture of step.pictures) {
      const shown = this.#frame(picture);
      const task = {
        module,
        words: ["raytrace", "/scene.nff", ...picture.args, ...data.words.raytrace, ...(picture.noise ? ESTIMATES : [])],
        files: { "/scene.nff": await this.#fileOf(picture.scene) },
        wanted: ["/out/picture.ppm", "/out/stats.json", "/out/estimates"],
      };
      if (!current()) {
        return [];
      }
      const ran = await this.#painter.run(task, limit, (tile) => current() && shown.tile(tile));
      if (!current()) {
        return [];
      }
      limit /= ran.stopped ? AFTER_A_STOP : 1;
      this.#print(ran);
      const verdict = await this.#judge(picture, ran, shown);
      verdicts.push(verdict);
      shown.root.dataset.seconds = ((performance.now() - start) / 1000).toFixed(2);
    }
    return verdicts;
  }

  /** Where a picture stands: the canvas on which it grows, and then the comparison. */
  #frame(picture) {
    const id = `picture-${picture.name}`;
    let root = element(id);
    if (!root) {
      const canvas = make("canvas", { class: "play-canvas", role: "img", "aria-label": `${picture.name}: yours` });
      const goal = make("img", { class: "play-goal", src: picture.reference, alt: `${picture.name}: the reference` });
      root = make(
        "article",
        { class: "play-picture", id },
        make("h3", {}, picture.name, make("span", {}), this.#numbersButton()),
        make("p", { class: "play-words" }),
        make("div", { class: "play-pair" }, canvas, goal),
      );
      this.#inside.offer(root, picture, () => this.#fileOf(picture.scene));
      element(picture === this.#step.pictures[0] ? "play-first" : "play-pictures").append(root);
    }
    const [canvas] = root.getElementsByTagName("canvas");
    const pair = root.querySelector(".play-pair");
    const beginGrowing = () => {
      if (pair.hidden || !canvas.dataset.grows) {
        canvas.width = picture.width;
        canvas.height = picture.height;
        canvas.dataset.grows = "yes";
        pair.hidden = false;
        root.querySelector("compare-pictures")?.setAttribute("hidden", "");
      }
    };
    return {
      root,
      tile: (tile) => {
        beginGrowing();
        draw(canvas, tile);
      },
      done: () => delete canvas.dataset.grows,
    };
  }

  /** Shows and hides what a comparison tells of single pixels. */
  #numbersButton() {
    const button = make("button", { type: "button", class: "play-numbers", "aria-pressed": "false" }, "Numbers");
    button.addEventListener("click", () => {
      const isOn = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(isOn));
      button.closest(".play-picture").classList.toggle("play-with-numbers", isOn);
    });
    return button;
  }

  async #judge(picture, ran, shown) {
    shown.done();
    const bytes = ran.code === 0 ? ran.made["/out/picture.ppm"] : null;
    const mine = bytes ? readPpm(bytes) : null;
    const reference = await readImage(picture.reference);
    const estimates = mine && picture.noise ? readEstimates(ran.made["/out/estimates"]) : null;
    const verdict = estimates
      ? compareEstimates(estimates, picture.noise)
      : mine && !picture.noise
        ? compare(mine, reference, picture.maxWrong)
        : { passed: false, message: whyNothing(ran, "The picture", data.words.endless) };
    const stats = ran.made?.["/out/stats.json"];
    if (verdict.passed && picture.maxShare !== null && stats) {
      const { share_tested: share } = JSON.parse(new TextDecoder().decode(stats));
      Object.assign(verdict, this.#judgeWork(share, picture.maxShare));
    }
    const sign = shown.root.querySelector("h3 > span");
    sign.textContent = verdict.passed ? " ✓ right" : mine ? " ✗ wrong" : " ✗ missing";
    sign.className = verdict.passed ? "watch-good" : "watch-bad";
    shown.root.querySelector(".play-words").textContent = verdict.message;
    if (mine) {
      this.#showPair(picture, mine, shown.root);
    }
    return verdict;
  }

  #judgeWork(share, most) {
    if (!share) {
      return { passed: false, message: data.words.noTests };
    }
    const percent = (part) => Number((100 * part).toPrecision(3));
    const message = data.words.tooManyTests.replace("{share}", percent(share)).replace("{most}", percent(most));
    return share <= most ? {} : { passed: false, message };
  }

  #showPair(picture, mine, root) {
    const canvas = make("canvas", { width: mine.width, height: mine.height });
    draw(canvas, mine);
    let view = root.querySelector("compare-pictures");
    if (!view) {
      view = make("compare-pictures", { label: picture.name, group: "play" });
      root.append(view);
    }
    view.removeAttribute("hidden");
    const one = (src, name) => ({ src, name, alt: `${picture.name}: ${name}` });
    view.setPictures({ reference: one(picture.reference, "reference"), mine: one(canvas.toDataURL(), "yours") });
    root.querySelector(".play-pair").hidden = true;
  }

  #sum(step, tests, pictures, built) {
    const passed = tests.filter((one) => one.passed).length;
    const right = pictures.filter((one) => one.passed).length;
    const done = passed === tests.length && right === pictures.length;
    const seconds = `compiled in ${built.seconds.compile.toFixed(1)} s, linked in ${built.seconds.link.toFixed(1)} s`;
    const words = `${passed} of ${tests.length} tests pass, ${right} of ${pictures.length} pictures are right`;
    this.#say(done ? "good" : "bad", `Step ${step.number}${done ? " is right" : ""}: ${words}.`);
    element("play-times").textContent = seconds;
    element("play-next").hidden = !done || !this.#next;
  }
}

const page = new Page();
page.start().catch((error) => page.tellFault(error));
