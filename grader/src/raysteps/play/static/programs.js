// The workers that compile and run, and what is done when one of them does not answer: it is ended, and another one
// takes its place. The page itself never waits.

// What engines call a crash, in the words of common/process.py.
const CRASHES = [
  [/call stack|recursion/, "a recursion without an end"],
  [/out of bounds/, "memory that is not its own, or a recursion without an end"],
];

/** Why a run gave nothing, in words; `what` is what it was to give, `endless` what is asked where it did not end. */
export function whyNothing(ran, what, endless) {
  if (ran.stopped === "time") {
    return `${what} was not ready in time. ${endless}`;
  }
  if (ran.stopped) {
    return `${what} was stopped.`;
  }
  if (ran.crashed) {
    const [, why] = CRASHES.find(([known]) => known.test(ran.crashed)) ?? [null, ran.crashed];
    return `${what} did not come to its end: the program crashed (${why}).`;
  }
  const code = `exit code ${ran.code}${ran.code ? "" : ", as by a call of exit(0)"}`;
  const said = ran.stderr.trim().split("\n").at(-1);
  return `${what} did not come to its end: the program gave up with ${code}${said ? `: ${said}` : "."}`;
}

/** Compiles and links, once it is prepared. One job at a time; a new one ends an old one. */
export class Compiler {
  #kit;
  #loading;
  #worker = null;
  #clang = null; // the compiler's module, which outlives a worker
  #ready = null;
  #answer = null;
  #lastJob = 0;

  /** `loading` is told how much of which file has come. */
  constructor(kit, loading) {
    this.#kit = kit;
    this.#loading = loading;
  }

  /** Loads all that it takes, once; what failed is tried again by the next call. */
  prepare() {
    this.#ready ??= this.#start().catch((error) => {
      this.#worker.terminate();
      this.#ready = null;
      throw new Error(`the compiler cannot be loaded: ${error.message}`);
    });
    return this.#ready;
  }

  #start() {
    return new Promise((resolve, reject) => {
      this.#worker = new Worker("compiler.js", { type: "module" });
      this.#worker.onerror = (event) => reject(new Error(event.message || "the compiler could not be started"));
      this.#worker.onmessage = ({ data }) => {
        if (data.loading) {
          this.#loading(data.loading);
        } else if (data.ready) {
          this.#clang = data.clang ?? this.#clang;
          resolve();
        } else if (data.failed && data.job === undefined) {
          reject(new Error(data.failed));
        } else {
          this.#answer?.(data);
        }
      };
      this.#worker.postMessage({ kit: this.#kit, clang: this.#clang });
    });
  }

  /**
   * `{program, says: [{number, code, text}], seconds}`; `stopped` where somebody ended it, or its time was over. The
   * program tests and draws, or it inspects pixels. `onHeaders` hears that other headers are compiled than those of
   * the stub, which takes its time.
   */
  async build(number, sources, limit, { inspects = false, onHeaders = () => {} } = {}) {
    const job = ++this.#lastJob;
    const says = [];
    return new Promise((resolve, reject) => {
      const end = (result) => {
        clearTimeout(timer);
        this.#answer = null;
        resolve({ program: null, says, ...result });
      };
      const timer = setTimeout(() => {
        if (job === this.#lastJob) {
          this.stop(`The compiler was stopped after ${limit} s.`);
        }
      }, 1000 * limit);
      this.#answer = (data) => {
        if (data.stopped) {
          end(data);
        } else if (data.job !== job) {
          return;
        } else if (data.headers) {
          onHeaders();
        } else if (data.says) {
          says.push(data.says);
        } else if (data.failed) {
          clearTimeout(timer);
          this.#answer = null;
          reject(new Error(data.failed));
        } else {
          end(data);
        }
      };
      this.#worker.postMessage({ job, number, sources, inspects });
    });
  }

  /** Compiles what a source includes, so that its build need not: where nothing else is to be done. */
  lookAhead(number, source) {
    if (!this.#answer) {
      this.#worker?.postMessage({ ahead: number, source });
    }
  }

  stop(reason) {
    if (this.#answer) {
      this.#worker.terminate();
      this.#ready = null;
      this.#answer({ stopped: reason });
      this.prepare().catch(() => {}); // the next run says why
    }
  }
}

/** Runs one program at a time. */
export class Runner {
  #start;
  #worker = null;
  #end = null;

  /** `start` gives a worker that does what runner.js does. */
  constructor(start = () => new Worker("runner.js", { type: "module" })) {
    this.#start = start;
  }

  /**
   * `{code, stdout, stderr, made, seconds}`, or `{crashed}`, or `{stopped}`.
   * @param {{module: WebAssembly.Module, words: string[], files: object, wanted: string[]}} task
   * @param {number} limit in seconds
   */
  run(task, limit, onTile = () => {}) {
    this.#worker ??= this.#start();
    return new Promise((resolve) => {
      const timer = setTimeout(() => this.stop("time"), 1000 * limit);
      this.#end = (result) => {
        clearTimeout(timer);
        this.#end = null;
        resolve(result);
      };
      this.#worker.onmessage = ({ data }) => {
        if (data.tile) {
          onTile(data.tile);
        } else {
          this.#end?.(data.ended ?? data);
        }
      };
      this.#worker.onerror = (event) => this.#end?.({ crashed: event.message || "the worker ended" });
      this.#worker.postMessage(task);
    });
  }

  stop(reason) {
    if (this.#end) {
      this.#worker.terminate();
      this.#worker = null;
      this.#end({ stopped: reason });
    }
  }
}
