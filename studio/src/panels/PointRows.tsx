// Named points of a body, one row for each.
import type { Field } from "../catalogue/catalogue";
import type { Tree, Value } from "../core/protocol";
import { placePoint } from "../edit/commands";
import { removedPoint } from "../edit/removing";
import { typedList, writtenList } from "../edit/values";
import { change } from "../store/document";
import { selection, tree } from "../store/state";
import { texts } from "../texts";
import { put } from "./Field";
import { Button } from "./parts";

/** A typed place of the plane is that of all points that are pinned there; other values are those of one point. */
async function write(part: string, body: string, point: string, value: Value): Promise<void> {
  if (!(await placePoint(body, part, point, value))) put(["bodies", body, part, point], value);
}

export function PointRows({ field, body, value }: { field: Field; body: string; value: Tree }) {
  const rows = Object.entries(value);
  if (!rows.length) return null;
  return (
    <fieldset class="points">
      <legend title={field.doc}>
        {field.name} <span class="unit">{field.unit}</span>
      </legend>
      {rows.map(([point, at]) => (
        <div class={`field${selection.value?.point === point ? " chosen" : ""}`} key={point}>
          <label for={`${field.name}-${point}`}>
            <bdi>{point}</bdi>
          </label>
          <input
            id={`${field.name}-${point}`}
            type="text"
            autocomplete="off"
            spellcheck={false}
            value={writtenList(at)}
            title={field.doc}
            onFocus={() => (selection.value = { group: "bodies", name: body, point })}
            onChange={(event) => {
              const list = typedList(event.currentTarget.value);
              if (list) void write(field.name, body, point, list);
            }}
          />
          <Button
            label={`${texts.properties.remove} ${point}`}
            icon="close"
            kind="small"
            onClick={() => void change(removedPoint(tree.value, body, point))}
          />
        </div>
      ))}
    </fieldset>
  );
}
