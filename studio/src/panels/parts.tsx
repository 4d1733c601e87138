// Small parts of panels.
import type { ComponentChildren } from "preact";

const ICONS = {
  plus: "M4 10h12M10 4v12",
  minus: "M4 10h12",
  close: "M5 5l10 10M15 5 5 15",
  undo: "M4 8h8a4 4 0 0 1 0 8H8M4 8l4-4M4 8l4 4",
  redo: "M16 8H8a4 4 0 0 0 0 8h4M16 8l-4-4M16 8l-4 4",
  play: "M6 3.5v13L16.5 10z",
  pause: "M6.5 4v12M13.5 4v12",
  step: "M5 4v12l7-6zM15 4v12",
  first: "M5 4v12M15.5 4.5v11L7.5 10z",
  back: "M12.5 4.5 7 10l5.5 5.5",
  pointer: "M5 3l10 6.5-4.5 1L13 16l-2 1-2.4-5.3L5 14z",
  help: "M7.5 7.5a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.1.9-1.1 1.8M10 14.5v.1",
  lock: "M5 9h10v8H5zM7 9V6a3 3 0 0 1 6 0v3",
} as const;

export function Icon({ name }: { name: keyof typeof ICONS }) {
  const solid = name === "play";
  return (
    <svg viewBox="0 0 20 20" aria-hidden="true">
      <path class={solid ? "solid" : ""} d={ICONS[name]} />
    </svg>
  );
}

interface ButtonProps {
  label: string;
  hint?: string | undefined;
  icon?: keyof typeof ICONS;
  onClick(): void;
  disabled?: boolean;
  pressed?: boolean;
  kind?: string;
  children?: ComponentChildren;
  id?: string;
  /** Read the label aloud in place of the word, because another button has the same word. */
  spoken?: boolean;
}

/** A button with a word, or with an icon whose word is read aloud. */
export function Button({ label, hint, icon, onClick, disabled, pressed, kind, children, id, spoken }: ButtonProps) {
  return (
    <button
      type="button"
      id={id}
      class={kind ?? ""}
      title={hint ?? label}
      aria-label={icon || spoken ? label : undefined}
      aria-pressed={pressed}
      disabled={disabled}
      onClick={onClick}
    >
      {icon ? <Icon name={icon} /> : (children ?? label)}
    </button>
  );
}

export function Check({
  label,
  hint,
  checked,
  onChange,
}: {
  label: string;
  hint?: string;
  checked: boolean;
  onChange(value: boolean): void;
}) {
  return (
    <label class="chip" title={hint}>
      <input type="checkbox" checked={checked} onChange={(event) => onChange(event.currentTarget.checked)} />
      <span>{label}</span>
    </label>
  );
}

export function Section({
  title,
  children,
  action,
}: {
  title: string;
  children: ComponentChildren;
  action?: ComponentChildren;
}) {
  return (
    <section class="section">
      <h2 class="head">
        <span>{title}</span>
        {action}
      </h2>
      {children}
    </section>
  );
}

/** A table of names and values. */
export function Facts({ rows }: { rows: [string, string][] }) {
  return (
    <dl class="facts">
      {rows.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}
