// Dialogs: examples, sharing, keys.

import { examples } from "virtual:examples";
import { begin } from "../guide/guide";
import { open } from "../store/document";
import { dialog } from "../store/state";
import { texts } from "../texts";
import { Dialog } from "./Dialog";
import { Button } from "./parts";
import { Share } from "./Share";

export function Dialogs() {
  const which = dialog.value;
  if (which === "gallery") return <Gallery />;
  if (which === "share") return <Share />;
  return which === "help" ? <Help /> : null;
}

function Gallery() {
  return (
    <Dialog title={texts.gallery.title}>
      <ul class="gallery">
        {examples.map(({ name, title, text: found }) => (
          <li key={name}>
            <button
              type="button"
              data-example={name}
              onClick={() => {
                dialog.value = null;
                void open(found, { name: `${name}.toml` });
              }}
            >
              <strong>{title}</strong>
              <span>{name}</span>
            </button>
          </li>
        ))}
      </ul>
    </Dialog>
  );
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
