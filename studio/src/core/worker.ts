// The worker: it holds the core and answers one request after the other.
import { type Core, instantiate } from "./memory";

let core: Core | null = null;

type Incoming = { bytes: ArrayBuffer } | { number: number; request: string };

async function start(bytes: ArrayBuffer): Promise<void> {
  core = await instantiate(bytes);
  postMessage({ ready: true });
}

function answer(number: number, request: string): void {
  if (!core) throw new Error("the core is not ready");
  const { reply, numbers } = core.call(request);
  postMessage({ number, reply, numbers }, { transfer: [numbers.buffer] });
}

addEventListener("message", ({ data }: MessageEvent<Incoming>) => {
  if ("bytes" in data) {
    start(data.bytes).catch((fault: unknown) => postMessage({ failed: String(fault) }));
    return;
  }
  try {
    answer(data.number, data.request);
  } catch (fault) {
    postMessage({ failed: String(fault), number: data.number });
  }
});
