// The page to work in: chooses a step, keeps its source, and after each save compiles it, runs its tests and draws.

import { Editor } from "./editor.js";
import { Figures } from "./figures.js";
import { DiskFolder } from "./folder.js";
import { nextHint } from "./hints.js";
import { Inside } from "./inside.js";
import { data, element } from "./page-data.js";
import { Painter } from "./painting.js";
import { tellProblems } from "./problems.js";
import { Compiler } from "./programs.js";
import { closeText, openTexts, textLink } from "./reading.js";
import { Tester } from "./testing.js";
import { Turn, textsIn, Work, zipOf } from "./work.js";

const COMPILE_SECONDS = 60;
const KEEP_AFTER = 300; // milliseconds without a key
const SAVE_SECONDS = 60; // until a browser that asks where to has surely taken a file
const SOON = 3000; // milliseconds until a service worker is there, or the page begins without it
const turnOf = (step) => `raysteps-play ${step.id}`; // of the tab that writes it
const LOADED = { [data.kit.clang]: "the compiler", [data.kit.system]: "C++", [data.kit.parts]: "the kit" };
const replaced = (step) => `${step.id} before its reset`; // what may be brought back, by this name in the work

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

/** Nothing where it cannot be loaded. */
async function handoutOf(step) {
  try {
    const answer = await fetch(`steps/${step.number}.html`);
    return answer.ok ? await answer.text() : null;
  } catch {
    return null;
  }
}

