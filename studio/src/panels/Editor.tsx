// The text of the case, with the core's problems at line and column.
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import {
  type Command,
  Decoration,
  type DecorationSet,
  drawSelection,
  EditorView,
  highlightActiveLine,
  keymap,
  lineNumbers,
  MatchDecorator,
  ViewPlugin,
} from "@codemirror/view";
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Problem } from "../core/protocol";
import { redo, type, undo } from "../store/document";
import { problems, text, unassembled } from "../store/state";
import { texts } from "../texts";

/** The text is read when nothing was typed for this time, ms. */
const PAUSE = 180;

const LOOK = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", color: "var(--text)", backgroundColor: "var(--panel)" },
  "&.cm-focused": { outline: "none" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "Liberation Mono", monospace', lineHeight: "1.5" },
  ".cm-content": { caretColor: "var(--text)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--soft)", border: "none" },
  ".cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--hover) 60%, transparent)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
    backgroundColor: "var(--select)",
  },
  ".cm-tooltip": {
    backgroundColor: "var(--panel)",
    color: "var(--text)",
    border: "1px solid var(--edge)",
    maxWidth: "420px",
  },
  ".cm-diagnostic": { padding: "6px 10px", borderLeft: "3px solid var(--problem)" },
  ".part1": { color: "var(--soft)", fontStyle: "italic" },
  ".part2": { color: "var(--velocities)" },
  ".part3": { color: "var(--accent)" },
  ".part4": { color: "var(--force)" },
  ".part5": { color: "var(--accelerations)" },
  ".cm-lintRange-error": {
    backgroundImage: "none",
    textDecoration: "underline wavy var(--problem)",
    textUnderlineOffset: "3px",
  },
});

/** Parts of a line of TOML: a comment, a text, a key or the name of a table, a word, a number. */
const PARTS =
  /(#.*)|("(?:[^"\\]|\\.)*"|'[^']*')|([\w.-]+(?=\s*=)|^\s*\[.*?\]+)|(\b(?:true|false)\b)|([-+]?\b\d[\w.+-]*)/g;
const marks = new MatchDecorator({
  regexp: PARTS,
  decoration: (found) => Decoration.mark({ class: `part${found.findIndex((one, k) => k > 0 && one !== undefined)}` }),
});
const colours = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;
    constructor(view: EditorView) {
      this.decorations = marks.createDeco(view);
    }
    update(update: Parameters<typeof marks.updateDeco>[0]) {
      this.decorations = marks.updateDeco(update, this.decorations);
    }
  },
  { decorations: ({ decorations }) => decorations },
);

const insert = (text: (view: EditorView) => string) => (view: EditorView) => {
  view.dispatch(view.state.replaceSelection(text(view)), { scrollIntoView: true, userEvent: "input" });
  return true;
};
/** The blanks at the start of the present line. */
const indent = ({ state }: EditorView) => /^\s*/.exec(state.doc.lineAt(state.selection.main.head).text)![0];
const removeSelected: Command = (view) => !view.state.selection.main.empty && insert(() => "")(view);
const go = (to: (view: EditorView) => number, from?: (view: EditorView) => number) => (view: EditorView) => {
  const head = to(view);
  view.dispatch({ selection: { anchor: from ? from(view) : head, head }, scrollIntoView: true });
  return true;
};
const page = (forward: boolean) => (view: EditorView) =>
  view.moveVertically(view.state.selection.main, forward, view.dom.clientHeight).head;
const anchor = ({ state }: EditorView) => state.selection.main.anchor;
const first = () => 0;
const last = ({ state }: EditorView) => state.doc.length;
const KEYS = [
  { key: "Enter", run: insert((view) => `\n${indent(view)}`) },
  { key: "Tab", run: insert(() => "  ") },
  { key: "Backspace", run: removeSelected },
  { key: "Delete", run: removeSelected },
  { key: "Mod-a", run: go(last, first) },
  { key: "Mod-Home", run: go(first), shift: go(first, anchor) },
  { key: "Mod-End", run: go(last), shift: go(last, anchor) },
  { key: "PageUp", run: go(page(false)), shift: go(page(false), anchor) },
  { key: "PageDown", run: go(page(true)), shift: go(page(true), anchor) },
];

export function Editor() {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => connect(host.current!), []);
  return <div class="editor" ref={host} />;
}

/** The editor is in a shadow root. Its styles are sheets made by the script, as the policy of the page requires. */
function connect(host: HTMLElement): () => void {
  const root = host.shadowRoot ?? host.attachShadow({ mode: "open" });
  const parent = document.createElement("div");
  parent.style.height = "100%";
  root.replaceChildren(parent);
  let timer: ReturnType<typeof setTimeout> | undefined;
  /** Take what was typed last, before anything else changes the text. */
  const flush = () => {
    if (timer === undefined) return;
    clear();
    void type(view.state.doc.toString());
  };
  const clear = () => {
    clearTimeout(timer);
    timer = undefined;
  };
  /** The history is that of the case; what was typed is a part of it. */
  const step = (_: EditorView, event: KeyboardEvent) => {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || !["y", "z"].includes(key)) return false;
    clear();
    void type(view.state.doc.toString()).then(key === "y" || event.shiftKey ? redo : undo);
    return true;
  };
  const listener = EditorView.updateListener.of((update) => {
    if (!update.docChanged) return;
    clear();
    if (update.transactions.some((one) => one.isUserEvent("outside"))) return;
    timer = setTimeout(flush, PAUSE);
  });
  const view = new EditorView({
    root,
    parent,
    state: EditorState.create({
      doc: text.peek(),
      extensions: [
        lineNumbers(),
        lintGutter(),
        drawSelection(),
        highlightActiveLine(),
        colours,
        LOOK,
        keymap.of([{ any: step }, ...KEYS]),
        listener,
        EditorView.contentAttributes.of({ "aria-label": texts.editor.label, tabindex: "0" }),
      ],
    }),
  });
  const stops = [
    effect(() => takeUp(view, text.value)),
    effect(() => {
      const found = [...problems.value, ...(unassembled.value ? [unassembled.value] : [])];
      text.value;
      view.dispatch(
        setDiagnostics(
          view.state,
          found.flatMap((one) => diagnostic(view.state, one)),
        ),
      );
    }),
  ];
  host.addEventListener("focusout", flush);
  return () => {
    host.removeEventListener("focusout", flush);
    flush();
    for (const stop of stops) stop();
    view.destroy();
  };
}

/** Show another text. Only the differing part is replaced, so that the cursor keeps its place. */
function takeUp(view: EditorView, given: string): void {
  const before = view.state.doc.toString();
  if (before === given) return;
  let from = 0;
  while (from < before.length && before[from] === given[from]) from += 1;
  let [to, end] = [before.length, given.length];
  while (to > from && end > from && before[to - 1] === given[end - 1]) [to, end] = [to - 1, end - 1];
  view.dispatch({ changes: { from, to, insert: given.slice(from, end) }, userEvent: "outside" });
}

function diagnostic(state: EditorState, problem: Problem): Diagnostic[] {
  if (!problem.line || problem.line > state.doc.lines) return [];
  const line = state.doc.line(problem.line);
  const from = Math.min(line.to, line.from + (problem.column ?? 1) - 1);
  const to = Math.min(line.to, from + Math.max(1, problem.length ?? line.to - from));
  const message = problem.hint ? `${problem.message}\n${problem.hint}` : problem.message;
  return [{ from, to: Math.max(from, to), severity: "error", message }];
}
