// "Find the best design": Dynamic-Q in a worker, its iterates one after the other in the picture.

/** Milliseconds that the iterates of one search take to be shown, all together at most. */
const longestReplay = 4000;
const calm = () => window.matchMedia("(prefers-reduced-motion: reduce)").matches;

/** One search at a time. */
export class Search {
  history = [];
  #worker = null;
  #timer = 0;

  /**
   * @param {WebAssembly.Module} code
   * @param {string} script of the worker
   * @param {{iterate: (index: number) => void, ended: (found: object | null, sentence: string) => void}} page
   */
  constructor(code, script, page) {
    this.code = code;
    this.address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    this.page = page;
  }

  get running() {
    return this.#worker !== null || this.#timer !== 0;
  }

  /** Begins; `ended` tells of the end. */
  start(problem, formulation) {
    this.stop();
    this.history = [];
    let last = 0;
    this.#worker = new Worker(this.address);
    this.#worker.onmessage = ({ data }) => {
      if (data.iterate) {
        this.history.push(data.iterate);
        // A search that takes its time shows where it is.
        if (performance.now() - last > 100) {
          last = performance.now();
          this.page.iterate(this.history.length - 1);
        }
        return;
      }
      this.#end();
      if (data.refusal) this.page.ended(null, data.refusal);
      else this.#replay(0, data.found);
    };
    this.#worker.onerror = (event) => {
      this.#end();
      this.page.ended(null, `The search failed: ${event.message}.`);
    };
    this.#worker.postMessage({ code: this.code, problem, formulation });
  }

  /** Ends at once; what was found so far stays in the history. Returns whether there was a search to stop. */
  stop() {
    const was = this.running;
    this.#end();
    return was;
  }

  #end() {
    this.#worker?.terminate();
    this.#worker = null;
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  #replay(index, found) {
    this.#timer = 0;
    if (calm() || index >= this.history.length) {
      this.page.ended(found, "");
      return;
    }
    this.page.iterate(index);
    const pause = Math.min(120, longestReplay / this.history.length);
    this.#timer = setTimeout(() => this.#replay(index + Math.max(1, Math.round(16 / pause)), found), Math.max(16, pause));
  }
}
