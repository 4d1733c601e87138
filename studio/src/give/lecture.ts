// A copy of this page that opens with a case: for a lecture, a disk or any static host.

import { download, nameOf } from "./download";

/** The page before the script has changed it. */
const ORIGINAL = document.documentElement.cloneNode(true) as HTMLElement;

/** The text of a page that opens with a case. Its policy holds, because scripts and styles are unchanged. */
export function pageWith(text: string): string {
  const page = ORIGINAL.cloneNode(true) as HTMLElement;
  page.querySelector("#program")!.remove(); // boot.ts adds it
  // "<" could end the script element
  page.querySelector("#case")!.textContent = JSON.stringify(text).replaceAll("<", "\\u003c");
  // a parser moves blanks after the body into it; without this, each copy would have more of them
  const html = page.outerHTML.replace(/\s*<\/body><\/html>$/, "\n</body></html>");
  return `<!doctype html>\n${html}\n`;
}

export function savePage(title: string, text: string): void {
  download(nameOf(title, ".html"), pageWith(text), "text/html");
}
