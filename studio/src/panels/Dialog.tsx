// A dialog above the page.
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { dialog } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

export function Dialog({ title, kind, children }: { title: string; kind?: string; children: ComponentChildren }) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => element.current?.showModal(), []);
  return (
    <dialog ref={element} class={kind} aria-label={title} onClose={() => (dialog.value = null)}>
      <div class="dialog-head">
        <h2>{title}</h2>
        <Button label={texts.gallery.close} icon="close" onClick={() => (dialog.value = null)} />
      </div>
      {children}
    </dialog>
  );
}
