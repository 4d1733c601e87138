// The keyboard. A control that has the focus keeps the keys that it needs.

import { pushPose } from "../design/handler";
import { drop } from "../design/stroke";
import { active, removePose, stop } from "../design/task";
import { canPaste, pasteCopied, remove, takeCopy } from "../edit/commands";
import { openFile, saveFile } from "../give/files";
import { ghost } from "../guide/guide";
import { clickCursor, moveCursor } from "../modes/cursor";
import { push as pushSelected } from "../modes/edit";
import * as living from "../modes/live";
import { enter } from "../modes/modes";
import { push } from "../modes/move";
import { drawing, finish, restart } from "../modes/place";
import * as reading from "../modes/read";
import { awaitsClick, endScaling } from "../modes/scaling";
import type { Point } from "../plane/points";
import { scaling, shifting } from "../store/backdrop";
import { redo, undo } from "../store/document";
import { note } from "../store/note";
import { fit, pan, typedLength, view, zoom } from "../store/sheet";
import { dialog, MODES, mechanism, message, mode, selection, tool } from "../store/state";

export function listenToKeys(): void {
  document.addEventListener("keydown", (event) => {
    const target = event.composedPath()[0] as HTMLElement;
    if (dialog.value || keepsKeys(target, event.key)) return;
    const action = event.ctrlKey || event.metaKey ? withControl(event) : event.altKey ? null : plain(event);
    if (!action) return;
    event.preventDefault();
    action();
  });
}

function keepsKeys(target: HTMLElement, key: string): boolean {
  if (target.isContentEditable || target.tagName === "TEXTAREA" || target.tagName === "SELECT") return true;
  if (target.tagName === "BUTTON" || target.tagName === "SUMMARY") return key === " " || key === "Enter";
  if (target.tagName !== "INPUT") return false;
  const kind = (target as HTMLInputElement).type;
  if (kind === "checkbox") return key === " ";
  if (target.id === "typed-length") return !["Enter", "Escape"].includes(key);
  return key !== "Escape" && !(kind === "range" && key === " ");
}

function withControl(event: KeyboardEvent): (() => void) | null {
  const actions: Record<string, () => void> = {
    z: () => void (event.shiftKey ? redo() : undo()),
    y: () => void redo(),
    s: () => void saveFile(event.shiftKey),
    o: () => void openFile(),
    c: copySelection,
    v: pasteCopied,
  };
  const key = event.key.toLowerCase();
  if (key === "c" && selection.value?.group !== "bodies") return null;
  if (key === "v" && !canPaste()) return null;
  return actions[key] ?? null;
}

function copySelection(): void {
  if (selection.value) takeCopy(selection.value.name);
}

function plain(event: KeyboardEvent): (() => void) | null {
  const { key } = event;
  if (tool.value && drawing() && /^[\d.,]$/.test(key)) return () => typeLength(key);
  const number = ["1", "2", "3", "4", "5"].indexOf(key);
  if (number >= 0) return () => enter(MODES[number]!);
  const actions: Record<string, () => void> = {
    Escape: stopAll,
    Enter: () => void finish(),
    Delete: removeSelected,
    Backspace: removeSelected,
    "+": () => zoom(1.25),
    "=": () => zoom(1.25),
    "-": () => zoom(0.8),
    "0": fit,
    "?": () => (dialog.value = "help"),
    " ": toggle,
  };
  const steps: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const step = steps[key];
  if (step && event.shiftKey) return () => pan(...step);
  if (step && drawsByKeys()) return () => moveCursor(suggested(), ...step);
  if (key === " " && drawsByKeys()) return () => clickCursor(suggested());
  if (step && mode.value === "move") return () => void push(...step);
  if (step && mode.value === "live") return () => void living.pullBy(...step);
  if (step && mode.value === "design") return () => pushPose(...step);
  if (step && mode.value === "edit" && selection.value) return () => void pushSelected(...step);
  if (step && mode.value === "read" && step[0]) return () => reading.show(reading.time.value + step[0] * frame());
  return actions[key] ?? null;
}

function removeSelected(): void {
  if (mode.value === "edit") void remove();
  if (mode.value === "design" && active.value !== null) void removePose(active.value);
}

function drawsByKeys(): boolean {
  return mode.value === "edit" && (tool.value !== null || awaitsClick());
}

/** The start of drawing by keys: the next mark of the first build, otherwise the middle of the sheet. */
function suggested(): Point {
  const marks = ghost.value?.at ?? [];
  return marks[drawing() ? 1 : 0] ?? marks[0] ?? view.toPlane(view.middle());
}

/** The time between two states of a run. */
function frame(): number {
  const t = reading.course.value?.t;
  return t && t.length > 1 ? (t.at(-1)! - t[0]!) / (t.length - 1) : 0;
}

function typeLength(key: string): void {
  typedLength.value += key;
  const input = document.getElementById("typed-length") as HTMLInputElement | null;
  input?.focus();
}

function stopAll(): void {
  living.letGo();
  note.value = null;
  if (scaling.value || shifting.value) endScaling();
  if (tool.value) restart(drawing() ? tool.value : null);
  else selection.value = null;
  active.value = null;
  drop();
  void stop();
  message.value = null;
  (document.activeElement as HTMLElement | null)?.blur();
}

function toggle(): void {
  const driven = mode.value === "move" && mechanism.value?.drivers.length;
  if (mode.value === "live" || driven) living.toggle();
  if (mode.value === "read") reading.toggle();
}
