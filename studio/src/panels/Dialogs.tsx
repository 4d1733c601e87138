// Dialogs: examples, sharing, keys.

import { begin } from "../guide/guide";
import { dialog } from "../store/state";
import { texts } from "../texts";
import { Dialog } from "./Dialog";
import { Gallery } from "./Gallery";
import { Button } from "./parts";
import { Share } from "./Share";

export function Dialogs() {
  const which = dialog.value;
  if (which === "gallery") return <Gallery />;
  if (which === "share") return <Share />;
  return which === "help" ? <Help /> : null;
}

function Help() {
  return (
    <Dialog title={texts.help.title}>
      <h3>{texts.guide.title}</h3>
      <p>{texts.guide.replaces}</p>
      <Button label={texts.guide.begin} kind="main" onClick={() => void begin()} id="help-guide" />
      <dl class="keys">
        {texts.help.keys.map(([key, what]) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <details id="licences-shown">
        <summary>{texts.help.licences}</summary>
        <pre>{document.getElementById("licences")?.textContent}</pre>
      </details>
    </Dialog>
  );
}
