// The core in the page: base64 of the compressed module, for workers that are made from a text.
import source from "virtual:worker";
import type { Line } from "../core/transport";

/** The compressed core, read from the page. */
export function packedCore(): Uint8Array {
  const text = document.getElementById("core")!.textContent ?? "";
  return Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
}

/** Start a worker and send it the core. */
export function worker(packed: Uint8Array): Line {
  const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const made = new Worker(address);
  URL.revokeObjectURL(address);
  made.postMessage({ packed });
  return made as Line;
}
