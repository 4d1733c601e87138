// Dialogs: examples, link, keys.

import { examples } from "virtual:examples";
import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { savePage } from "../give/lecture";
import { linkOf, MOST_OF_LINK } from "../give/link";
import { begin } from "../guide/guide";
import { open } from "../store/document";
import { dialog, text, title } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

export function Dialogs() {
  const which = dialog.value;
  if (which === "gallery") return <Gallery />;
  if (which === "share") return <Share />;
  return which === "help" ? <Help /> : null;
}

function Dialog({ title, children }: { title: string; children: ComponentChildren }) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => element.current?.showModal(), []);
  return (
    <dialog ref={element} aria-label={title} onClose={() => (dialog.value = null)}>
      <div class="dialog-head">
        <h2>{title}</h2>
        <Button label={texts.gallery.close} icon="close" onClick={() => (dialog.value = null)} />
      </div>
      {children}
    </dialog>
  );
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

function Share() {
  const words = texts.share;
  const link = useMemo(() => linkOf(text.value), [text.value]);
  const [copied, setCopied] = useState(false);
  const fits = link.length <= MOST_OF_LINK;
  const copy = () => void navigator.clipboard.writeText(link).then(() => setCopied(true));
  return (
    <Dialog title={words.title}>
      <p>{words.text}</p>
      {fits ? (
        <>
          <textarea
            id="link"
            readOnly
            rows={4}
            value={link}
            aria-label={words.title}
            onFocus={(event) => event.currentTarget.select()}
          />
          <p class="unit">{words.length(link.length, MOST_OF_LINK)}</p>
          <Button label={copied ? words.copied : words.copy} kind="main wide" onClick={copy} />
        </>
      ) : (
        <p class="problem">{words.tooLong(link.length, MOST_OF_LINK)}</p>
      )}
      <h3>{words.pageTitle}</h3>
      <p>{words.page}</p>
      <Button label={words.savePage} kind="wide" onClick={() => savePage(title.value, text.value)} />
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
