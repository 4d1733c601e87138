// The page in a frame of another page: the drawing, a slider, and a link to the whole page.
import { wholeLink } from "../give/link";
import { running } from "../modes/read";
import { message, problems, title, unassembled } from "../store/state";
import { texts } from "../texts";
import { Playback } from "./Playback";
import { Drawing } from "./Sheet";

export function Embed() {
  return (
    <main class="embed">
      <section class="panel sheet-panel" aria-label={texts.sheet.label(title.value || texts.untitled)}>
        <div class="space">
          <Drawing fixed />
        </div>
      </section>
      <Playback />
      <footer>
        <Trouble />
        <a href={wholeLink(location.href)} target="_blank" rel="noopener">
          {texts.share.open}
        </a>
      </footer>
    </main>
  );
}

/** What is wrong with the case or its run; there is no other place for it. */
function Trouble() {
  const said = message.value?.kind === "problem" ? message.value.text : null;
  const fault = said ?? (problems.value[0] ?? unassembled.value)?.message;
  if (fault) return <span class="problem">{fault}</span>;
  return <span role="status">{running.value ? texts.read.running : ""}</span>;
}
