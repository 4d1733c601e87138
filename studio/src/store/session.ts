// The session with the core. It sends the text, and stores the mechanism that comes back.
import { batch } from "@preact/signals";
import { readCatalogue } from "../catalogue/catalogue";
import type { Answer, Change, Do, Loaded, Requests } from "../core/protocol";
import { CoreError, type Line, Restarted, Superseded, Transport } from "../core/transport";
import { texts } from "../texts";
import { plainly } from "./blame";
import {
  announce,
  catalogue,
  home,
  items,
  loads,
  mechanism,
  mobility,
  pose,
  problems,
  ready,
  scene,
  text,
  tree,
  unassembled,
} from "./state";

/** After this number of checks without an open request, everything is answered. */
const QUIET = 5;
let transport: Transport | null = null;
let beginning: (() => Line) | null = null;
/** The last text that the core read without a trap. */
let accepted = "";
let size: [number, number] = [800, 600];
/** The newest fetch of the static part of the drawing. */
let fetching: Promise<void> = Promise.resolve();

/** Connect to a worker with the core. */
export function connect(begin: () => Line, limit?: number): void {
  beginning = begin;
  transport = new Transport(begin, restarted, limit);
  void send("catalogue", {}).then(({ ok }) => {
    catalogue.value = readCatalogue(ok);
    ready.value = true;
  }, report);
}

/** A core beside that of the sheet, for pictures of other mechanisms. */
export function another(): Transport {
  return new Transport(beginning!, () => {});
}

function restarted(reason: "trap" | "timeout"): void {
  announce("problem", reason === "trap" ? texts.core.trapped : texts.core.tooLong);
  if (accepted) void load(accepted).catch(() => {});
}

/** Send a request to the core. */
export function send<D extends Do>(
  what: D,
  fields: Requests[D]["send"],
  channel?: string,
): Promise<Answer<Requests[D]["reply"]>> {
  if (!transport) return Promise.reject(new Error(texts.core.notConnected));
  return transport.send(what, fields, channel ?? null);
}

/** Resolves when the core has answered all requests, also those that followed from other answers. */
export async function settled(): Promise<void> {
  for (let quiet = 0; quiet < QUIET; quiet += 1) {
    await new Promise((done) => setTimeout(done, 10));
    if (transport?.busy) quiet = 0;
  }
}

/** An error in words. */
export function reason(error: unknown): string {
  if (error instanceof Restarted) return error.cause === "trap" ? texts.core.trapped : texts.core.tooLong;
  if (error instanceof Superseded) return texts.core.replaced;
  return String((error as Error)?.message ?? error);
}

/** Show an error in the status line; those of replaced requests are none. */
export function report(error: unknown): void {
  if (error instanceof Superseded || error instanceof Restarted) return;
  if (error instanceof CoreError) {
    const { message, hint } = error.problem;
    announce("problem", plainly(message), hint ? { hint } : {});
  } else announce("problem", reason(error));
}

/** Let the core read a text, and show the result. */
export async function load(given: string): Promise<Loaded> {
  const { ok } = await send("load", { text: given }, "load");
  accepted = given;
  show(ok);
  if (ok.mechanism) await redraw();
  return ok;
}

function show(found: Loaded): void {
  batch(() => {
    loads.value += 1;
    problems.value = found.problems ?? [];
    unassembled.value = found.unassembled ?? null;
    if (found.case) tree.value = found.case;
    if (found.mechanism) {
      mechanism.value = found.mechanism;
      home.value = found.pose;
      pose.value = found.pose;
    }
  });
}

/** Fetch the static part of the drawing again, after a change of the model or of the size of the canvas. */
export async function redraw(): Promise<void> {
  fetching = fetchDrawing();
  let waited: Promise<void>;
  do {
    // A newer fetch replaces requests of this one.
    waited = fetching;
    await waited;
  } while (waited !== fetching);
}

async function fetchDrawing(): Promise<void> {
  if (!mechanism.value) return;
  const [width, height] = size;
  const answers = await Promise.allSettled([
    send("scene", {}, "scene"),
    send("display", { width, height, names: true, numbers: true }, "display"),
    send("mobility", {}, "mobility"),
  ]);
  const [found, list, freedom] = answers;
  batch(() => {
    if (found.status === "fulfilled") scene.value = found.value.ok.scene;
    if (list.status === "fulfilled") items.value = list.value.ok.items;
    else if (!(list.reason instanceof Superseded)) items.value = [];
    if (freedom.status === "fulfilled") mobility.value = freedom.value.ok;
    else if (!(freedom.reason instanceof Superseded)) mobility.value = null;
  });
}

/** Bring the core and the drawing back to the start of the text. */
export async function goHome(): Promise<void> {
  if (accepted) await load(accepted).catch(report);
}

/** Show the pose of the core, after poses of a run were shown. */
export async function showPresent(): Promise<void> {
  await send("pose", {}).then(({ ok }) => (pose.value = ok), report);
}

/** Take up a new size of the drawing. */
export function resized(width: number, height: number): void {
  size = [Math.round(width), Math.round(height)];
  void redraw().catch(report);
}

/** The text with some changes, as the core writes it. */
export async function edited(changes: Change[]): Promise<string> {
  if (accepted !== text.value) await load(text.value);
  const { ok } = await send("edit", { changes });
  return ok.text;
}

export { Superseded };
