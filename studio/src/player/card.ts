// A plot with its choices and its legend.
import { shortened } from "../draw/numbers";
import { type Colours, colourOf, dashOf } from "../draw/surface";
import { Plot } from "../plot/plot";
import type { TimeSpan } from "../plot/timespan";
import { playerTexts as texts } from "../texts";
import type { SceneCurve } from "./curve";
import type { Motion } from "./motion";
import { choices, type Quantity } from "./quantities";

export interface Templates {
  card: HTMLTemplateElement;
  entry: HTMLTemplateElement;
}

/** A curve in the legend: its line, and its value as text. */
interface Entry {
  curve: SceneCurve;
  entry: Element;
  line: Element;
  value: HTMLElement;
}

/** A plot on the page, with the choice of its quantity and a legend with the values. */
export class Card {
  readonly element: HTMLElement;
  readonly quantity: HTMLSelectElement;
  readonly removal: HTMLButtonElement;
  readonly canvas: HTMLCanvasElement;
  readonly plot: Plot;
  name = "";
  curves: SceneCurve[] = [];
  entries: Entry[] = [];
  private readonly subject: HTMLSelectElement;
  private readonly log: HTMLInputElement;
  private readonly legend: HTMLElement;

  constructor(
    private readonly templates: Templates,
    private readonly all: readonly Quantity[],
    motion: Motion,
    span: TimeSpan,
    private readonly changed: () => void,
  ) {
    this.element = copied(templates.card);
    const find = <Kind extends HTMLElement>(name: string) => this.element.querySelector<Kind>(`.${name}`)!;
    this.quantity = find("quantity");
    this.subject = find("subject");
    this.log = find("log");
    this.legend = find("legend");
    this.canvas = find("curves");
    this.removal = find("remove");
    this.plot = new Plot(this.canvas, span, motion.variable);
    fillGroups(this.quantity, all);
    this.quantity.addEventListener("change", () => this.choose(Number(this.quantity.value), 0));
    this.subject.addEventListener("change", () => this.choose(Number(this.quantity.value), Number(this.subject.value)));
    this.log.addEventListener("change", () => this.rescale());
  }

  /** Show a quantity of a subject, by their numbers in the lists. */
  choose(which: number, whose: number): void {
    const quantity = this.all[which]!;
    const subjects = choices(quantity);
    const chosen = subjects[whose]!;
    this.subject.replaceChildren(...subjects.map(({ name }, k) => option(name, k)));
    this.quantity.value = String(which);
    this.subject.value = String(whose);
    this.curves = chosen.curves;
    this.plot.show(this.curves, quantity.symbol);
    this.name = `${quantity.name}, ${chosen.name}`;
    this.canvas.setAttribute("aria-label", texts.plotOf(this.name));
    this.showLegend();
    this.rescale();
  }

  private rescale(): void {
    this.plot.log = this.log.checked;
    this.plot.scale();
    this.changed();
  }

  private showLegend(): void {
    this.entries = this.curves.map((curve) => {
      const entry = copied(this.templates.entry);
      const [line, name] = [entry.querySelector("line")!, entry.querySelector<HTMLElement>(".name")!];
      line.setAttribute("stroke-dasharray", dashOf(curve.number).join(" "));
      name.textContent = shortened(curve.name, 60);
      name.title = curve.name;
      return { curve, entry, line, value: entry.querySelector<HTMLElement>(".value")! };
    });
    this.legend.replaceChildren(...this.entries.map(({ entry }) => entry));
  }

  /** Draw with the cursor at t, and with a line at `looked`, the time under the pointer. */
  paint(t: number, looked: number | null, colours: Colours): void {
    // The legend comes first, because its height determines the height of the plot.
    for (const { curve, line, value } of this.entries) {
      line.setAttribute("stroke", colourOf(curve.number, colours));
      value.textContent = this.plot.write(curve, looked ?? t);
      value.style.minWidth = `${0.9 * this.plot.widest(curve)}ch`; // so that entries keep their places
    }
    this.plot.paint(t, looked, colours);
  }
}

function copied(template: HTMLTemplateElement): HTMLElement {
  return template.content.firstElementChild!.cloneNode(true) as HTMLElement;
}

function fillGroups(select: HTMLSelectElement, all: readonly Quantity[]): void {
  const groups = new Map<string, HTMLOptGroupElement>();
  all.forEach(({ group, name }, k) => {
    let list = groups.get(group);
    if (!list) {
      list = document.createElement("optgroup");
      list.label = group;
      groups.set(group, list);
      select.append(list);
    }
    list.append(option(name, k));
  });
}

/** A choice of a list; its name is text, whatever it contains. */
function option(name: string, k: number): HTMLOptionElement {
  const made = document.createElement("option");
  made.value = String(k);
  made.textContent = shortened(name, 40);
  made.title = name;
  return made;
}
