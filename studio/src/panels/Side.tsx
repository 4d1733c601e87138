// The panel at the side: the panel of the mode, the text, and on phones the palette.
import { DesignPanel } from "../design/Panel";
import { ExercisePanel } from "../exercise/Panel";
import { has } from "../exercise/questions";
import { phase } from "../guide/guide";
import { dismiss, hint } from "../store/hints";
import { mode, panel, problems } from "../store/state";
import { texts } from "../texts";
import { Editor } from "./Editor";
import { LivePanel } from "./LivePanel";
import { MovePanel } from "./MovePanel";
import { Palette } from "./Palette";
import { Properties } from "./Properties";
import { Button } from "./parts";
import { ReadPanel } from "./ReadPanel";

export function Side() {
  const main = mode.value === "edit" ? "properties" : "results";
  const label = mode.value === "edit" ? texts.tabs.properties : texts.modes[mode.value];
  const shown = tabOf();
  const count = problems.value.length;
  const named: Partial<Record<string, string>> = { text: texts.tabs.text, questions: texts.exercise.title };
  return (
    <aside class="panel side">
      <div class="tabs" role="tablist">
        {mode.value === "edit" ? (
          <Tab
            id="insert"
            label={texts.tabs.insert}
            chosen={shown === "insert"}
            next={phase.value === "tool" && shown !== "insert"}
            onClick={() => (panel.value = "insert")}
          />
        ) : null}
        <Tab id="main" label={label} chosen={shown === "main"} onClick={() => (panel.value = main)} />
        {has.value ? (
          <Tab
            id="questions"
            label={texts.exercise.title}
            chosen={shown === "questions"}
            onClick={() => (panel.value = "questions")}
          />
        ) : null}
        <Tab
          id="text"
          label={count ? `${texts.tabs.text} (${texts.editor.problems(count)})` : texts.tabs.text}
          chosen={shown === "text"}
          onClick={() => (panel.value = "text")}
        />
      </div>
      <FirstTime />
      <div class="tab-body" role="tabpanel" aria-label={named[shown] ?? label} tabIndex={-1}>
        {shown === "text" ? (
          <Editor />
        ) : shown === "insert" ? (
          <Palette />
        ) : shown === "questions" ? (
          <ExercisePanel />
        ) : (
          <Main />
        )}
      </div>
    </aside>
  );
}

/** The tab that is shown. */
function tabOf(): "text" | "insert" | "questions" | "main" {
  const now = panel.value;
  if (now === "text") return now;
  if (now === "insert" && mode.value === "edit") return now;
  return now === "questions" && has.value ? now : "main";
}

/** One sentence about a mode or a tool at its first use. */
function FirstTime() {
  const one = hint.value;
  if (!one) return null;
  return (
    <p class="first-time" role="note" id="hint">
      {texts.hints.all[one]}
      <Button label={texts.hints.dismiss} icon="close" kind="small" onClick={() => dismiss(one)} />
    </p>
  );
}

interface TabProps {
  id: string;
  label: string;
  chosen: boolean;
  /** Whether it is marked as the next step of the first build. */
  next?: boolean;
  onClick(): void;
}

function Tab({ id, label, chosen, next, onClick }: TabProps) {
  const kind = `tab-${id}${next ? " next" : ""}`;
  return (
    <button type="button" role="tab" id={`tab-${id}`} class={kind} aria-selected={chosen} onClick={onClick}>
      {label}
    </button>
  );
}

function Main() {
  if (mode.value === "move") return <MovePanel />;
  if (mode.value === "live") return <LivePanel />;
  if (mode.value === "design") return <DesignPanel />;
  return mode.value === "read" ? <ReadPanel /> : <Properties />;
}
