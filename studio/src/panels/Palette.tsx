// The palette: every type of the catalogue, by group.
import { useEffect, useRef } from "preact/hooks";
import { GROUPS } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { phase, tooled } from "../guide/guide";
import { restart } from "../modes/place";
import { panel, tool, tools } from "../store/state";
import { texts } from "../texts";
import { Icon } from "./parts";

export function Palette() {
  return (
    <div class="palette" role="toolbar" aria-label={texts.palette.title} aria-orientation="vertical">
      <button type="button" class="tool" aria-pressed={tool.value === null} onClick={() => restart(null)}>
        <Icon name="pointer" />
        <span>{texts.palette.select}</span>
      </button>
      {GROUPS.map((group) => (
        <section key={group} aria-label={texts.groups[group]}>
          <h2 class="head">{texts.groups[group]}</h2>
          {tools.value
            .filter((one) => one.group === group)
            .map((one) => (
              <ToolButton key={one.type.name} one={one} />
            ))}
        </section>
      ))}
    </div>
  );
}

/** Activate a tool, or none. */
export function choose(one: Tool | null): void {
  restart(one);
  if (panel.value === "insert" && one) panel.value = "properties";
  document.getElementById("sheet")?.focus({ preventScroll: true }); // so that keys draw
}

function ToolButton({ one }: { one: Tool }) {
  const active = tool.value?.type === one.type && tool.value.group === one.group;
  const next = phase.value === "tool" && tooled.value === one;
  const button = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    if (next) button.current?.scrollIntoView({ block: "nearest" });
  }, [next]);
  return (
    <button
      type="button"
      ref={button}
      class={next ? "tool next" : "tool"}
      data-type={one.type.name}
      aria-pressed={active}
      title={one.type.doc.replaceAll("\n", " ")}
      onClick={() => choose(one)}
    >
      <span>{one.label}</span>
    </button>
  );
}
