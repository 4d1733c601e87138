// Links that hold the whole model: the text, compressed, in the part after the #.
import { deflateSync, Inflate, strFromU8, strToU8 } from "fflate";
import { MOST_OF_TEXT } from "../store/limits";
import { texts } from "../texts";

/** The longest link, characters. */
export const MOST_OF_LINK = 64 * 1024;
/** The number of compressed bytes that are inflated at a time. Each can become a thousand bytes. */
const PIECE = 512;
const MARK = "#m=";

/** The link to this page with a text. */
export function linkOf(text: string, page = location.href): string {
  return page.split("#")[0] + MARK + encode(deflateSync(strToU8(text), { level: 9 }));
}

/** The text of a link, or null if the link has none; raises an error if it is damaged or too long. */
export function textOf(hash: string): string | null {
  if (!hash.startsWith(MARK)) return null;
  if (hash.length > MOST_OF_LINK) throw new Error(texts.share.damaged);
  return strFromU8(inflated(decode(hash.slice(MARK.length))));
}

/** Inflate in pieces, and stop at the limit, so that a malicious link cannot fill the memory. */
function inflated(bytes: Uint8Array): Uint8Array {
  const parts: Uint8Array[] = [];
  let size = 0;
  let ended = false;
  const stream = new Inflate((part, final) => {
    size += part.length;
    if (size > MOST_OF_TEXT) throw new Error(texts.share.damaged);
    parts.push(part);
    ended ||= final;
  });
  for (let at = 0; at < bytes.length; at += PIECE)
    stream.push(bytes.subarray(at, at + PIECE), at + PIECE >= bytes.length);
  if (!ended) throw new Error(texts.share.damaged);
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/** Base64 with letters that need no escape in a link (RFC 4648, section 5). */
function encode(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function decode(text: string): Uint8Array {
  const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
}
