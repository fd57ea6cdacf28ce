// node apps/explorer/build.mjs MODULE PAGE
// Puts the explorer's page together, as one file that needs no other: its scripts and styles, the libraries as
// WebAssembly (MODULE.js and MODULE.wasm), the examples, and the rows of the tables.

import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, "..", "..");
const [module, page] = process.argv.slice(2).map((path) => resolve(path));
const text = (...path) => readFileSync(join(...path), "utf8");

/** A script with all that it imports. */
function bundle(name) {
  return execFileSync("esbuild", [
    join(here, "page", name), "--bundle", "--minify", "--format=iife", "--target=es2020", "--charset=utf8",
    "--log-level=warning", `--alias:engine-loader=${module}.js`,
  ], { encoding: "utf8", env: { ...process.env, NODE_PATH: "/usr/share/nodejs" } });
}

/** The rows of a table of data/, as objects from column to text. */
function rows(...path) {
  const [head, ...lines] = text(root, "data", ...path).trim().split("\n").filter((line) => !line.startsWith("#"));
  const names = head.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((value, k) => [names[k], value])));
}

const parameters = ["x_C", "y_C", "x_D", "x_E", "r"];
const designOf = (row) => parameters.map((name) => Number(row[name]));

/** What Tables 5.3 to 5.5 and the report say of every workspace. Misprints are read as the report reads them. */
function tableRows() {
  const kinds = { 5.3: "", 5.4: "_several", 5.5: "_dextrous" };
  const misprints = rows("published", "misprints.csv");
  const references = rows("reference", "reference_optimum.csv");
  const bounds = rows("reference", "global_optimum.csv");
  return Object.entries(kinds).flatMap(([table, ending]) =>
    rows("published", `table_${table.replace(".", "_")}.csv`).map((row) => {
      const { workspace } = row;
      for (const { item, case: which, quantity, read_as: value } of misprints) {
        if (item === `Table ${table}` && which === workspace) row[quantity] = value;
      }
      const own = (one) => one.table === table && one.workspace === workspace;
      return {
        table,
        workspace,
        file: `${workspace}${ending}.toml`,
        printed: { design: designOf(row), f: Number(row.f_star), g: Number(row.g_star), gradients: Number(row.N_g) },
        reference: { design: designOf(references.find(own)) },
        bound: Math.max(...bounds.filter(own).map(({ bound }) => Number(bound))),
      };
    }));
}

// The problem files; a study of a sweep is none.
const examples = Object.fromEntries(readdirSync(join(root, "examples"))
  .filter((name) => name.endsWith(".toml") && !name.startsWith("sweep_"))
  .map((name) => [name, text(root, "examples", name)]));

const parts = {
  style: text(here, "page", "style.css"),
  data: JSON.stringify({ examples, tables: tableRows() }),
  engine: gzipSync(readFileSync(`${module}.wasm`), { level: 9 }).toString("base64"),
  worker: bundle("worker.js"),
  script: bundle("main.js"),
};
const html = text(here, "page", "index.html").replace(/\/\*(\w+)\*\//g, (_, name) => parts[name].replace(/<(?=\/script|!--)/g, "<\\"));
mkdirSync(dirname(page), { recursive: true });
writeFileSync(page, html);
console.log(`${page}: ${Math.round(html.length / 1000)} kB, of which ${basename(module)}.wasm ${Math.round(parts.engine.length / 1000)} kB`);
