// The only script that the page contains as it is: it unpacks the program and the core, and starts the program. The policy of the
// page allows the program by its hash.
import { XzReadableStream } from "xz-decompress";
import { failed } from "./coreTexts";

/** The program and the taken-apart core: the length of the program, four bytes, then both. */
async function unpacked(): Promise<{ program: string; parts: Uint8Array }> {
  const text = document.getElementById("packed")!.textContent!;
  const packed = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const all = await new Response(new XzReadableStream(new Blob([packed]).stream())).arrayBuffer();
  const length = new DataView(all).getUint32(0, true);
  return {
    program: new TextDecoder().decode(new Uint8Array(all, 4, length)),
    parts: new Uint8Array(all, 4 + length),
  };
}

unpacked()
  .then(({ program, parts }) => {
    const script = Object.assign(document.createElement("script"), { id: "program", textContent: program, parts });
    document.body.append(script);
  })
  .catch(() => {
    document.getElementById("page")!.textContent = failed;
  });
