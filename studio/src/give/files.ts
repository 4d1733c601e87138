// Opening and saving case files.

import { restart } from "../modes/place";
import { fileName, open } from "../store/document";
import { MOST_OF_TEXT } from "../store/limits";
import { report } from "../store/session";
import { announce, text } from "../store/state";
import { texts } from "../texts";
import { choose } from "./choose";
import { download } from "./download";

/** The text of a new case. */
export const EMPTY = `kempe = 1
title = "Mechanism"
gravity = [0, -9.81]

[bodies.ground]
points = {}
`;

export async function begin(): Promise<void> {
  restart(null);
  await open(EMPTY);
}

export function openFile(): void {
  choose(".toml,text/plain", take);
}

/** Open a file that the user has chosen or dropped. */
export async function take(file: File): Promise<void> {
  if (file.size > MOST_OF_TEXT) {
    announce("problem", texts.core.tooLarge);
    return;
  }
  await file.text().then((given) => open(given, file.name), report);
}

export function saveFile(): void {
  const name = fileName.value.endsWith(".toml") ? fileName.value : `${fileName.value}.toml`;
  download(name, text.value, "application/toml");
}
