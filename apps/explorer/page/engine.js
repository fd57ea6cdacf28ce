// The C++ libraries, compiled to WebAssembly: loading them, and asking them.

import loadModule from "engine-loader";
import { evaluate } from "./expression.js";
import { toToml } from "./toml.js";

/** The file that the page's problem is written to, in the module's memory. */
const shownFile = "explorer.toml";

/** Takes the module's code out of the page, where it is packed. */
export async function unpackCode(text) {
  const packed = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

/** A sentence that says why the libraries refused something. */
export class Refusal extends Error {}

/** One instance of the libraries. */
export class Engine {
  /**
   * @param {WebAssembly.Module} code compiled once for page and worker
   * @param {Record<string, string>} examples files that are there from the start, by name
   * @param {(iterate: object) => void} [report] gets the iterates of a search
   */
  static async start(code, examples, report = () => {}) {
    const module = await loadModule({
      instantiateWasm(imports, use) {
        WebAssembly.instantiate(code, imports).then((instance) => use(instance, code));
        return {};
      },
      report: (text) => report(JSON.parse(text)),
      evaluate: (text) => evaluate(text, module._explorer_sine, module._explorer_cosine),
    });
    for (const [name, text] of Object.entries(examples)) module.FS.writeFile(name, text);
    return new Engine(module);
  }

  constructor(module) {
    this.module = module;
  }

  /** Calls a function from text to text. */
  call(name, text) {
    const { module } = this;
    const size = module.lengthBytesUTF8(text) + 1;
    const place = module._malloc(size);
    module.stringToUTF8(text, place, size);
    const reply = module[name](place);
    module._free(place);
    return typeof reply === "number" && name !== "_explorer_show" ? module.UTF8ToString(reply) : reply;
  }

  /** The answer to a request, an object. Throws Refusal with the libraries' sentence. */
  request(name, request) {
    const answer = JSON.parse(this.call(name, JSON.stringify(request)));
    if (answer.error) throw new Refusal(answer.error);
    return answer;
  }

  /** Documents that answer questions about a problem. */
  ask(problem, questions) {
    this.module.FS.writeFile(shownFile, toToml(problem));
    return this.request("_explorer_respond", { file: shownFile, questions }).answers;
  }

  /** The tables of a file: its expressions worked out, and what it takes from other files copied in. */
  read(name, text) {
    this.module.FS.writeFile(name, text);
    const [{ manipulator, workspace, orientations, design }] = this.request("_explorer_respond", {
      file: name,
      questions: [{ command: "problem" }],
    }).answers;
    return workspace ? { manipulator, workspace, orientations, design } : { manipulator };
  }

  /** Makes the problem last asked about the one of kappa() and map(). */
  show() {
    this.call("_explorer_show", shownFile);
  }

  /** The least kappa^-1 at a position over both ends of a range of orientations, degrees. */
  kappa(x, y, [lower, upper]) {
    return this.module._explorer_kappa(x, y, lower, upper);
  }

  /**
   * The same at columns x rows positions of a box, from its lower left corner, row by row. The array is overwritten by the
   * next call.
   * @returns {Float32Array}
   */
  map({ left, bottom, right, top }, columns, rows, [lower, upper]) {
    const place = this.module._explorer_map(left, bottom, right, top, columns, rows, lower, upper);
    return this.module.HEAPF32.subarray(place / 4, place / 4 + columns * rows);
  }

  /** Searches for the best design of a problem. Takes its time: for the worker. */
  search(problem, formulation) {
    this.module.FS.writeFile(shownFile, toToml(problem));
    return this.request("_explorer_search", { file: shownFile, formulation });
  }
}
