// The texts of the worker, and of the page about the worker. They are a file of their own, so that the worker contains no others.

export const coreTexts = {
  trapped: "The core stopped and was started again. The text is unchanged.",
  tooLarge: "The text has more than 2 MB. It was not opened; use kempe run.",
  replaced: "Another text was opened before this one was read.",
  tooLong: "The computation took too long and was ended. The text is unchanged.",
  notConnected: "The core is not connected.",
  notReady: "The core is not ready.",
} as const;

/** Of the whole page. */
export const failed = "The core could not start. This page needs a browser with WebAssembly and DecompressionStream.";
