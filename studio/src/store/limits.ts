// Sizes up to which the page stays quick.

/** The longest text of a case, characters. */
export const MOST_OF_TEXT = 2 * 1024 * 1024;
