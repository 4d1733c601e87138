// The line at the bottom: the last message, and a summary of the mechanism.
import { blamed, type Part, plainly } from "../store/blame";
import { past, undo } from "../store/document";
import { mechanism, message, mobility, panel, problems, ready, selection, unassembled } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";
import { Units } from "./Units";

export function Status() {
  return (
    <footer>
      <div class="message" role="status" aria-live="polite" id="message">
        <Message />
      </div>
      <div class="standing">
        <Facts />
        <Units />
      </div>
    </footer>
  );
}

function Message() {
  const given = message.value;
  if (!given) return ready.value ? <Standing /> : <span>{texts.starting}</span>;
  return (
    <span class={given.kind}>
      {given.text}
      {given.hint ? <span class="hint"> {given.hint}</span> : null}
      {given.action ? (
        <button type="button" class="link" onClick={() => given.action!.run()}>
          {given.action.label}
        </button>
      ) : null}
      <Button label={texts.status.dismiss} icon="close" kind="small" onClick={() => (message.value = null)} />
    </span>
  );
}

/** The first problem of the text, shown if there is no message. */
function Standing() {
  const problem = problems.value[0] ?? unassembled.value;
  if (!problem) return null;
  const show = () => (panel.value = "text");
  return (
    <span class="problem">
      {plainly(problem.message)}
      {problem.hint ? <span class="hint"> {problem.hint}</span> : null}
      <Remedies />
      {problem.line ? (
        <button type="button" class="link" onClick={show}>
          {texts.status.at(problem.line, problem.column ?? null)}
        </button>
      ) : null}
    </span>
  );
}

/** The parts that a fault names, as links to their properties, and the way back. */
function Remedies() {
  return (
    <>
      {blamed.value.slice(0, MOST).map((part) => (
        <button key={part.name} type="button" class="link" onClick={() => show(part)}>
          {part.name}
        </button>
      ))}
      {past.value.length ? (
        <button type="button" class="link" id="remedy-undo" onClick={() => void undo()}>
          {texts.status.undo}
        </button>
      ) : null}
    </>
  );
}

/** Parts that are offered at most. */
const MOST = 4;

function show(part: Part): void {
  selection.value = part;
  panel.value = "properties";
}

function Facts() {
  const found = mechanism.value;
  if (!found) return null;
  const words = texts.status;
  const count = mobility.value?.redundant.length ?? 0;
  const freedom = mobility.value?.degrees_of_freedom ?? found.degrees_of_freedom;
  const loops = mobility.value?.four_bars ?? [];
  return (
    <>
      {unassembled.value ? <span class="problem">{words.open}</span> : null}
      {mobility.value?.singular.length ? <span class="problem">{words.singular}</span> : null}
      {count ? <span>{words.redundant(count)}</span> : null}
      {found.warnings.length ? (
        <span title={found.warnings.join("\n")}>{words.warnings(found.warnings.length)}</span>
      ) : null}
      {loops.length === 1 ? <span id="grashof">{loops[0]!.kind}</span> : null}
      <span>{words.bodies(found.bodies.length - 1)}</span>
      <span id="freedom">{freedom === null ? "" : words.freedom(freedom)}</span>
    </>
  );
}
