// Opening and saving case files.

import { enter } from "../modes/modes";
import { restart } from "../modes/place";
import { withAnalysis } from "../modes/starting";
import { file as caseFile, open } from "../store/document";
import { MOST_OF_FOREIGN, MOST_OF_TEXT } from "../store/limits";
import { report, send } from "../store/session";
import { announce, text } from "../store/state";
import { texts } from "../texts";
import { choose } from "./choose";
import { download } from "./download";

/** The part of the File System Access API that some browsers have. */
interface Pickers {
  showOpenFilePicker?(options: object): Promise<FileSystemFileHandle[]>;
  showSaveFilePicker?(options: object): Promise<FileSystemFileHandle>;
}

const pickers = () => window as Pickers;
const TYPES = [{ description: "TOML", accept: { "application/toml": [".toml"] } }];
/** Files that the core makes a case of: JSON of kempe, and those of other tools. */
const FOREIGN = [".json", ".asmt", ".linkage2", ".dxf", ".adm", ".pmks"];
const READ = [{ description: "TOML", accept: { "application/toml": [".toml"], "text/plain": FOREIGN } }];

/** The text of a new case. */
export const EMPTY = `kempe = 1
title = "Mechanism"
gravity = [0, -9.81]

[bodies.ground]
points = {}
`;

/** Begin a case on an empty sheet, ready to draw. */
export async function begin(): Promise<void> {
  enter("edit");
  restart(null);
  await open(EMPTY);
}

export async function openFile(): Promise<void> {
  if (!pickers().showOpenFilePicker) return choose([".toml", "text/plain", ...FOREIGN].join(), take);
  await picked(async () => {
    const [handle] = await pickers().showOpenFilePicker!({ types: READ });
    if (handle) await take(await handle.getFile(), handle);
  });
}

/** Open a file that the user has chosen or dropped. */
export async function take(given: File, handle?: FileSystemFileHandle): Promise<void> {
  const own = given.name.toLowerCase().endsWith(".toml");
  if (given.size > (own ? MOST_OF_TEXT : MOST_OF_FOREIGN)) {
    announce("problem", own ? texts.core.tooLarge : texts.files.tooLarge(given.name));
    return;
  }
  try {
    if (own) await open(await given.text(), { name: given.name, ...(handle ? { handle } : {}) });
    else await convert(given);
  } catch (error) {
    report(error);
  }
}

/** Open the case in a file of another tool. It gets a file of its own, so that saving keeps that one. */
async function convert(given: File): Promise<void> {
  const content = decoded(await given.arrayBuffer(), given.name);
  if (content === null) {
    announce("problem", texts.files.noText(given.name));
    return;
  }
  const { ok } = await send("read", { text: content, name: given.name });
  const name = `${given.name.replace(/\.[^.]*$/, "")}.toml`;
  if (await open(ok.text, { name })) return;
  if (ok.lost) announce("problem", texts.files.lost(given.name, ok.lost));
}

/** The text of a file: UTF-8, UTF-16 with its mark, or for older drawings the code page of Windows; otherwise null. */
function decoded(bytes: ArrayBuffer, name: string): string | null {
  const head = new Uint8Array(bytes.slice(0, 4096));
  const mark = ((head[0] ?? 0) << 8) | (head[1] ?? 0);
  if (mark === 0xfffe || mark === 0xfeff)
    return new TextDecoder(mark === 0xfffe ? "utf-16le" : "utf-16be").decode(bytes);
  if (head.includes(0)) return null;
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return /\.dxf$/i.test(name) ? new TextDecoder("windows-1252").decode(bytes) : null;
  }
}

/** Write the case into its file, or with `elsewhere` into another one; a browser without file access offers a download. */
export async function saveFile(elsewhere = false): Promise<void> {
  await withAnalysis();
  const { name } = caseFile.value;
  const suggestedName = name.endsWith(".toml") ? name : `${name}.toml`;
  const { showSaveFilePicker } = pickers();
  if (!showSaveFilePicker) return download(suggestedName, text.value, "application/toml");
  await picked(async () => {
    const old = elsewhere ? undefined : caseFile.value.handle;
    const handle = old ?? (await showSaveFilePicker.call(window, { suggestedName, types: TYPES }));
    const stream = await handle.createWritable();
    await stream.write(text.value);
    await stream.close();
    caseFile.value = { name: handle.name, handle };
    announce("done", texts.files.saved(handle.name));
  });
}

/** Do something with a picked file. A dialog that the user has closed is not an error. */
async function picked(work: () => Promise<void>): Promise<void> {
  await work().catch((error: Error) => {
    if (error.name !== "AbortError") report(error);
  });
}
