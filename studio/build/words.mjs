// The texts of src/texts.ts in the pages that have texts of their own.
import { bundle } from "./bundle.mjs";

/** All parts of src/texts.ts. */
export async function words() {
  const { script } = await bundle("src/texts.ts", { format: "esm" });
  return import(`data:text/javascript;base64,${Buffer.from(script).toString("base64")}`);
}

/**
 * A page with words in the places of `{{words.…}}`; other places in braces stay.
 * @throws Error there is no such word, or one has no place
 */
export function worded(page, part) {
  const unused = new Set(paths(part));
  const full = page.replace(/\{\{words\.([\w.]+)\}\}/g, (_, path) => {
    const text = path.split(".").reduce((found, key) => found?.[key], part);
    if (typeof text !== "string" || /[<>&"]/.test(text)) throw new Error(`words.${path} is no text of a page`);
    unused.delete(path);
    return text;
  });
  if (unused.size) throw new Error(`the page has no place for ${[...unused].join(", ")}`);
  return full;
}

function paths(part, before = "") {
  return Object.entries(part).flatMap(([key, one]) =>
    typeof one === "string" ? [before + key] : paths(one, `${before}${key}.`),
  );
}
