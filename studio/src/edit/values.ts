// Values of fields as people type them.

import type { Field } from "../catalogue/catalogue";
import type { Value } from "../core/protocol";

/** A value as text: numbers and formulas plain, lists and tables in the notation of the file. */
export function written(value: Value | undefined): string {
  if (value === undefined || value === null) return "";
  if (typeof value === "string") return value;
  return notation(value);
}

function notation(value: Value): string {
  if (Array.isArray(value)) return `[${value.map(notation).join(", ")}]`;
  if (typeof value === "object" && value !== null) {
    const inner = Object.entries(value).map(
      ([key, one]) => `${/^[\w-]+$/.test(key) ? key : JSON.stringify(key)} = ${notation(one)}`,
    );
    return inner.length ? `{ ${inner.join(", ")} }` : "{}";
  }
  if (typeof value === "number") return String(value).replace("e+", "e");
  return typeof value === "string" ? JSON.stringify(value) : String(value);
}

const LISTS = [
  "pair",
  "triple",
  "law_pair",
  "laws",
  "names",
  "units",
  "numbers",
  "columns",
  "name_list",
  "quantities",
  "two_texts",
];

/** Whether a field holds a list of short values, which is typed as "a, b". */
export function isList({ shape }: Field): boolean {
  return typeof shape === "string" && LISTS.includes(shape);
}

/** Whether a field holds a single value. */
export function isSingle({ shape }: Field): boolean {
  return (
    typeof shape === "string" &&
    ["number", "law", "name", "count", "condition", "flag", "body", "point", "joint", "curve", "coordinate"].includes(
      shape,
    )
  );
}

/** A table with only its type, for a word that is typed where the type of a table has options; else undefined. */
export function typeMeant({ shape }: Field, text: string): Value | undefined {
  const word = /^\s*(\w+)\s*$/.exec(text)?.[1];
  return typeof shape === "object" && "options" in shape && word !== undefined ? { type: word } : undefined;
}

/** Whether a typed text is in the notation of the file: a table, a quoted text, or a list that is not typed as "a, b". */
export function isNotation(text: string, list: boolean): boolean {
  return (list ? /^\s*(\{|\[\s*[[{])/ : /^\s*[[{"']/).test(text);
}

/** A number with a decimal comma and perhaps a unit. With three digits after it, the comma may separate thousands. */
const COMMA = /^([-+]?\d*),(\d+)(?=\s*[^\d\s,.()*/^+-]*$)/;

/** The value of a typed text: a number if it is one, otherwise a formula; undefined if it is empty. */
export function typed(text: string): Value | undefined {
  const given = text.trim().replace("−", "-");
  if (!given) return undefined;
  const [, whole, decimals] = COMMA.exec(given) ?? [];
  const isDecimal = decimals !== undefined && (decimals.length !== 3 || /^[-+]?0?$/.test(whole!));
  const trimmed = isDecimal ? given.replace(COMMA, "$1.$2").replace(/^([-+]?)\./, "$10.") : given;
  const number = Number(trimmed);
  return Number.isFinite(number) && /^[-+.\d]/.test(trimmed) && !/^[-+]?0x/i.test(trimmed) ? number : trimmed;
}

/** The values of a typed list, "a, b", "[a, b]" or "a; b"; separators within brackets do not separate. */
export function typedList(text: string): Value[] | undefined {
  const inner = text.trim().replace(/^\[(.*)\]$/s, "$1");
  if (!inner.trim()) return undefined;
  const parts: string[] = [];
  const separator = inner.includes(";") ? ";" : ",";
  let depth = 0;
  let part = "";
  for (const letter of inner) {
    if (letter === separator && depth === 0) {
      parts.push(part);
      part = "";
      continue;
    }
    if ("([".includes(letter)) depth += 1;
    if (")]".includes(letter)) depth -= 1;
    part += letter;
  }
  return [...parts, part].map((one) => typed(one.replace(/^\s*"(.*)"\s*$/, "$1")) ?? 0);
}

/** A list as it is typed. */
export function writtenList(value: Value | undefined): string {
  return Array.isArray(value) ? value.map((one) => written(one)).join(", ") : written(value);
}
