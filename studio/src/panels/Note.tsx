// The note beside the pointer.

import { note } from "../store/note";
import { view } from "../store/sheet";
import { Button, Icon } from "./parts";

export function Note() {
  const found = note.value;
  if (!found) return null;
  const [x, y] = found.at;
  const [right, low] = [x > view.width / 2, y > view.height / 2];
  return (
    <div
      class={`note ${found.kind ?? ""}`}
      id="note"
      role="status"
      style={{
        [right ? "right" : "left"]: `${(right ? view.width - x : x) + 16}px`,
        [low ? "bottom" : "top"]: `${(low ? view.height - y : y) + 16}px`,
        pointerEvents: found.actions?.length ? "auto" : "none",
      }}
    >
      {found.kind === "lock" ? <Icon name="lock" /> : null}
      {found.text ? <span dir="auto">{found.text}</span> : null}
      {found.actions?.map(({ label, run }) => (
        <Button key={label} label={label} kind="small" onClick={run} />
      ))}
    </div>
  );
}
