// Puts the page together.

import { render } from "preact";
import { failed } from "./coreTexts";
import { examples } from "./gallery/examples";
import { EMPTY, take } from "./give/files";
import { isFramed, textOf } from "./give/link";
import { enter } from "./modes/modes";
import { worker } from "./page/core";
import { kempe } from "./page/interface";
import { listenToKeys } from "./page/keyboard";
import { Page } from "./page/Page";
import { open, take as show } from "./store/document";
import { greet, isFirstVisit } from "./store/greeting";
import { begunWith, keep, restored, tellApart } from "./store/kept";
import { connect } from "./store/session";
import { announce } from "./store/state";
import { texts } from "./texts";
import "./style/colours.css";
import "./style/page.css";
import "./style/drawing.css";
import "./style/parts.css";
import "./style/panels.css";
import "./style/design.css";
import "./style/phone.css";

const FIRST = "four_bar";
/** The example that moves at the first visit. */
const WELCOME = "walker";
/** Whether this page is in a frame of another page. */
const framed = isFramed(location.hash);

/** The text that `kempe studio FILE` has written into the page, or null. */
function ownText(): string | null {
  return JSON.parse(document.getElementById("case")?.textContent ?? "null") as string | null;
}

/** The text of the link or of the page; null without one, undefined if the link is damaged. */
function givenText(): string | null | undefined {
  try {
    return textOf(location.hash) ?? ownText();
  } catch {
    return undefined;
  }
}

function first(wanted = FIRST): string {
  return examples.find(({ name }) => name === wanted)?.text ?? EMPTY;
}

/** Open and run the case of a frame. Its tab has the work of other pages, which stays as it is. */
async function beginFramed(): Promise<void> {
  const given = givenText();
  if (given === undefined) return announce("problem", texts.share.damaged);
  await open(given ?? first());
  enter("read");
}

/**
 * Open the text of the link, the text of the page, or an example, unless this tab has begun with it. At the first visit
 * the example moves.
 */
async function begin(): Promise<void> {
  const given = givenText();
  const source = given ?? "";
  const kept = restored();
  if (kept) {
    await show(kept.text, false);
    if (kept.source === source) enter(kept.mode);
  }
  const greets = isFirstVisit() && !kept && given === null;
  if (kept?.source !== source) await open(given ?? first(greets ? WELCOME : FIRST));
  if (greets) {
    enter("live");
    greet();
  }
  begunWith(source);
  keep();
  tellApart(kept !== null);
  if (given === undefined) announce("problem", texts.share.damaged);
}

/** Open the text of another link. */
async function follow(): Promise<void> {
  if (framed || isFramed(location.hash)) return location.reload();
  const given = givenText();
  if (given) {
    await open(given);
    begunWith(given);
  } else if (given === undefined) announce("problem", texts.share.damaged);
}

async function start(): Promise<void> {
  connect(worker);
  await (framed ? beginFramed() : begin());
}

render(<Page framed={framed} />, document.getElementById("page")!);
if (!framed) listenToKeys();
addEventListener("hashchange", () => void follow());
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  const file = event.dataTransfer?.files[0];
  if (file && !framed) void take(file);
});
Object.defineProperty(window, "kempe", { value: Object.freeze(kempe) });
start().catch(() => announce("problem", failed));
