// Limits of size that keep the page quick.

/** The longest text of a case, characters. */
export const MOST_OF_TEXT = 2 * 1024 * 1024;
/** The largest file of another tool, bytes. It may contain results, which become no text. */
export const MOST_OF_FOREIGN = 20e6;
