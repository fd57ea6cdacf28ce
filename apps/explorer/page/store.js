// What the page shows, as one value that is replaced and never changed: so undoing is putting an old value back.
//
//   problem  tables of a problem file (toml.js)
//   pose     x, y, and phi in degrees
//   kind     SO, MO or D: one orientation, which is the pose's; three; a range
//   range    [lower, upper], degrees, of MO and D
//   preset   the name of what was chosen last
//   base     the scale of the prescribed workspace when it was chosen

/** The state with its history. */
export class Store {
  #past = [];
  #future = [];
  #state = null;
  #gesture = null;

  /** @param {(state: object, change: {settled: boolean}) => void} show called after every change */
  constructor(show) {
    this.show = show;
  }

  get state() {
    return this.#state;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Begins with a state, without a past. */
  begin(state) {
    this.#state = state;
    this.#past = [];
    this.#future = [];
    this.show(state, { settled: true });
  }

  /** A change that one undo takes back. */
  change(part) {
    if (this.#gesture === null) this.#remember(this.#state);
    this.#state = { ...this.#state, ...part };
    this.show(this.#state, { settled: this.#gesture === null });
  }

  /** Between hold and release, changes count as one. */
  hold() {
    this.#gesture ??= this.#state;
  }

  release() {
    const before = this.#gesture;
    this.#gesture = null;
    if (before === null || before === this.#state) return;
    this.#remember(before);
    this.show(this.#state, { settled: true });
  }

  /** Puts back a state that the libraries accept, without a trace in the past. */
  restore(state) {
    this.#state = state;
    if (this.#gesture === null && this.#past.at(-1) === state) this.#past.pop();
  }

  undo() {
    this.#step(this.#past, this.#future);
  }

  redo() {
    this.#step(this.#future, this.#past);
  }

  #remember(state) {
    this.#past.push(state);
    if (this.#past.length > 200) this.#past.shift();
    this.#future = [];
  }

  #step(from, to) {
    if (from.length === 0) return;
    this.#gesture = null;
    to.push(this.#state);
    this.#state = from.pop();
    this.show(this.#state, { settled: true });
  }
}
