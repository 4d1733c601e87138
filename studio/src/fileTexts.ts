// The texts about files that the page opens and saves.

export const files = {
  csv: "CSV",
  npz: "NPZ",
  png: "PNG",
  svg: "SVG",
  gif: "GIF",
  saved: (name: string) => `Saved in ${name}.`,
  tooLarge: (name: string) => `${name} has more than 20 MB. It was not opened; use kempe convert.`,
  noText: (name: string) => `${name} is not a text in UTF-8.`,
  lost: (name: string, parts: number) =>
    parts === 1
      ? `A part of ${name} has no equal here and was left out: see the first lines of the text.`
      : `${parts} parts of ${name} have no equal here and were left out: see the first lines of the text.`,
  copied: (name: string) =>
    `This tab is a copy of another open tab. Changes here do not change the other one; the file of this one is ${name}.`,
} as const;
