// gifenc has no types of its own; these are of what the page uses.
declare module "gifenc" {
  export type Palette = number[][];
  export function quantize(rgba: Uint8ClampedArray, colours: number): Palette;
  export function applyPalette(rgba: Uint8ClampedArray, palette: Palette): Uint8Array;
  export function GIFEncoder(): {
    /** `delay` in ms; `palette` and `repeat` (0: without end) belong to the first frame. */
    writeFrame(
      pixels: Uint8Array,
      width: number,
      height: number,
      options: { palette?: Palette; repeat?: number; delay: number },
    ): void;
    finish(): void;
    bytes(): Uint8Array;
  };
}
