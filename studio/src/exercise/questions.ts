// The questions of a case: answers are checked by the core, and the result is a file.
import { computed, effect, signal } from "@preact/signals";
import { isTable } from "../catalogue/tree";
import type { Exercise, Question } from "../core/protocol";
import { CoreError, Superseded } from "../core/transport";
import { download } from "../give/download";
import { change, file } from "../store/document";
import { report, send } from "../store/session";
import { announce, loads, openings, panel, title, tree } from "../store/state";
import { texts } from "../texts";

/** The format of files of results; `kempe exercise --check` reads them. */
const FORMAT = 1;
/** Variants that a button draws have numbers up to this. */
const MOST = 9999;

/** What a student has done with a question. */
export interface Answer {
  given: string;
  right: boolean | null;
  tries: number;
  hints: number;
  /** Why the answer cannot be read. */
  fault?: string;
}

const NOTHING: Answer = { given: "", right: null, tries: 0, hints: 0 };

export const has = computed(() => isTable(tree.value?.exercise));
export const exercise = signal<Exercise | null>(null);
/** The reason why there are no questions. */
export const fault = signal<string | null>(null);
export const answers = signal<Record<string, Answer>>({});
export const student = signal("");
/** The question whose answer is being checked. */
export const checking = signal<string | null>(null);

/** The opening and the variant to which the answers belong. */
let of = "";

effect(() => {
  loads.value;
  if (has.value) void read();
  else {
    exercise.value = null;
    // a first question that is added does not change the panel
    of = `${openings.peek()} `;
  }
});

async function read(): Promise<void> {
  try {
    const { ok } = await send("exercise", {}, "exercise");
    const now = `${openings.value} ${ok.seed}`;
    if (now !== of) {
      const another = !of.startsWith(`${openings.value} `);
      of = now;
      answers.value = {};
      if (another) panel.value = "questions";
    }
    exercise.value = ok;
    fault.value = null;
  } catch (error) {
    if (error instanceof Superseded) return;
    exercise.value = null;
    if (error instanceof CoreError) fault.value = error.problem.message;
    else report(error);
  }
}

export function answerTo(name: string): Answer {
  return answers.value[name] ?? NOTHING;
}

function note(name: string, more: Partial<Answer>): void {
  const { fault: _, ...before } = answerTo(name);
  answers.value = { ...answers.value, [name]: { ...before, ...more } };
}

/** Check a typed answer; a decimal comma is read as a point. */
export async function check(name: string, typed: string): Promise<void> {
  const given = typed
    .trim()
    .replace("−", "-")
    .replace(/^([-+]?\d*),(\d+)/, "$1.$2");
  if (!given || checking.value) return;
  checking.value = name;
  try {
    const { ok } = await send("answer", { question: name, given });
    note(name, { given, right: ok.right, tries: answerTo(name).tries + 1 });
  } catch (error) {
    if (error instanceof CoreError) {
      const { message, hint } = error.problem;
      note(name, { given, right: null, fault: hint ? `${message}; ${hint}` : message });
    } else report(error);
  }
  checking.value = null;
}

export function showHint(name: string): void {
  note(name, { hints: answerTo(name).hints + 1 });
}

/** Give the mechanism the numbers of a variant; 0 is for those of the file, which stay as they are. */
export async function choose(seed: number): Promise<void> {
  if (!Number.isInteger(seed) || seed < 1) {
    announce("problem", texts.exercise.noVariant);
    return;
  }
  try {
    const { ok } = await send("variant", { seed });
    await change(ok.changes);
  } catch (error) {
    report(error);
  }
}

export function another(): void {
  void choose(1 + Math.floor(Math.random() * MOST));
}

export function pointsOf(all: readonly Question[]): { right: number; most: number } {
  const sum = (some: readonly Question[]) => some.reduce((total, one) => total + one.points, 0);
  return { right: sum(all.filter(({ name }) => answerTo(name).right)), most: sum(all) };
}

/** Save the answers as a file, which the student sends. */
export function saveResult(): void {
  const found = exercise.value;
  if (!found) return;
  const { right, most } = pointsOf(found.questions);
  const given = Object.fromEntries(
    found.questions
      .filter(({ name }) => answers.value[name])
      .map(({ name, unit }) => {
        const { given: text, right: isRight, tries, hints } = answerTo(name);
        return [name, { given: text, unit, right: isRight, tries, hints }];
      }),
  );
  const result = {
    kempe_result: FORMAT,
    name: student.value.trim(),
    title: title.value,
    seed: found.seed,
    points: right,
    most,
    answers: given,
  };
  const stem = file.value.name.replace(/\.toml$/, "");
  const who = student.value.trim().replace(/[^\p{L}\p{N}]+/gu, "_");
  download(`${[stem, who].filter(Boolean).join("_")}.json`, `${JSON.stringify(result, null, 2)}\n`, "application/json");
}
