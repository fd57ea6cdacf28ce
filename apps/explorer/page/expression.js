// Numbers as papers print them, "10*sqrt(3)/3", for the reader of problem files (reprise/io/expression.hpp).

const number = String.raw`(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])`;
const parts = new RegExp(String.raw`^(?:\s|${number}|(?:sqrt|sin|cos)\s*(?=\()|pi(?!\w)|[-+*/()])*$`);
/** What means something in JavaScript alone: powers, comments, steps up and down. */
const foreign = /\*\s*\*|\/\s*[*/]|\+\s*\+|-\s*-/;
const longest = 1000;

/**
 * The value of an expression of decimal numbers, + - * / ( ), sqrt(x), sin(x), cos(x) with x in degrees, and pi; NaN for
 * anything else. JavaScript itself evaluates what consists of these alone.
 * @param {string} text
 * @param {(degrees: number) => number} sine
 * @param {(degrees: number) => number} cosine
 */
export function evaluate(text, sine, cosine) {
  if (text.length > longest || !parts.test(text) || foreign.test(text)) return NaN;
  const decimal = text.replace(/(^|[^\d.])0+(?=\d)/g, "$1");
  try {
    return Number(Function("sqrt", "sin", "cos", "pi", `return (${decimal});`)(Math.sqrt, sine, cosine, Math.PI));
  } catch {
    return NaN;
  }
}
