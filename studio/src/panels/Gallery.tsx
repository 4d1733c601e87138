// The gallery: all examples by family, with a search and with pictures that move.
import { useEffect, useRef, useState } from "preact/hooks";
import { type Example, examples, families } from "../gallery/examples";
import { endPictures, Thumb } from "../gallery/thumbs";
import { open } from "../store/document";
import { dialog } from "../store/state";
import { texts } from "../texts";
import { Dialog } from "./Dialog";
import { Button } from "./parts";

/** The examples that contain each of the words in their name, sentence or family. */
function matching(words: string): Example[] {
  const wanted = words.toLowerCase().split(/\s+/);
  return examples.filter(({ name, title, family }) => {
    const all = `${name} ${title} ${family}`.toLowerCase();
    return wanted.every((word) => all.includes(word));
  });
}

export function Gallery() {
  const words = texts.gallery;
  const [typed, setTyped] = useState("");
  const [family, setFamily] = useState<string | null>(null);
  useEffect(() => endPictures, []);
  const found = matching(typed).filter((one) => !family || one.family === family);
  return (
    <Dialog title={words.title} kind="wide">
      <div class="gallery-head">
        <input
          type="search"
          id="gallery-search"
          placeholder={words.search}
          aria-label={words.search}
          value={typed}
          onInput={(event) => setTyped(event.currentTarget.value)}
        />
        <span role="status">{words.count(found.length)}</span>
        <div class="families" role="group" aria-label={words.families}>
          <Button label={words.all} kind="small" pressed={!family} onClick={() => setFamily(null)} />
          {families.map((one) => (
            <Button
              key={one}
              label={one}
              kind="small"
              pressed={family === one}
              onClick={() => setFamily(family === one ? null : one)}
            />
          ))}
        </div>
      </div>
      {families.map((one) => (
        <Family key={one} family={one} members={found.filter((example) => example.family === one)} />
      ))}
    </Dialog>
  );
}

function Family({ family, members }: { family: string; members: Example[] }) {
  if (!members.length) return null;
  return (
    <section>
      <h3>{family}</h3>
      <ul class="gallery">
        {members.map((one) => (
          <li key={one.name}>
            <Card one={one} />
          </li>
        ))}
      </ul>
    </section>
  );
}

function Card({ one: { name, title, text } }: { one: Example }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const thumb = useRef<Thumb | null>(null);
  useEffect(() => {
    const made = new Thumb(canvas.current!, text);
    thumb.current = made;
    // a picture that cannot be drawn stays empty
    const seen = new IntersectionObserver(([entry], observer) => {
      if (!entry?.isIntersecting) return;
      observer.disconnect();
      void made.show().catch(() => {});
    });
    seen.observe(canvas.current!);
    return () => {
      seen.disconnect();
      made.stop();
    };
  }, []);
  const play = () => void thumb.current?.play().catch(() => {});
  const stop = () => thumb.current?.stop();
  const [head, says] = title.split(/:\s+/, 2);
  return (
    <button
      type="button"
      data-example={name}
      onPointerEnter={play}
      onPointerLeave={stop}
      onFocus={play}
      onBlur={stop}
      onClick={() => {
        dialog.value = null;
        void open(text, { name: `${name}.toml` });
      }}
    >
      <canvas ref={canvas} />
      <strong>{head}</strong>
      {says ? <span>{says.charAt(0).toUpperCase() + says.slice(1)}</span> : null}
    </button>
  );
}
