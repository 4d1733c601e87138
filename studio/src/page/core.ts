// The core in the page: base64 of the compressed module, for workers that are made from a text.
import source from "virtual:worker";
import type { Line } from "../core/transport";

/** The bytes of the core. */
export async function coreBytes(): Promise<ArrayBuffer> {
  const text = document.getElementById("core")!.textContent ?? "";
  const packed = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** A worker that has got the core. */
export function worker(bytes: ArrayBuffer): Line {
  const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const made = new Worker(address);
  URL.revokeObjectURL(address);
  made.postMessage({ bytes });
  return made as Line;
}
