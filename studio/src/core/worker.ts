// The worker holds the core and answers one request after the other.
import { XzReadableStream } from "xz-decompress";
import { coreTexts } from "../coreTexts";
import { type Core, instantiate } from "./memory";
import { unpacked } from "./unpack";

let core: Core | null = null;

type Incoming = { packed: Uint8Array<ArrayBuffer> } | { number: number; request: string };

/** Start the core from its module, which is taken apart and compressed as xz. */
async function start(packed: Uint8Array<ArrayBuffer>): Promise<void> {
  const parts = new XzReadableStream(new Blob([packed]).stream());
  core = await instantiate(unpacked(new Uint8Array(await new Response(parts).arrayBuffer())));
  postMessage({ ready: true });
}

function answer(number: number, request: string): void {
  if (!core) throw new Error(coreTexts.notReady);
  const { reply, numbers } = core.call(request);
  postMessage({ number, reply, numbers }, { transfer: [numbers.buffer] });
}

addEventListener("message", ({ data }: MessageEvent<Incoming>) => {
  if ("packed" in data) {
    start(data.packed).catch((fault: unknown) => postMessage({ failed: String(fault) }));
    return;
  }
  try {
    answer(data.number, data.request);
  } catch (fault) {
    postMessage({ failed: String(fault), number: data.number });
  }
});
