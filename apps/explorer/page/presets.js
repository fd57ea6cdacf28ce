// What one can choose to be shown, and what the thesis and the report say about it. The build puts both into the page.

import { kindOf } from "./prescribed.js";

/** The choices. */
export class Presets {
  /**
   * @param {{examples: Record<string, string>, tables: object[]}} data files, and the rows of Tables 5.3 to 5.5
   * @param {object} engine
   */
  constructor(data, engine) {
    this.data = data;
    this.engine = engine;
  }

  /** Puts the choices into a list. */
  fill(select) {
    const group = (label, options) => {
      const list = document.createElement("optgroup");
      list.label = label;
      list.append(...options.map(([value, text]) => new Option(text, value)));
      select.append(list);
    };
    group("Manipulators of the thesis", ["M1", "M2", "M3"].map((name) => [`${name}.toml`, name]));
    group("Printed designs", this.data.tables.map(({ table, workspace }) =>
      [`printed ${table} ${workspace}`, `Table ${table}, ${workspace}: printed design`]));
    const others = Object.keys(this.data.examples).filter((name) => !/^M\d/.test(name));
    group("Examples", others.map((name) => [name, name.replace(".toml", "").replaceAll("_", " ")]));
  }

  /** The tables of a problem file for a choice. */
  problem(choice) {
    const printed = /^printed (\S+) (\S+)$/.exec(choice);
    if (!printed) return this.engine.read(choice, this.data.examples[choice]);
    const row = this.data.tables.find(({ table, workspace }) => table === printed[1] && workspace === printed[2]);
    const problem = this.engine.read(row.file, this.data.examples[row.file]);
    return { ...problem, manipulator: { ...problem.manipulator, name: `printed design, Table ${row.table}, ${row.workspace}`, design: row.printed.design } };
  }

  /** The prescribed workspace of that name. */
  shape(name) {
    const file = `${name}.toml`;
    return this.data.examples[file] ? this.engine.read(file, this.data.examples[file]).workspace : null;
  }

  /** The row of the tables that a problem is about: the same region, the same orientations; undefined where there is none. */
  row({ manipulator, workspace, orientations }) {
    if (!manipulator.design || !workspace) return undefined;
    const asked = kindOf(orientations);
    return this.data.tables.find((row) => {
      if (row.workspace !== workspace.name) return false;
      const known = (row.problem ??= this.engine.read(row.file, this.data.examples[row.file]));
      const same = (one, other) => Math.abs(one - other) < 1e-9;
      const theirs = kindOf(known.orientations);
      const flat = (length) => length.flat();
      return asked.kind === theirs.kind &&
        asked.range.every((value, k) => same(value, theirs.range[k])) &&
        same(workspace.scale, known.workspace.scale) &&
        workspace.centre.every((value, k) => same(value, known.workspace.centre[k])) &&
        flat(manipulator.length).every((value, k) => same(value, flat(known.manipulator.length)[k]));
    });
  }
}
