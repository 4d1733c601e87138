// The diagram that Read shows beside the drawing.
import { signal } from "@preact/signals";

export const DIAGRAMS = ["none", "centres", "velocity", "acceleration", "body"] as const;
export type Diagram = (typeof DIAGRAMS)[number];

export const diagram = signal<Diagram>("none");
/** The name of the body of a free-body diagram, or from which centres are seen; empty for the first body, or all pairs. */
export const ofBody = signal("");
/** The name of the other body, whose centrodes with it are drawn; empty for none. */
export const withBody = signal("");
