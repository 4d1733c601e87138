// The properties of the selection; without one, those of the case and its contents.
import { type Group, spoken, typeOf } from "../catalogue/catalogue";
import { entry, isTable } from "../catalogue/tree";
import type { Tree } from "../core/protocol";
import {
  addCurve,
  addPoint,
  copy,
  mirror,
  remove,
  rename,
  setLength,
  swap,
  takesCurves,
  takesPoints,
} from "../edit/commands";
import { hasSides } from "../edit/swapping";
import { openOutline } from "../give/outline";
import { report } from "../store/session";
import { catalogue, selection, tree, units } from "../store/state";
import { texts } from "../texts";
import { Case } from "./Case";
import { Field } from "./Field";
import { Held } from "./Held";
import { PointRows } from "./PointRows";
import { Button } from "./parts";
import { lengthOf, Readings } from "./Readings";
import { Speeds } from "./Speeds";

export function Properties() {
  const chosen = selection.value;
  const found = chosen && entry(tree.value, chosen.group, chosen.name);
  if (!chosen || !found) return <Case />;
  return <Entry key={`${chosen.group}.${chosen.name}`} group={chosen.group} name={chosen.name} value={found} />;
}

function Entry({ group, name, value }: { group: Group; name: string; value: Tree }) {
  const type = typeOf(catalogue.value, group, name, value);
  const words = texts.properties;
  return (
    <div class="properties">
      <div class="crumb">
        <button type="button" class="link" onClick={() => (selection.value = null)}>
          {words.back}
        </button>
        <span>{type ? spoken(type.name) : texts.groups[group]}</span>
      </div>
      <Name group={group} name={name} />
      <p class="doc">{type ? firstSentence(type.doc) : null}</p>
      {type?.fields.map((field) =>
        field.name === "length" && !(field.name in value) && isTable(value.through) ? (
          <Length key={field.name} body={name} />
        ) : field.shape === "points" ? (
          <PointRows
            key={field.name}
            field={field}
            body={name}
            value={isTable(value[field.name]) ? (value[field.name] as Tree) : {}}
          />
        ) : (
          <Field key={field.name} field={field} path={[group, name, field.name]} value={value[field.name]} />
        ),
      )}
      {group === "bodies" ? <Held name={name} /> : null}
      {group === "drivers" ? <Speeds of={name} /> : null}
      {type?.fields.some(({ shape }) => shape === "outline") ? (
        <Button label={texts.outline.open} hint={texts.outline.hint} onClick={() => openOutline(name)} id="outline" />
      ) : null}
      <div class="buttons end">
        {group === "bodies" && takesPoints(name) ? (
          <Button label={words.addPoint} hint={words.addPointHint} onClick={() => void addPoint(name)} id="add-point" />
        ) : null}
        {group === "bodies" && takesCurves(name) ? (
          <Button label={words.addCurve} hint={words.addCurveHint} onClick={() => void addCurve(name)} id="add-curve" />
        ) : null}
        {group === "bodies" && name !== "ground" ? (
          <>
            <Button label={words.copy} onClick={() => void copy(name)} />
            <Button label={words.mirror} hint={words.mirrorHint} onClick={() => void mirror(name)} />
          </>
        ) : null}
        {type && hasSides(type) ? (
          <Button label={texts.place.swap} onClick={() => void swap(group, name)} id="swap" />
        ) : null}
        <Button label={words.remove} hint={words.removeHint} kind="danger" onClick={() => void remove()} />
      </div>
      <Readings group={group} name={name} />
    </div>
  );
}

function Name({ group, name }: { group: Group; name: string }) {
  return (
    <div class="field">
      <label for="entry-name">{texts.properties.name}</label>
      <input
        id="entry-name"
        class="name"
        type="text"
        autocomplete="off"
        spellcheck={false}
        value={name}
        readOnly={group === "bodies" && name === "ground"}
        onChange={(event) => {
          const input = event.currentTarget;
          void rename(group, name, input.value.trim()).then((done) => {
            if (!done) input.value = name;
          });
        }}
      />
      <span class="unit" />
    </div>
  );
}

/** The length of a body that is placed by two points. */
function Length({ body }: { body: string }) {
  const shown = lengthOf(body);
  const unit = units.value.length;
  return (
    <div class="field">
      <label for="body-length">{texts.properties.bodyLength}</label>
      <input
        id="body-length"
        type="text"
        autocomplete="off"
        spellcheck={false}
        title={texts.edit.lengthHint(unit)}
        value={shown}
        onChange={(event) => {
          const { value } = event.currentTarget;
          if (value !== shown) void setLength(body, value).catch(report);
        }}
      />
      <span class="unit">{unit}</span>
    </div>
  );
}

function firstSentence(doc: string): string {
  const plain = doc.replaceAll("\n", " ");
  const end = plain.search(/[.;](\s|$)/);
  const sentence = (end > 0 ? plain.slice(0, end) : plain).replace(/ \((?:Haug|Eich)[^)]*\)/, "");
  return `${sentence}.`;
}
