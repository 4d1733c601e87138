// The texts about drawing: tools, what their clicks choose, drags, and the menu of a thing.

const things: Record<string, string> = {
  body: "a body, or empty ground",
  curve: "a body with a curve",
  coordinate: "a body or a joint that moves",
};

/** What the clicks of a tool choose, in the order of its references. */
const roles: Record<string, readonly string[]> = {
  revolute: ["the first of two points to pin", "the point of the other body"],
  translational: ["the guide: a body, or the ground", "the body that slides along it"],
  pin_in_slot: ["the body with the slot, or the ground", "the pin, a point of another body"],
  gear: ["the first wheel", "the second wheel"],
  belt: ["the first wheel", "the second wheel"],
  rack: ["the rack: a body, or the ground", "the pinion"],
  rolling: ["the line: a body, or the ground", "the wheel that rolls on it"],
  point_on_curve: ["the point that follows a curve", "the body with the curve"],
  roller_on_curve: ["the centre of the roller", "the body with the curve"],
  flat_on_curve: ["a point of the flat face", "the body with the curve"],
  contact: ["the point that touches", "the body with the curve"],
  coordinate_driver: ["the body or joint that is driven"],
  generalized_force: ["the body or joint on which it acts"],
  stop: ["the body or joint that is stopped"],
  torque: ["the body that it turns"],
  motor: ["the rotor"],
  force: ["the point where it acts"],
  friction: ["the joint"],
  coupling: ["the first body or joint that moves", "the second one"],
};
/** Of elements between two points or bodies. */
const ENDS = ["its first end", "its second end"];

/** What the click for a reference chooses; `k` is its number among `n`. */
const role = (type: string, k: number, n: number, shape: string) =>
  roles[type]?.[k] ?? (n === 2 ? ENDS[k]! : (things[shape] ?? `a ${shape}`));

export const edit = {
  fixed: (body: string, point: string) =>
    `${body}.${point} does not follow: a length or a formula of the text determines it.`,
  changes: (names: string) => `A drag changes ${names}.`,
  instead: "Instead:",
  meets: (point: string) => `Pinned to ${point} when you let go; hold alt to leave it free.`,
  locked: (body: string, point: string) =>
    `${body}.${point} cannot be dragged: joints, drivers and contacts determine its place, and no number of ${body} moves it.`,
  heldPoint: (body: string, point: string) => `${body}.${point} is kept while drawing: see the properties of ${body}.`,
  place: (body: string) => `Place ${body} by its points`,
  noLength: (unit: string) => `A length is greater than 0: a number in ${unit}, a number with its unit, or a formula.`,
  lengthHint: (unit: string) =>
    `A number in ${unit}, a number with its unit such as 800 mm, or a formula in m such as 0.5*2`,
  noNotation: "This is not a value in the notation of the file.",
  notKept: (body: string) => `With this length of ${body} the bodies beside it cannot keep theirs; they were changed.`,
  noMirror: (body: string) =>
    `${body} cannot be mirrored: it must be placed by points, without shapes, outlines and curves.`,
  removed: (name: string, others: readonly unknown[]) =>
    `“${name}” was deleted, with what needs it: ${others.join(", ")}.`,
  invalidName: (name: string) =>
    `“${name}” cannot be a name: a name has letters, digits and _ and is used once; that of a parameter has letters from a to z.`,
} as const;

export const place = {
  first: (label: string, placing: string | null) =>
    placing === "fixed"
      ? `${label}: click where the fixed point is.`
      : placing === "one"
        ? `${label}: click where it is.`
        : placing === "slider"
          ? `${label}: click where the block is: a point that it carries, its guide, or the ground.`
          : `${label}: click its first point. An existing point is joined by a pin.`,
  next: (label: string, placing: string | null) =>
    placing === "many"
      ? `${label}: click the next point; double click or enter finishes.`
      : placing === "slider"
        ? `${label}: click the direction of the guide.`
        : `${label}: click its second point, or type a length.`,
  choose: (label: string, type: string, k: number, n: number, shape: string) =>
    `${label}: click ${role(type, k, n, shape)}.`,
  wanted: (shape: string, type: string, k: number, n: number) =>
    `There is no ${shape === "coordinate" ? "moving part" : shape} here. Click ${role(type, k, n, shape)}.`,
  role,
  same: (body: string, wanted: string) => `This is ${body} again. Click ${wanted}, on another body.`,
  notGround: (wanted: string) => `The ground does not move. Click ${wanted}.`,
  swap: "Swap the two sides",
  addCurve: (body: string) => `Add a curve to ${body}`,
  held: (owner: string) =>
    `${owner} cannot be driven here: the joints and drivers leave it no freedom. Click another body or joint.`,
  added: (label: string, name: string, pin?: string) =>
    `${label} “${name}” added${pin ? ` in place of “${pin}”` : ""}.`,
  incomplete: (label: string, name: string, problem: string) => `${label} “${name}” added. Problem: ${problem}`,
} as const;

export const machines = {
  slider: "A block on a straight guide of the ground or of a body; a point at its place is pinned to it",
  cylinder: "A barrel and its rod between two points, with a driver of its length",
} as const;

/** Words for types whose names in the file are not plain words, and the start of the names of new entries. */
export const labels = {
  coordinate_driver: "Driver",
  spring_damper: "Spring, damper",
  translational: "Slide",
  generalized_force: "Effort",
  constraint: "Formula",
} as Record<string, string>;

export const stems = {
  slider: "block",
  cylinder: "barrel",
  coordinate_driver: "driver",
  spring_damper: "spring",
  torsion_spring: "spring",
  translational: "slide",
  pin_in_slot: "slot",
  generalized_force: "effort",
  point_on_curve: "follower",
  roller_on_curve: "roller",
  flat_on_curve: "flat",
  point_mass: "mass",
} as Record<string, string>;

export const atPlace = {
  sheet: "Empty sheet",
  groundPoint: "Fixed point here",
  pointHere: "Add a point here",
  properties: "Properties",
  drive: "Drive it",
  fixed: "Nothing here can move.",
  pin: "Pin here",
  alone: "Only one body has a point here.",
  pinned: "The bodies are pinned here.",
  keep: "Keep this point while drawing, or release it",
  copy: "Copy",
  paste: "Paste",
  nothing: "Nothing was copied.",
  one: "There is only one ground.",
  ground: "The ground cannot be deleted.",
} as const;
