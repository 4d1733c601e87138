// A drawing context that writes SVG: the part of the canvas interface that the painters use.
import type { Line } from "./line";

interface State {
  globalAlpha: number;
  lineWidth: number;
  strokeStyle: string;
  fillStyle: string;
  font: string;
  textAlign: CanvasTextAlign;
  textBaseline: CanvasTextBaseline;
  dash: number[];
  transform: string;
  clipped: string;
}

const ANCHORS: Record<string, string> = { center: "middle", right: "end" };
const BASELINES: Record<string, string> = { middle: "central", top: "hanging" };

export class SvgContext {
  globalAlpha = 1;
  lineWidth = 1;
  strokeStyle = "#000000";
  fillStyle = "#000000";
  font = "12px sans-serif";
  textAlign: CanvasTextAlign = "left";
  textBaseline: CanvasTextBaseline = "alphabetic";
  lineCap = "round";
  lineJoin = "round";
  private dash: number[] = [];
  private transform = "";
  private clipped = "";
  private box = "";
  private clips = 0;
  private readonly stack: State[] = [];
  private readonly parts: string[] = [];

  /** `measure` gives the widths of texts. */
  constructor(private readonly measure: CanvasRenderingContext2D) {}

  /** This object with the type that the painters need. */
  get context(): CanvasRenderingContext2D {
    return this as unknown as CanvasRenderingContext2D;
  }

  save(): void {
    const { globalAlpha, lineWidth, strokeStyle, fillStyle, font, textAlign, textBaseline } = this;
    const { dash, transform, clipped } = this;
    const pen = { globalAlpha, lineWidth, strokeStyle, fillStyle, font, textAlign, textBaseline };
    this.stack.push({ ...pen, dash, transform, clipped });
  }

  restore(): void {
    Object.assign(this, this.stack.pop());
  }

  translate(x: number, y: number): void {
    this.transform += `translate(${tidy(x)} ${tidy(y)})`;
  }

  rotate(angle: number): void {
    this.transform += `rotate(${tidy((angle * 180) / Math.PI)})`;
  }

  beginPath(): void {
    this.box = "";
  }

  /** Set the rectangle of the next `clip`. */
  rect(x: number, y: number, width: number, height: number): void {
    this.box = `x="${tidy(x)}" y="${tidy(y)}" width="${tidy(width)}" height="${tidy(height)}"`;
  }

  clip(): void {
    this.clips += 1;
    this.clipped = ` clip-path="url(#clip${this.clips})"`;
    this.parts.push(`<clipPath id="clip${this.clips}"><rect ${this.box}/></clipPath>`);
  }

  setLineDash(dash: number[]): void {
    this.dash = dash;
  }

  measureText(text: string): TextMetrics {
    this.measure.font = this.font;
    return this.measure.measureText(text);
  }

  stroke(line: Line): void {
    this.path(line, `fill="none" ${this.stroked()}`);
  }

  fill(line: Line, rule?: CanvasFillRule): void {
    this.path(line, `fill="${colour(this.fillStyle)}"${rule ? ` fill-rule="${rule}"` : ""}`);
  }

  strokeText(text: string, x: number, y: number): void {
    this.text(text, x, y, `fill="none" ${this.stroked()}`);
  }

  fillText(text: string, x: number, y: number): void {
    this.text(text, x, y, `fill="${colour(this.fillStyle)}"`);
  }

  /** The SVG of the picture, with its size in px. */
  written(width: number, height: number, background: string): string {
    const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size} stroke-linecap="round" stroke-linejoin="round">
<rect width="100%" height="100%" fill="${colour(background)}"/>
${this.parts.join("\n")}
</svg>
`;
  }

  private stroked(): string {
    const dash = this.dash.length ? ` stroke-dasharray="${this.dash.join(" ")}"` : "";
    return `stroke="${colour(this.strokeStyle)}" stroke-width="${tidy(this.lineWidth)}"${dash}`;
  }

  private path({ text }: Line, look: string): void {
    const d = text.replace(/-?\d+\.\d+(e-?\d+)?/g, (number) => tidy(Number(number)));
    this.parts.push(`<path d="${d}" ${look}${this.placed()}/>`);
  }

  private text(text: string, x: number, y: number, look: string): void {
    const [, slant, weight, size, family] = /^(italic )?(\d+) ([\d.]+)px (.*)$/.exec(this.font) ?? [];
    const style = `font-family="${escaped(family ?? "sans-serif")}" font-size="${size ?? 12}" font-weight="${weight ?? 400}"${slant ? ' font-style="italic"' : ""}`;
    const anchor = `text-anchor="${ANCHORS[this.textAlign] ?? "start"}" dominant-baseline="${BASELINES[this.textBaseline] ?? "auto"}"`;
    this.parts.push(
      `<text x="${tidy(x)}" y="${tidy(y)}" ${style} ${anchor} ${look}${this.placed()}>${escaped(text)}</text>`,
    );
  }

  private placed(): string {
    const alpha = this.globalAlpha < 1 ? ` opacity="${tidy(this.globalAlpha)}"` : "";
    return (this.transform ? `${alpha} transform="${this.transform}"` : alpha) + this.clipped;
  }
}

function tidy(value: number): string {
  return String(Number(value.toFixed(2)));
}

/** A text inside HTML or SVG. */
export function escaped(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

/** The colour of a color-mix, which other programs do not read. */
function colour(css: string): string {
  const mixed = /^color-mix\(in srgb, (#\w{6}) ([\d.]+)%, (#\w{6})\)$/.exec(css);
  if (!mixed) return escaped(css);
  const [a, b] = [mixed[1]!, mixed[3]!].map((one) => [1, 3, 5].map((k) => Number.parseInt(one.slice(k, k + 2), 16)));
  const share = Number(mixed[2]) / 100;
  const channels = a!.map((value, k) => Math.round(share * value + (1 - share) * b![k]!));
  return `#${channels.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}
