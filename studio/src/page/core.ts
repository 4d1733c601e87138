// The core in the page, for workers that are made from a text.
import source from "virtual:worker";
import type { Line } from "../core/transport";

/** The taken-apart core, which boot.ts gives to the script of the program. */
export const parts = (document.currentScript as HTMLScriptElement & { parts: Uint8Array }).parts;

/** Start a worker and send it the core. */
export function worker(): Line {
  const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const made = new Worker(address);
  URL.revokeObjectURL(address);
  made.postMessage({ parts });
  return made as Line;
}
