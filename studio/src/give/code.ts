// The QR code of a link.
import { encode } from "uqr";

/** The longest link in a code, bytes: the largest code of the standard holds 2953. */
export const MOST_OF_CODE = 2900;
/** The white border that readers need, in modules. */
const BORDER = 4;

export interface Code {
  /** The side with the border, in modules. */
  size: number;
  /** The dark modules as the path of an SVG. */
  path: string;
}

/** The code of a link, or null if the link is too long for one. Links have letters of one byte only. */
export function codeOf(link: string): Code | null {
  if (link.length > MOST_OF_CODE) return null;
  const { size, data } = encode(link, { ecc: "L", boostEcc: true, border: BORDER });
  const rows = data.map((row, y) => row.map((dark, x) => (dark ? `M${x} ${y}h1v1h-1z` : "")).join(""));
  return { size, path: rows.join("") };
}
