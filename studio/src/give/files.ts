// Opening and saving case files.

import { enter } from "../modes/modes";
import { restart } from "../modes/place";
import { withAnalysis } from "../modes/starting";
import { file as caseFile, open } from "../store/document";
import { MOST_OF_TEXT } from "../store/limits";
import { report } from "../store/session";
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
  if (!pickers().showOpenFilePicker) return choose(".toml,text/plain", take);
  await picked(async () => {
    const [handle] = await pickers().showOpenFilePicker!({ types: TYPES });
    if (handle) await take(await handle.getFile(), handle);
  });
}

/** Open a file that the user has chosen or dropped. */
export async function take(given: File, handle?: FileSystemFileHandle): Promise<void> {
  if (given.size > MOST_OF_TEXT) {
    announce("problem", texts.core.tooLarge);
    return;
  }
  const of = { name: given.name, ...(handle ? { handle } : {}) };
  await given.text().then((found) => open(found, of), report);
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
