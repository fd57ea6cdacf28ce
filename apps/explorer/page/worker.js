// The search for the best design, in a worker of its own, so that the page never waits for it.

import { Engine, Refusal } from "./engine.js";

self.onmessage = async ({ data: { code, problem, formulation } }) => {
  try {
    const engine = await Engine.start(code, {}, (iterate) => self.postMessage({ iterate }));
    self.postMessage({ found: engine.search(problem, formulation) });
  } catch (error) {
    self.postMessage({ refusal: error instanceof Refusal ? error.message : `The search failed: ${error.message}` });
  }
};
