// The state in the page's address, behind the #: packed, and written with letters, digits, - and _ alone.

const format = "deflate-raw";

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

/** The part behind the # for a state. */
export async function toHash(state) {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream(format));
  return btoa(String.fromCharCode(...bytes)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The state of such a part; null where it is none. */
export async function fromHash(hash) {
  try {
    const letters = atob(hash.replace(/^#/, "").replace(/-/g, "+").replace(/_/g, "/"));
    const bytes = await through(Uint8Array.from(letters, (letter) => letter.charCodeAt(0)), new DecompressionStream(format));
    const state = JSON.parse(new TextDecoder().decode(bytes));
    return state?.problem?.manipulator && state.pose ? state : null;
  } catch {
    return null;
  }
}
