// Which quantities can be plotted: single ones, and small groups of the same unit together.
import { quantity, shortened } from "./numbers.js";

const MOST_TOGETHER = 8;

/** The choices: `{group, name, curves}`. */
export function choices(scene) {
  const groups = new Map();
  for (const channel of scene.channels) groups.set(channel.group, [...(groups.get(channel.group) ?? []), channel]);
  return [...groups].flatMap(([group, channels]) => {
    const curves = channels.map((channel, k) => curve(channel, k, scene.bodies));
    const alone = channels.map((channel, k) => ({ group, name: channel.name, curves: [curves[k]] }));
    const units = new Set(channels.map(({ unit }) => unit));
    const together = channels.length > 1 && channels.length <= MOST_TOGETHER && units.size === 1;
    const all = { group, name: `All ${group}`, curves };
    return together ? [all, ...alone] : alone;
  });
}

/** A curve in the colour of the body whose angle or angular velocity it is, else of its place in its group. */
function curve(channel, k, bodies) {
  const body = bodies.find(({ name }) => [`${name}.angle`, `${name}.omega`].includes(channel.name));
  return { channel, colour: (colours) => colours.body(body?.number ?? k + 1) };
}

/** Fill the list of choices; names are text, whatever they contain. */
export function fill(select, all) {
  const groups = new Map();
  all.forEach(({ group, name }, k) => {
    if (!groups.has(group)) {
      const made = document.createElement("optgroup");
      made.label = group[0].toUpperCase() + group.slice(1);
      groups.set(group, made);
      select.append(made);
    }
    const option = document.createElement("option");
    option.value = String(k);
    option.textContent = shortened(name, 40);
    option.title = name;
    groups.get(group).append(option);
  });
}

/** The names of the curves beside their values at the present time. */
export class Legend {
  constructor(list, motion) {
    this.list = list;
    this.motion = motion;
    this.entries = [];
  }

  show(curves) {
    this.entries = curves.map(({ channel, colour }) => {
      const [entry, mark, name, value] = ["li", "span", "bdi", "span"].map((tag) => document.createElement(tag));
      mark.className = "mark";
      name.className = "name";
      name.textContent = shortened(channel.name, 60);
      name.title = channel.name;
      value.className = "value";
      entry.append(mark, name, value);
      return { channel, colour, entry, mark, value };
    });
    this.list.replaceChildren(...this.entries.map(({ entry }) => entry));
  }

  paint(t, colours) {
    for (const { channel, colour, mark, value } of this.entries) {
      mark.style.background = colour(colours);
      value.textContent = quantity(this.motion.value(channel, t), channel.unit, 4);
    }
  }
}
