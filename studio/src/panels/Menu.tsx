// The menu at a place of the sheet.
import { useEffect, useRef } from "preact/hooks";
import { menu } from "../store/menu";
import { view } from "../store/sheet";

export function Menu() {
  const found = menu.value;
  return found ? <Open key={found.at.join()} {...found} /> : null;
}

function Open({ at: [x, y], title, entries }: NonNullable<typeof menu.value>) {
  const box = useRef<HTMLDivElement>(null);
  const close = () => (menu.value = null);
  useEffect(() => {
    box.current?.querySelector("button")?.focus();
    const outside = (event: Event) => {
      if (!event.composedPath().includes(box.current!)) close();
    };
    addEventListener("pointerdown", outside, true);
    return () => removeEventListener("pointerdown", outside, true);
  }, []);
  const step = (event: KeyboardEvent) => {
    const all = [...box.current!.querySelectorAll("button")];
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by) all.at((all.indexOf(document.activeElement as HTMLButtonElement) + by) % all.length)?.focus();
    if (event.key === "Escape" || event.key === "Tab") {
      close();
      document.getElementById("sheet")?.focus();
    }
    if (by || event.key === "Escape") event.preventDefault();
    event.stopPropagation();
  };
  const [right, low] = [x > view.width / 2, y > view.height / 2];
  return (
    <div
      ref={box}
      class="menu"
      id="menu"
      role="menu"
      aria-label={title}
      tabIndex={-1}
      onKeyDown={step}
      style={{
        [right ? "right" : "left"]: `${right ? view.width - x : x}px`,
        [low ? "bottom" : "top"]: `${low ? view.height - y : y}px`,
        maxHeight: `${low ? y : view.height - y}px`,
      }}
    >
      <bdi class="head">{title}</bdi>
      {entries.map(({ label, run, why }) => (
        <button
          key={label}
          type="button"
          role="menuitem"
          aria-disabled={!run}
          onClick={() => {
            if (!run) return;
            close();
            run();
          }}
        >
          {label}
          {why ? <span class="hint">{why}</span> : null}
        </button>
      ))}
    </div>
  );
}
