// Links that hold the whole model: the text, compressed, in the part after the #. Frames of other pages have links of their own.
import { deflateSync, Inflate, strFromU8, strToU8 } from "fflate";
import { escaped } from "../draw/svg";
import { MOST_OF_TEXT } from "../store/limits";
import { texts } from "../texts";

/** The longest link, characters. */
export const MOST_OF_LINK = 64 * 1024;
/** The number of compressed bytes that are inflated at a time. Each can become a thousand bytes. */
const PIECE = 512;
const MARK = "#m=";
/** The mark of a page in a frame: it shows only the drawing and a slider. */
const FRAMED = "#embed";
/** The size of a frame, px; a course page may change it. */
const FRAME = { width: 640, height: 480 };

/** The link to this page with a text. */
export function linkOf(text: string, page = location.href): string {
  return page.split("#")[0] + MARK + encode(deflateSync(strToU8(text), { level: 9 }));
}

/** The text of a link, or null if the link has none; raises an error if it is damaged or too long. */
export function textOf(hash: string): string | null {
  const mark = [MARK, `${FRAMED}=`].find((one) => hash.startsWith(one));
  if (!mark) return null;
  if (hash.length > MOST_OF_LINK) throw new Error(texts.share.damaged);
  return strFromU8(inflated(decode(hash.slice(mark.length))));
}

/** Whether a page with this part after the # is in a frame. */
export function isFramed(hash: string): boolean {
  return hash === FRAMED || hash.startsWith(`${FRAMED}=`);
}

/** The link to the whole page from the link of a frame. */
export function wholeLink(framed: string): string {
  return framed.replace(FRAMED, MARK.slice(0, -1));
}

/** The HTML that shows a link in a frame of another page. */
export function frameOf(link: string, title: string): string {
  const [address, name] = [link.replace(MARK, `${FRAMED}=`), title].map(escaped);
  const size = `width="${FRAME.width}" height="${FRAME.height}"`;
  return `<iframe src="${address}" title="${name}" ${size} style="border: 0; max-width: 100%" loading="lazy"></iframe>`;
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
