// The worker that compiles: clang and the linker, the headers, and the kit as objects. What it is asked is a step and
// the sources that are the student's own; what it answers is a program, or what the compiler says.

import { borrowedWords } from "./borrowed.js";
import { firstIncludes } from "./includes.js";
import { Files, runProgram } from "./wasi.js";

const files = new Files();
let clang = null;
let kit = null;
const compiled = new Map(); // objects by step and source
const headers = new Map(); // compiled ones, by step
const stubs = new Set(); // steps whose stub's headers are there

/** What comes, unpacked: where a server says that a .gz is packed, the browser has done that already. */
async function unpacked(body) {
  const reader = body.getReader();
  const { value: first = new Uint8Array() } = await reader.read();
  const all = new ReadableStream({
    start: (stream) => stream.enqueue(first),
    pull: async (stream) => {
      const { done, value } = await reader.read();
      if (done) {
        stream.close();
      } else {
        stream.enqueue(value);
      }
    },
  });
  return first[0] === 0x1f && first[1] === 0x8b ? all.pipeThrough(new DecompressionStream("gzip")) : all;
}

/** A file of the page, packed or not, with word of how much of it has come. */
async function loaded(name, isWasm = false) {
  const answer = await fetch(name);
  if (!answer.ok) {
    throw new Error(`${name}: cannot be loaded (${answer.status})`);
  }
  const total = answer.headers.get("Content-Encoding") ? 0 : Number(answer.headers.get("Content-Length") ?? 0);
  let done = 0;
  const counted = new TransformStream({
    transform(piece, controller) {
      done += piece.length;
      postMessage({ loading: { name, done, total } });
      controller.enqueue(piece);
    },
  });
  const body = await unpacked(answer.body.pipeThrough(counted));
  return new Response(body, { headers: isWasm ? { "Content-Type": "application/wasm" } : {} });
}

async function bytesOf(name) {
  return new Uint8Array(await (await loaded(name)).arrayBuffer());
}

async function prepare(message) {
  kit = message.kit;
  const [module, system, parts] = await Promise.all([
    message.clang ?? loaded(kit.clang, true).then((answer) => WebAssembly.compileStreaming(answer)),
    bytesOf(kit.system),
    bytesOf(kit.parts),
  ]);
  clang = module;
  files.unpack(system);
  files.unpack(parts);
  files.write("/work/empty", new Uint8Array());
  postMessage({ ready: true, clang: message.clang ? null : clang });
}

/** The compiled headers of the stub, which come with the page. */
async function headersOfStub(step) {
  const path = `${step.headers.path}.pch`;
  if (!stubs.has(step.number)) {
    files.write(step.headers.path, new TextEncoder().encode(step.headers.text));
    files.write(path, await bytesOf(step.headers.file));
    stubs.add(step.number);
  }
  return path;
}

/** Other headers, compiled; what the stub includes is taken from there, and costs nothing again. */
async function headersOfOwn(step, includes) {
  const lines = includes.split("\n");
  const given = step.headers.includes.split("\n");
  const builtOn = given.every((line) => lines.includes(line)) ? ["-include-pch", await headersOfStub(step)] : [];
  const more = builtOn.length ? lines.filter((line) => !given.includes(line)) : lines;
  const source = `${step.headers.path}.own.hpp`;
  const path = `${source}.pch`;
  files.write(source, new TextEncoder().encode(`${more.join("\n")}\n`));
  files.remove(path);
  const { code } = runProgram(clang, [...filled(kit.headers, [source], path), ...builtOn], files);
  return code === 0 ? path : null;
}

/** The path of the compiled headers of a source, or nothing where they do not compile. They change rarely; `tell` is
 * called before others than the stub's are compiled. */
async function prepareHeaders(step, source, tell) {
  const includes = firstIncludes(source);
  const known = headers.get(step.number);
  if (known?.includes === includes) {
    return known.path;
  }
  const isStub = includes === step.headers.includes;
  if (!isStub) {
    tell();
  }
  const path = isStub ? await headersOfStub(step) : await headersOfOwn(step, includes);
  headers.set(step.number, { includes, path });
  return path;
}

/** The words of a command with the names of these files. */
function filled(command, input, output) {
  return command.flatMap((word) => (word === kit.input ? input : word === kit.output ? [output] : [word]));
}

/** The linker's names of all that an object asks for: it is a module, too, which imports these. */
function askedBy(object) {
  return WebAssembly.Module.imports(new WebAssembly.Module(files.read(object))).map(({ name }) => name);
}

/** The path of the object, and what the compiler says. */
async function compile(job, step, source) {
  const key = `${step.number} ${source}`;
  const known = compiled.get(step.number);
  if (known?.key === key) {
    return known;
  }
  const object = `/work/own-${step.number}.o`;
  files.remove(object);
  files.write(step.source, new TextEncoder().encode(source));
  const path = await prepareHeaders(step, source, () => postMessage({ job, headers: true }));
  const words = [...filled(kit.compile, [step.source], object), ...(path ? ["-include-pch", path] : [])];
  const said = runProgram(clang, words, files);
  const mayBorrow = said.code === 0 && step.barred.length > 0;
  const borrowed = mayBorrow ? borrowedWords(step, askedBy(object), source) : "";
  const made = { key, object, code: borrowed ? 1 : said.code, says: said.stderr + said.stdout + borrowed };
  compiled.set(step.number, made);
  return made;
}

/** Object files and libraries in the order in which the linker shall see them. */
function linkInputs(number, own, inspects) {
  const parts = [...kit.objects[inspects ? "inspect" : "web"], ...kit.objects.exceptions, ...own.values()];
  for (const [name, paths] of Object.entries(kit.objects)) {
    if (name.startsWith("step-") && !own.has(name.slice("step-".length))) {
      parts.push(...paths);
    }
  }
  return [...parts, ...(inspects ? [] : kit.objects[`test-${number}`]), ...kit.objects.kit];
}

async function build({ job, number, sources, inspects }) {
  const start = performance.now();
  const own = new Map();
  for (const [one, source] of Object.entries(sources)) {
    const step = kit.steps[one];
    const made = await compile(job, step, source);
    if (one === number || made.code !== 0) {
      postMessage({ job, says: { number: one, code: made.code, text: made.says } });
    }
    if (made.code !== 0) {
      postMessage({ job, done: true, program: null });
      return;
    }
    own.set(one, made.object);
  }
  const compiledAt = performance.now();
  files.remove("/work/program.wasm");
  const said = runProgram(clang, filled(kit.link, linkInputs(number, own, inspects), "/work/program.wasm"), files);
  const bytes = said.code === 0 ? files.read("/work/program.wasm").slice() : null;
  if (said.code !== 0) {
    postMessage({ job, says: { number, code: said.code, text: said.stderr } });
  }
  const seconds = { compile: (compiledAt - start) / 1000, link: (performance.now() - compiledAt) / 1000 };
  postMessage({ job, done: true, program: bytes, seconds }, bytes ? [bytes.buffer] : []);
}

/** What is asked: to load all, to build, or to compile headers before somebody waits for them. */
function answer(data) {
  if (data.kit) {
    return prepare(data);
  }
  return data.ahead ? prepareHeaders(kit.steps[data.ahead], data.source, () => {}) : build(data);
}

let queue = Promise.resolve();
let newest = 0;
addEventListener("message", ({ data }) => {
  const turn = ++newest;
  const isNeeded = () => !data.ahead || turn === newest; // what came after it includes something else, or is a build
  queue = queue
    .then(() => (isNeeded() ? answer(data) : null))
    .catch((error) => postMessage({ job: data.job, failed: String(error?.message ?? error) }));
});
