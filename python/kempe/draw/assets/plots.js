// All plots of the page: they share the time, its window and the units of angles.
import { Card } from "./card.js";
import { seekable } from "./gestures.js";
import { quantities } from "./quantities.js";
import { TimeSpan } from "./timespan.js";

const MOST = 6;

/** The list of plots; `counted` is called with whether there is room for another one. */
export class Plots {
  constructor(list, templates, scene, motion, { seek, changed, counted }) {
    Object.assign(this, { list, templates, motion, seek, changed, counted, cards: [], looked: null, degrees: false });
    this.span = new TimeSpan(motion);
    this.all = quantities(scene, motion);
    this.watch = new ResizeObserver(() => {
      this.resize();
      this.changed();
    });
  }

  /** Add a plot of the first quantity that no other shows. */
  add() {
    if (this.cards.length >= MOST || !this.all.length) return;
    const shown = new Set(this.cards.map(({ quantity }) => Number(quantity.value)));
    const next = this.all.findIndex((_, k) => !shown.has(k));
    const card = new Card(this.templates, {
      ...this,
      removed: (one) => this.remove(one),
    });
    card.plot.degrees = this.degrees;
    this.cards.push(card);
    this.list.append(card.element);
    this.watch.observe(card.canvas);
    seekable(card.canvas, this.handlers(card.plot));
    card.choose(Math.max(0, next), 0, this.changed);
    this.update();
  }

  handlers(plot) {
    return {
      timeAt: (px) => plot.timeAt(px),
      seek: this.seek,
      look: (px, py) => {
        plot.pointer = px === null ? null : [px, py];
        this.looked = px === null ? null : this.motion.t[this.motion.nearest(plot.timeAt(px))];
        this.changed();
      },
      stretch: (factor, px) => {
        this.span.stretch(factor, plot.timeAt(px));
        this.changed();
      },
      showAll: () => {
        this.span.showAll();
        this.changed();
      },
    };
  }

  remove(card) {
    this.watch.unobserve(card.canvas);
    this.cards = this.cards.filter((one) => one !== card);
    card.element.remove();
    this.update();
    this.cards[0].quantity.focus();
    this.changed();
  }

  update() {
    for (const { removal } of this.cards) removal.hidden = this.cards.length < 2;
    this.counted(this.cards.length < MOST);
    this.resize();
  }

  setDegrees(degrees) {
    this.degrees = degrees;
    for (const { plot } of this.cards) {
      plot.degrees = degrees;
      plot.scale();
    }
    this.changed();
  }

  resize() {
    for (const { plot } of this.cards) plot.resize();
  }

  paint(t, colours) {
    this.span.follow(t);
    for (const card of this.cards) card.paint(t, this.looked, colours);
  }
}
