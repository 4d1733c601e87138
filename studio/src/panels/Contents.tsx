// All entries of a group as a list of buttons, so that they can be selected without a mouse.
import { type Group, typeOf } from "../catalogue/catalogue";
import { entries, entry } from "../catalogue/tree";
import { catalogue, selection, tree } from "../store/state";
import { texts } from "../texts";
import { Section } from "./parts";

export function Contents({ group }: { group: Group }) {
  const names = Object.keys(entries(tree.value, group));
  if (!names.length) return null;
  return (
    <Section title={texts.groups[group]}>
      <ul class="contents">
        {names.map((name) => (
          <li key={name}>
            <button type="button" onClick={() => (selection.value = { group, name })}>
              <bdi>{name}</bdi>
              <span>
                {typeOf(catalogue.value, group, name, entry(tree.value, group, name))?.name.replaceAll("_", " ")}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </Section>
  );
}
