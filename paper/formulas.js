// Sets formulas for the printed report with KaTeX, for filters/print.lua: one formula in TeX per line of the input, with D (on a
// line of its own) or I (in a line of text) and a blank before it; one line of HTML for each in the output.
//
//   node formulas.js FOLDER    with the folder of KaTeX's package
"use strict";
const katex = require(process.argv[2]);
const lines = require("fs").readFileSync(0, "utf8").split("\n").filter((line) => line !== "");
for (const line of lines) {
  const formula = line.slice(2);
  try {
    const html = katex.renderToString(formula, { displayMode: line[0] === "D", output: "html", strict: "error" });
    process.stdout.write(html.replace(/\n/g, " ") + "\n");
  } catch (error) {
    process.stderr.write("paper: the formula '" + formula + "' cannot be set: " + error.message.split("\n")[0] + "\n");
    process.exit(1);
  }
}
