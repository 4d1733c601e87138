// The worker holds the core and answers one request after the other.
import { coreTexts } from "../coreTexts";
import { type Core, instantiate } from "./memory";
import { unpacked } from "./unpack";

let core: Core | null = null;

type Incoming = { parts: Uint8Array<ArrayBuffer> } | { number: number; request: string };

/** Start the core from its taken-apart module. */
async function start(parts: Uint8Array<ArrayBuffer>): Promise<void> {
  core = await instantiate(unpacked(parts));
  postMessage({ ready: true });
}

function answer(number: number, request: string): void {
  if (!core) throw new Error(coreTexts.notReady);
  const { reply, numbers } = core.call(request);
  postMessage({ number, reply, numbers }, { transfer: [numbers.buffer] });
}

addEventListener("message", ({ data }: MessageEvent<Incoming>) => {
  if ("parts" in data) {
    start(data.parts).catch((fault: unknown) => postMessage({ failed: String(fault) }));
    return;
  }
  try {
    answer(data.number, data.request);
  } catch (fault) {
    postMessage({ failed: String(fault), number: data.number });
  }
});
