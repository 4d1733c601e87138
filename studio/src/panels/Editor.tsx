// The text of the case, with the core's problems at line and column.
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Problem } from "../core/protocol";
import { type } from "../store/document";
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
  ".cm-lintRange-error": {
    backgroundImage: "none",
    textDecoration: "underline wavy var(--problem)",
    textUnderlineOffset: "3px",
  },
});

const COLOURS = HighlightStyle.define([
  { tag: tags.comment, color: "var(--soft)", fontStyle: "italic" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--velocities)" },
  { tag: tags.number, color: "var(--accelerations)" },
  { tag: [tags.propertyName, tags.variableName], color: "var(--accent)" },
  { tag: tags.atom, color: "var(--force)" },
]);

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
  const listener = EditorView.updateListener.of((update) => {
    if (!update.docChanged) return;
    clearTimeout(timer);
    if (update.transactions.some((one) => one.isUserEvent("outside"))) return;
    timer = setTimeout(() => void type(update.state.doc.toString()), PAUSE);
  });
  const view = new EditorView({
    root,
    parent,
    state: EditorState.create({
      doc: text.peek(),
      extensions: [
        lineNumbers(),
        lintGutter(),
        history(),
        drawSelection(),
        highlightActiveLine(),
        StreamLanguage.define(toml),
        syntaxHighlighting(COLOURS),
        LOOK,
        keymap.of([indentWithTab, ...defaultKeymap, ...historyKeymap]),
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
  return () => {
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
