// A plot with its choices and its legend.
import { shortened } from "./numbers.js";
import { Plot } from "./plot.js";
import { choices } from "./quantities.js";
import { colourOf, dashOf } from "./surface.js";

/** A plot on the page: what it shows is chosen here, and the legend gives the values. */
export class Card {
  constructor({ card, entry }, { all, motion, span, changed, removed }) {
    this.entry = entry;
    this.element = card.content.firstElementChild.cloneNode(true);
    const find = (name) => this.element.querySelector(`.${name}`);
    [this.quantity, this.subject, this.log, this.legend, this.canvas] = ["quantity", "subject", "log", "legend", "curves"].map(find);
    Object.assign(this, { all, motion, entries: [], removal: find("remove") });
    this.plot = new Plot(this.canvas, motion, span);
    fillGroups(this.quantity, all);
    this.quantity.addEventListener("change", () => this.choose(Number(this.quantity.value), 0, changed));
    this.subject.addEventListener("change", () => this.choose(Number(this.quantity.value), Number(this.subject.value), changed));
    this.log.addEventListener("change", () => this.rescale(changed));
    this.removal.addEventListener("click", () => removed(this));
  }

  /** Show a quantity of a subject, by their numbers in the lists. */
  choose(which, whose, changed) {
    const quantity = this.all[which];
    const subjects = choices(quantity);
    fill(this.subject, subjects);
    this.quantity.value = String(which);
    this.subject.value = String(whose);
    this.plot.show(subjects[whose].curves, quantity.symbol);
    this.name = `${quantity.name}, ${subjects[whose].name}`;
    this.canvas.setAttribute("aria-label", `Plot over time: ${this.name}`);
    this.showLegend();
    this.rescale(changed);
  }

  rescale(changed) {
    this.plot.log = this.log.checked;
    this.plot.scale();
    changed();
  }

  showLegend() {
    this.entries = this.plot.curves.map((curve) => {
      const entry = this.entry.content.firstElementChild.cloneNode(true);
      const [line, name, value] = ["line", ".name", ".value"].map((one) => entry.querySelector(one));
      line.setAttribute("stroke-dasharray", dashOf(curve).join(" "));
      name.textContent = shortened(curve.name, 60);
      name.title = curve.name;
      return { curve, entry, line, value };
    });
    this.legend.replaceChildren(...this.entries.map(({ entry }) => entry));
  }

  /** Draw with the cursor at t, or at the time that is looked at. */
  paint(t, looked, colours) {
    // The legend first: the length of its texts decides how high the plot is.
    for (const { curve, line, value } of this.entries) {
      line.setAttribute("stroke", colourOf(curve, colours));
      value.textContent = this.plot.write(curve, looked ?? t);
      value.style.minWidth = `${0.9 * this.plot.widest(curve)}ch`; // so that entries keep their places
    }
    this.plot.paint(t, looked, colours);
  }
}

/** Fill a list of choices; names are text, whatever they contain. */
function fill(select, all) {
  select.replaceChildren(...all.map(({ name }, k) => option(name, k)));
}

function fillGroups(select, all) {
  const groups = new Map();
  all.forEach(({ group, name }, k) => {
    if (!groups.has(group)) {
      groups.set(group, document.createElement("optgroup"));
      groups.get(group).label = group;
      select.append(groups.get(group));
    }
    groups.get(group).append(option(name, k));
  });
}

function option(name, k) {
  const made = document.createElement("option");
  made.value = String(k);
  made.textContent = shortened(name, 40);
  made.title = name;
  return made;
}
