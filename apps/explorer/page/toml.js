// Problem files: the page's problem is an object with the tables and keys of apps/reprise/input.md, and this writes it as
// the file that `reprise` reads. Reading is left to the engine, which has the reader of `reprise`.

/** A text in double quotes, as TOML has it. */
function quoted(text) {
  return `"${text.replace(/[\\"]/g, "\\$&")}"`;
}

/** A value that is no table. */
function valueText(value) {
  if (Array.isArray(value)) return `[${value.map(valueText).join(", ")}]`;
  return typeof value === "string" ? quoted(value) : String(value);
}

/** Whether a value is a table, or a list of tables. */
const isTable = (value) => typeof value === "object" && !Array.isArray(value);
const isTables = (value) => Array.isArray(value) && value.length > 0 && isTable(value[0]);

/** The lines of a table under its head, nested tables last. */
function tableLines(head, table) {
  const name = head.replace(/[[\]]/g, "");
  const entries = Object.entries(table);
  const lines = [head];
  for (const [key, value] of entries) {
    if (!isTable(value) && !isTables(value)) lines.push(`${key} = ${valueText(value)}`);
  }
  for (const [key, value] of entries) {
    if (isTable(value)) lines.push("", ...tableLines(`[${name}.${key}]`, value));
    if (isTables(value)) for (const one of value) lines.push("", ...tableLines(`[[${name}.${key}]]`, one));
  }
  return lines;
}

/**
 * The text of a problem file.
 * @param {object} problem its tables: manipulator and, for a problem, workspace, orientations and design
 * @returns {string}
 */
export function toToml(problem) {
  return Object.entries(problem)
    .map(([name, table]) => `${tableLines(`[${name}]`, table).join("\n")}\n`)
    .join("\n");
}
