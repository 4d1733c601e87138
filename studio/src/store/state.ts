// The state of the page, as signals that panels and drawing follow.
import { computed, signal } from "@preact/signals";
import { type Catalogue, type Group, readCatalogue } from "../catalogue/catalogue";
import { type Tool, toolsOf } from "../catalogue/tools";
import type { Live, Mechanism, Mobility, Pose, Problem, Scene, Tree } from "../core/protocol";
import type { Units } from "../draw/display";
import type { Item } from "../draw/items";
import type { Placement } from "../plane/points";

export const MODES = ["edit", "move", "live", "read", "design"] as const;
export type Mode = (typeof MODES)[number];

export interface Message {
  kind: "info" | "problem" | "done";
  text: string;
  hint?: string;
  action?: { label: string; run(): void };
}

/** The selection: an entry of the case, or a point of a body. */
export type Selection = { group: Group; name: string; point?: string } | null;

export const ready = signal(false);
/** Counts the texts that the core has read. Each of them invalidates earlier runs and motions. */
export const loads = signal(0);
/** Counts the opened cases. */
export const openings = signal(0);
export const catalogue = signal<Catalogue>(readCatalogue({}));
export const tools = computed<Tool[]>(() => toolsOf(catalogue.value));

export const text = signal("");
export const title = computed(() => mechanism.value?.title ?? "");
export const problems = signal<Problem[]>([]);
export const unassembled = signal<Problem | null>(null);
/** The last case without a fault of syntax. */
export const tree = signal<Tree | null>(null);
export const mechanism = signal<Mechanism | null>(null);
export const mobility = signal<Mobility | null>(null);
export const scene = signal<Scene | null>(null);
export const items = signal<Item[]>([]);

/** The pose of the text, and the shown pose. */
export const home = signal<Pose | null>(null);
export const pose = signal<Pose | null>(null);
/** The poses of all bodies, ground first. */
export const poses = computed<Placement[]>(() => [[0, 0, 0], ...(pose.value?.poses ?? [])]);

export const mode = signal<Mode>("edit");
export const tool = signal<Tool | null>(null);
export const selection = signal<Selection>(null);
export const message = signal<Message | null>(null);
export const live = signal<Live | null>(null);

export const shown = signal({ names: true, numbers: true, grid: true, traces: true });
/** Units of the display: of the drawing, of typed lengths, of plots and tables; files have SI units. */
export const units = signal<Units>({ degrees: true, length: "m" });
export const snapping = signal(true);
/** Points, lengths and angles that a drag does not change, by the names in edit/holding.ts. */
export const held = signal<ReadonlySet<string>>(new Set());

export const panel = signal<"properties" | "text" | "results" | "insert" | "questions">("properties");
export const dialog = signal<"gallery" | "share" | "help" | null>(null);

/** Show a message in the status line. */
export function announce(kind: Message["kind"], words: string, more: Omit<Message, "kind" | "text"> = {}): void {
  message.value = { kind, text: words, ...more };
}
