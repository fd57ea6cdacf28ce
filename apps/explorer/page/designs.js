// The table of designs for the problem shown: the present one, the one found, the printed one and the reference, each
// judged alike, and a click away.

import { short } from "./panel.js";

/** The table. */
export class Designs {
  /**
   * @param {HTMLTableElement} table
   * @param {object} engine
   * @param {(manipulator: object) => void} adopt
   */
  constructor(table, engine, adopt) {
    this.body = table.tBodies[0];
    this.engine = engine;
    this.adopt = adopt;
  }

  /**
   * Judges and lists the designs.
   * @param {object} problem
   * @param {{found: object | null, row: object | undefined}} known the answer of a search, and the row of the tables
   */
  show(problem, { found, row }) {
    if (!problem.workspace) {
      this.body.replaceChildren();
      return;
    }
    const listed = [{ name: "shown now", manipulator: problem.manipulator }];
    if (found) listed.push({ name: "found", manipulator: found.manipulator, gradients: found.gradient_evaluations });
    if (row) {
      const of = (design) => ({ ...problem.manipulator, design });
      listed.push({ name: "printed", manipulator: of(row.printed.design), gradients: row.printed.gradients });
      listed.push({ name: "reference", manipulator: of(row.reference.design) });
    }
    this.body.replaceChildren(...listed.map((one) => this.#line(problem, one, row?.bound)));
  }

  #line(problem, { name, manipulator, gradients }, bound) {
    const line = document.createElement("tr");
    line.dataset.design = name;
    const [{ kappa_inv: f }, { constraint: g }] = this.engine.ask({ ...problem, manipulator }, [
      { command: "assessment" },
      { command: "design" },
    ]);
    const first = document.createElement("td");
    if (name === "shown now") {
      first.textContent = name;
    } else {
      const button = document.createElement("button");
      button.textContent = name;
      button.title = `Show the ${name} design`;
      button.addEventListener("click", () => this.adopt(manipulator));
      first.append(button);
    }
    const cell = (value, text) => {
      const made = document.createElement("td");
      made.textContent = text;
      made.dataset.value = value ?? "";
      return made;
    };
    const gap = bound === undefined ? undefined : bound - f;
    line.append(first, cell(f, short(f, 5)), cell(g, short(g, 2)), cell(gap, gap === undefined ? "" : short(gap, 2)),
      cell(gradients, gradients ?? ""));
    return line;
  }
}