class Page {
  #work;
  #turn = new Turn();
  #isMine = false; // whether this tab writes the step
  #step = null;
  #editor;
  #compiler;
  #tester = new Tester((ran) => this.#print(ran));
  #painter = new Painter(
    (ran) => this.#print(ran),
    (...picture) => this.#inside.offer(...picture),
  );
  #figures = new Figures("It waits for your first build: write the functions, then press Run.");
  #inside = null;
  #disk = null;
  #keepTimer = 0;
  #kept = ""; // the text that needs no keeping
  #run = 0; // counts runs: what an older one finds is not shown

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
    const on = (target, event, act) => target.addEventListener(event, this.#telling(act));
    const onClick = (id, act) => on(element(id), "click", act);
    on(window, "hashchange", () => this.#open());
    addEventListener("pagehide", () => this.#leave());
    document.addEventListener("visibilitychange", () => this.#keep());
    element("play-run").addEventListener("click", () => this.run());
    element("play-stop").addEventListener("click", () => this.stop());
    onClick("play-save", () => this.#saveZip());
    element("play-load").addEventListener("click", () => element("play-zip").click());
    on(element("play-zip"), "change", (event) => this.#openZip(event.target));
    onClick("play-folder", () => this.#link());
    onClick("play-theirs", () => this.#settle(true));
    onClick("play-ours", () => this.#settle(false));
    on(window, "focus", async () => (await this.#sync(false)) && this.run());
    element("play-next").addEventListener("click", () => {
      location.hash = this.#next.number;
    });
    onClick("play-here", () => this.#writeHere());
    element("play-hint").addEventListener("click", () => nextHint(this.#step));
    element("play-reset").addEventListener("click", () => element("play-really").showModal());
    on(element("play-really"), "close", (event) => event.target.returnValue === "reset" && this.#reset());
    onClick("play-back", () => this.#bringBack());
    for (const button of document.querySelectorAll(".play-rooms button")) {
      button.addEventListener("click", () => element(button.dataset.room).scrollIntoView());
    }
    const more = element("play-more"); // of the buttons, where there is no room for all
    const showMore = (isShown) => more.setAttribute("aria-expanded", isShown);
    const showLess = () => {
      if (more.checkVisibility()) {
        more.focus(); // what has the focus is about to be hidden
      }
      showMore(false);
    };
    more.addEventListener("click", () => showMore(more.getAttribute("aria-expanded") === "false"));
    element("play-others").addEventListener("click", showLess);
    element("play-others").addEventListener("keydown", (event) => event.key === "Escape" && showLess());
    const head = document.querySelector(".page-head");
    const tellHeight = () => document.documentElement.style.setProperty("--head", `${head.offsetHeight}px`);
    new ResizeObserver(tellHeight).observe(head); // it lies over what is scrolled to
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

  /** Does what an event asks for, and tells what goes wrong. */
  #telling(act) {
    return async (event) => {
      try {
        await act(event);
      } catch (error) {
        this.tellFault(error);
      }
    };
  }

  // What is shown, and kept.

  async #open() {
    const chosen = () => data.steps.find((step) => step.number === location.hash.slice(1)) ?? data.steps[0];
    const wanted = chosen();
    if (wanted === this.#step) {
      return;
    }
    const handout = await handoutOf(wanted);
    if (handout === null) {
      const help = "Is there a network, and is the page's server still there? Choose it again then.";
      this.#stay(wanted, `cannot be loaded. ${help}`);
      return;
    }
    if (!(await this.#keepBefore(wanted))) {
      return;
    }
    const isMine = await this.#takeTurn(wanted); // after it was kept: another tab may have it now
    const source = (await this.#work.read(wanted.id)) ?? wanted.stub;
    const old = await this.#work.read(replaced(wanted));
    if (!(await this.#keepBefore(wanted))) {
      return;
    }
    if (wanted !== chosen() || wanted === this.#step) {
      return; // another one was chosen while this one was read
    }
    const before = this.#step;
    this.stop();
    closeText();
    this.#step = wanted; // and its text with it, without a pause: what is kept is always the step's own
    this.#show(source, isMine);
    this.#editor.toTop();
    element("play-kept").textContent = "";
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
      scrollTo(0, 0); // where the rooms stand below each other
      await this.run();
    }
  }

  /** Another step was chosen and cannot be had: the one that is shown stays chosen, so that the other can be again. */
  #stay({ number }, why) {
    if (!this.#step) {
      throw new Error(`step ${number} cannot be loaded`);
    }
    this.#say("bad", `Step ${number} ${why}`);
    history.replaceState(null, "", `#${this.#step.number}`);
    element("play-step").value = this.#step.number;
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

  #takeTurn(step, steal = false) {
    const changed = this.#telling((isMine) => this.#changeTurn(isMine));
    return this.#turn.take(turnOf(step), changed, steal);
  }

  async #writeHere() {
    const step = this.#step;
    const isMine = await this.#takeTurn(step, true);
    if (step === this.#step) {
      await this.#changeTurn(isMine);
      this.#editor.focus(); // the button is gone
    }
  }

  #changed() {
    clearTimeout(this.#keepTimer);
    element("play-kept").textContent = "";
    this.#keepTimer = setTimeout(() => {
      this.#keep();
      if (this.#step) {
        this.#compiler.lookAhead(this.#step.number, this.#editor.text);
      }
    }, KEEP_AFTER);
  }

  /** Whether all is kept; if not it has said so, and the next time tries again. */
  async #keep() {
    clearTimeout(this.#keepTimer);
    const { text } = this.#editor;
    const before = this.#kept;
    if (!this.#step || !this.#isMine || text === before) {
      return true;
    }
    this.#kept = text;
    try {
      await this.#work.write(this.#step.id, text);
    } catch (error) {
      this.#kept = this.#kept === text ? before : this.#kept;
      const help = "Save as zip keeps it elsewhere.";
      element("play-kept").textContent = `Not kept: this browser cannot (${error.message}). ${help}`;
      return false;
    }
    element("play-kept").textContent = "Kept in this browser.";
    return true;
  }

  /** What was typed a moment ago, too. */
  #leave() {
    const isNew = this.#step && this.#isMine && this.#editor.text !== this.#kept;
    this.#keep();
    if (isNew) {
      this.#work.leave(this.#step.id, this.#editor.text);
    }
  }

  async #sourceOf(step) {
    return step === this.#step ? this.#editor.text : ((await this.#work.read(step.id)) ?? step.stub);
  }

  /** A text that was replaced. */
  #offer(old) {
    element("play-back").hidden = !old || old === this.#step.stub;
  }

  /** Whether another step can take the place of this one; if not, the page has said so and stays. */
  async #keepBefore(wanted) {
    const isKept = await this.#keep();
    if (!isKept) {
      this.#stay(wanted, "is not opened: what you wrote here would be lost.");
    }
    return isKept;
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
    element("play-kept").textContent = "";
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
    await this.#work.write(step.id, text);
    await this.#work.write(replaced(step), old);
    if (step !== this.#step) {
      return;
    }
    this.#show(text, true);
    this.#editor.focus(); // the button may be gone
    this.#offer(old);
    await this.run();
  }

  async #saveZip() {
    await this.#keep();
    const texts = {};
    for (const step of data.steps) {
      const isNew = step === this.#step && this.#editor.text !== this.#kept; // where the browser cannot keep it
      const text = isNew ? this.#editor.text : await this.#work.read(step.id);
      if (text) {
        texts[step.path] = text;
      }
    }
    const link = make("a", { href: URL.createObjectURL(zipOf(texts)), download: "my-steps.zip" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000 * SAVE_SECONDS);
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
    if (!(await this.#keep())) {
      this.#say("bad", `${zip.name} is not opened: what you wrote here would be lost.`);
      return;
    }
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
    const shown = this.#step;
    if (opened.includes(shown.number)) {
      const [text, old] = [await this.#work.read(shown.id), await this.#work.read(replaced(shown))];
      if (shown === this.#step) {
        this.#show(text, this.#isMine);
        this.#offer(old);
      }
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
    const what =
      "Is its server still there? Press Run to try again, or load the page again; Save as zip keeps your work.";
    this.#say("bad", `The page has a fault: ${error.message}. ${what}`);
  }

  #loading({ name, done, total }) {
    if (element("play-status").dataset.phase !== "busy") {
      return; // nobody waits for it
    }
    const megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`;
    const words = `${megabytes(done)}${total ? ` of ${megabytes(total)}` : ""}`;
    const bar = element("play-loading");
    bar.hidden = total > 0 && done >= total;
    bar.max = total || 1;
    bar.value = done;
    bar.setAttribute("aria-valuetext", words); // not the status, which would be spoken each time
    bar.title = words;
    const what = LOADED[name] ?? "what the step includes";
    this.#say("busy", `Loading ${what} ...`);
  }

  // A run: compile, link, test, draw.

  stop() {
    this.#end();
    this.#say("idle", "Stopped.");
  }

  #end() {
    this.#run++;
    this.#compiler.stop("The compiler was stopped.");
    this.#tester.stop();
    this.#painter.stop();
    this.#figures.stop();
    this.#inside.stop();
  }

  async run() {
    this.#end();
    this.#say("busy", "Loading the compiler ...");
    const run = this.#run;
    const step = this.#step;
    const start = performance.now();
    try {
      await this.#keep();
      await this.#sync(true);
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
      tellProblems(step, built, this.#editor);
      element("play-stale").hidden = built.program !== null || !element("play-first").childElementCount;
      if (!built.program) {
        element("play-next").hidden = true;
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
        this.#tester.test({ step, source: sources[step.number], module, current }),
        this.#painter.paint({ step, module, current, start }),
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

  #print(ran) {
    const text = `${ran.stdout ?? ""}\n${ran.stderr ?? ""}`.trim();
    if (text) {
      const room = element("play-console");
      const lines = new Set(`${room.textContent}\n${text}`.split("\n").filter(Boolean));
      room.textContent = [...lines].slice(-200).join("\n");
    }
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
