// Files that the page offers: pictures, and the plotted curves as a table.
import { colourOf, dashOf, font } from "./surface.js";

/** Pixels of a picture for each pixel of the page. */
const SHARPNESS = 2;
const TITLE = 34;
const ENTRY = 20;
const GAP = 12;

/** Curves at all frames as CSV, one line per frame, in SI units and rad; all digits of the page. */
export function csv(motion, curves) {
  const distinct = [...new Map(curves.map((curve) => [curve.name, curve])).values()];
  const { name, unit } = motion.variable;
  const head = [`${name} [${unit}]`, ...distinct.map(({ name, unit }) => `${name} [${plainUnit(unit)}]`)].map(cell);
  const number = (value) => (Number.isFinite(value) ? String(value) : "nan");
  const lines = motion.t.map((t, k) => [t, ...distinct.map(({ values }) => values[k])].map(number).join(","));
  return [head.join(","), ...lines, ""].join("\n");
}

/** Units as in the tables of kempe: letters of ASCII. */
function plainUnit(unit) {
  return unit.replace("·", "*").replace("²", "^2");
}

/** A cell of text that no spreadsheet takes for a formula (RFC 4180, with an apostrophe before it). */
function cell(text) {
  const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

/** A picture of the drawing. */
export function drawingPicture(drawing, t, instant, title, colours) {
  const { width, height } = drawing.view;
  return picture(width, height + TITLE, colours, (context) => {
    paintTitle(context, title, instant, width, colours);
    context.translate(0, TITLE);
    context.beginPath();
    context.rect(0, 0, width, height);
    context.clip();
    drawing.paint(t, colours, context);
  });
}

/** A picture of all plots with their legends. */
export function plotsPicture(cards, t, instant, title, colours) {
  const width = Math.max(...cards.map(({ plot }) => plot.width));
  const columns = Math.max(1, Math.floor(width / 260));
  const rows = ({ entries }) => Math.ceil(entries.length / columns);
  const height = cards.reduce((sum, card) => sum + card.plot.height + ENTRY * rows(card) + GAP, TITLE);
  return picture(width, height, colours, (context) => {
    paintTitle(context, title, instant, width, colours);
    context.translate(0, TITLE);
    for (const card of cards) {
      context.save();
      card.plot.paintAll(context, t, colours);
      context.restore();
      context.translate(0, card.plot.height);
      card.entries.forEach((entry, k) => paintEntry(context, entry, (k % columns) * (width / columns), Math.floor(k / columns), colours));
      context.translate(0, ENTRY * rows(card) + GAP);
    }
  });
}

function picture(width, height, colours, paint) {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * SHARPNESS);
  canvas.height = Math.round(height * SHARPNESS);
  const context = canvas.getContext("2d");
  context.scale(SHARPNESS, SHARPNESS);
  context.fillStyle = colours.panel;
  context.fillRect(0, 0, width, height);
  context.lineCap = context.lineJoin = "round";
  paint(context);
  return canvas;
}

function paintTitle(context, title, instant, width, colours) {
  context.fillStyle = colours.text;
  context.textBaseline = "middle";
  context.font = font(13);
  context.textAlign = "right";
  context.fillText(instant, width - 12, TITLE / 2);
  context.font = font(14, 600);
  context.textAlign = "left";
  context.fillText(title, 12, TITLE / 2, width - 40 - context.measureText(instant).width);
}

function paintEntry(context, { curve, value }, left, row, colours) {
  const y = ENTRY * (row + 0.5);
  context.strokeStyle = colourOf(curve, colours);
  context.lineWidth = 2.5;
  context.setLineDash(dashOf(curve));
  context.stroke(new Path2D(`M${left + 12} ${y}h24`));
  context.setLineDash([]);
  context.font = font(12);
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = colours.text;
  context.fillText(`${curve.name}  ${value.textContent}`, left + 44, y, 208);
}

/** Offer a text or a canvas as a file. */
export function download(name, content) {
  const offer = (blob) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  };
  if (content instanceof HTMLCanvasElement) content.toBlob(offer, "image/png");
  else offer(new Blob([content], { type: "text/csv;charset=utf-8" }));
}

/** The name of a file made of a title. */
export function fileName(title, what) {
  const words = title.toLowerCase().normalize("NFKD").match(/[a-z0-9]+/g) ?? ["linkage"];
  return `${words.join("_").slice(0, 40)}_${what}`;
}
