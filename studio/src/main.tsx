// Puts the page together.

import { examples } from "virtual:examples";
import { render } from "preact";
import { EMPTY, take } from "./give/files";
import { textOf } from "./give/link";
import { packedCore, worker } from "./page/core";
import { kempe } from "./page/interface";
import { listenToKeys } from "./page/keyboard";
import { Page } from "./page/Page";
import { open } from "./store/document";
import { connect } from "./store/session";
import { announce } from "./store/state";
import { texts } from "./texts";
import "./style/colours.css";
import "./style/page.css";
import "./style/drawing.css";
import "./style/parts.css";
import "./style/panels.css";
import "./style/phone.css";

const FIRST = "four_bar";

/** The text that `kempe studio FILE` has written into the page, or null. */
function ownText(): string | null {
  return JSON.parse(document.getElementById("case")?.textContent ?? "null") as string | null;
}

/** The first text: from the link, from the page, or from the first example. */
async function begin(): Promise<void> {
  let given: string | null = null;
  let damaged = false;
  try {
    given = textOf(location.hash);
  } catch {
    damaged = true;
  }
  await open(given ?? ownText() ?? examples.find(({ name }) => name === FIRST)?.text ?? EMPTY);
  if (damaged) announce("problem", texts.share.damaged);
}

async function start(): Promise<void> {
  const packed = packedCore();
  connect(() => worker(packed));
  await begin();
}

render(<Page />, document.getElementById("page")!);
listenToKeys();
addEventListener("hashchange", () => void begin());
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  const file = event.dataTransfer?.files[0];
  if (file) void take(file);
});
Object.defineProperty(window, "kempe", { value: Object.freeze(kempe) });
start().catch(() => announce("problem", texts.failed));
