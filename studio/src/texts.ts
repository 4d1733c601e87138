// All English texts of the studio and its worker, and with playerTexts.ts those of the player. Names of types, their
// fields and their descriptions come from the catalogue. Each bundle contains only the parts that it imports.
import { ARROWS_ON, forces, ON_ALL } from "./playerTexts";

export * from "./playerTexts";

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

const variable = (name: string) => (name === "t" ? "the time" : name);

const NAME = "kempe studio";

/** Of the worker, and of the page about the worker. */
export const coreTexts = {
  trapped: "The core stopped and was started again. The text is unchanged.",
  tooLarge: "The text has more than 2 MB. It was not opened; use kempe run.",
  replaced: "Another text was opened before this one was read.",
  tooLong: "The computation took too long and was ended. The text is unchanged.",
  notConnected: "The core is not connected.",
  notReady: "The core is not ready.",
} as const;

/** Of studio/index.html, which the build puts in. */
export const studioPage = { title: NAME, noScript: "The studio needs JavaScript." } as const;

export const texts = {
  name: NAME,
  starting: "The core starts …",
  failed: "The core could not start. This page needs a browser with WebAssembly and DecompressionStream.",
  core: coreTexts,
  modesName: "Mode",
  modes: { edit: "Edit", move: "Move", live: "Live", read: "Read" },
  modeHints: {
    edit: "Draw and change the geometry (1)",
    move: "Drag the mechanism; every length is kept (2)",
    live: "Let it move under its forces (3)",
    read: "Run an analysis and read its results (4)",
  },
  playback: { play: "Play", pause: "Pause", speed: "Speed", time: "Time" },
  files: {
    csv: "CSV",
    npz: "NPZ",
    png: "PNG",
    svg: "SVG",
    gif: "GIF",
    saved: (name: string) => `Saved in ${name}.`,
    copied: (name: string) =>
      `This tab is a copy of another open tab. Changes here do not change the other one; the file of this one is ${name}.`,
  },
  untitled: "Untitled mechanism",
  menu: { new: "New", open: "Open", save: "Save", gallery: "Gallery", share: "Share", undo: "Undo", redo: "Redo" },
  atPlace: {
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
  },
  menuHints: {
    open: "Open a case file (ctrl O)",
    save: "Save the case as TOML (ctrl S; in another file: ctrl shift S)",
    undo: "Undo (ctrl Z)",
    redo: "Redo (ctrl shift Z)",
    gallery: "Examples to start from",
    share: "A link that holds the whole model",
  },
  /** Words for types whose names in the file are no plain words, and the start of the names of new entries. */
  labels: {
    coordinate_driver: "Driver",
    spring_damper: "Spring, damper",
    translational: "Slide",
    generalized_force: "Effort",
    constraint: "Formula",
  } as Record<string, string>,
  machines: {
    slider: "A block on a straight guide of the ground or of a body; a point at its place is pinned to it",
    cylinder: "A barrel and its rod between two points, with a driver of its length",
  },
  stems: {
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
  } as Record<string, string>,
  groups: { bodies: "Bodies", joints: "Joints", drivers: "Drivers", forces: "Forces" },
  palette: { title: "Insert", select: "Select and drag" },
  tabs: { insert: "Insert", properties: "Properties", text: "Text", results: "Results" },
  sheet: {
    shown: { names: "Names", numbers: "Numbers", grid: "Grid", traces: "Paths" },
    label: (name: string) => `Drawing of ${name}`,
    zoomIn: "Zoom in (+)",
    zoomOut: "Zoom out (−)",
    fit: "Fit",
    fitHint: "Show everything (0)",
    snap: "Snap",
    snapHint: "Snap to the grid and to multiples of 15°; hold alt to place freely",
    pngHint: "Save the drawing as PNG",
    svgHint: "Save the drawing as SVG",
    gifHint: "Save the motion as a GIF, at the speed of the playback",
    gifProgress: (percent: number) => `GIF ${percent} % ×`,
    gifCancel: "Cancel the GIF",
    length: (unit: string) => `Length / ${unit}`,
    finish: "Finish",
    stop: "Cancel",
  },
  edit: {
    fixed: (body: string, point: string) =>
      `${body}.${point} does not follow: a length or a formula of the text determines it.`,
    changes: (names: string) => `A drag changes ${names}.`,
    instead: "Instead:",
    meets: (point: string) => `Pinned to ${point} when you let go; hold alt to leave it free.`,
    locked: (body: string, point: string) =>
      `${body}.${point} cannot be dragged: joints, drivers and contacts determine its place, and no number of ${body} moves it.`,
    heldPoint: (body: string, point: string) =>
      `${body}.${point} is kept while drawing: see the properties of ${body}.`,
    place: (body: string) => `Place ${body} by its points`,
    noLength: (unit: string) =>
      `A length is greater than 0: a number in ${unit}, a number with its unit, or a formula.`,
    lengthHint: (unit: string) =>
      `A number in ${unit}, a number with its unit such as 800 mm, or a formula in m such as 0.5*2`,
    noNotation: "This is not a value in the notation of the file.",
    notKept: (body: string) =>
      `With this length of ${body} the bodies beside it cannot keep theirs; they were changed.`,
    noMirror: (body: string) =>
      `${body} cannot be mirrored: it must be placed by points, without shapes, outlines and curves.`,
    invalidName: (name: string) =>
      `“${name}” cannot be a name: a name has letters, digits and _ and is used once; that of a parameter has letters from a to z.`,
  },
  place: {
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
    added: (label: string, name: string) => `${label} “${name}” added.`,
    incomplete: (label: string, name: string, problem: string) => `${label} “${name}” added. Problem: ${problem}`,
  },
  properties: {
    case: "Mechanism",
    title: "Title",
    gravity: "Gravity",
    parameters: "Parameters",
    addParameter: "Add a parameter",
    parameterName: "Name of the parameter",
    elements: "Contents",
    nothing: "An empty sheet. Choose a body among the tools and click two places, or open an example.",
    analyses: "Analyses",
    addAnalysis: "Add an analysis",
    startSet: "Prescribed at the start",
    startName: "Coordinate or rate to prescribe at the start",
    startValue: "Its value",
    addStart: "Prescribe at the start",
    startExamples: ["crank.angle", "70*deg"] as [string, string],
    name: "Name",
    point: "Point",
    position: "Position",
    remove: "Delete",
    removeHint: "Delete (del)",
    addPoint: "Add a point",
    addPointHint: "A point beside the middle; drag it to its place. Read draws its path",
    addCurve: "Add a curve",
    addCurveHint: "A circle around the body, or a line on the ground; type its form in “curves”",
    copy: "Duplicate",
    mirror: "Mirror",
    mirrorHint: "Mirror at the vertical line through its middle",
    required: "required",
    back: "All contents",
    length: "Length now",
    bodyLength: "length",
    results: "Now",
    held: "Kept while drawing",
    lengths: "lengths",
    angle: "angle",
    absent: "–",
  },
  measures: {
    title: "Measures",
    add: "Measure a quantity, such as C.force",
    numbers: (peak: string, mean: string, final: string) => `peak ${peak}, mean ${mean}, last ${final}`,
  },
  outline: {
    open: "Outline from SVG …",
    hint: "The paths of a file become the outline; a unit of the file is a millimetre unless its width has a unit",
    unreadable: (file: string) =>
      `${file} has no path that can be read. Convert its shapes to paths and apply their transforms.`,
  },
  picture: {
    title: "Picture behind the drawing",
    open: "Open a picture …",
    unreadable: (file: string) => `${file} is not a picture that the browser can show.`,
    opacity: "Opacity",
    scale: "Scale by two points",
    first: "Click the first of two points of the picture whose distance you know; arrow keys and space do so, too.",
    second: "Click the second point.",
    distance: (unit: string) => `Their distance / ${unit}`,
    move: "Move",
    moveHint: "Drag the picture on the sheet; esc ends this",
    angle: "Rotation",
    apply: "Apply",
    remove: "Remove the picture",
  },
  editor: {
    label: "Text of the case in TOML",
    problems: (n: number) => `${n} ${n === 1 ? "problem" : "problems"}`,
  },
  status: {
    freedom: (n: number) => `${n} ${n === 1 ? "degree" : "degrees"} of freedom`,
    redundant: (n: number) => `${n} redundant ${n === 1 ? "equation" : "equations"}`,
    singular: "singular position",
    open: "does not close",
    at: (line: number, column: number | null) => (column ? `line ${line}, column ${column}` : `line ${line}`),
    warnings: (n: number) => `${n} ${n === 1 ? "warning" : "warnings"}`,
    bodies: (n: number) => `${n} moving ${n === 1 ? "body" : "bodies"}`,
    dismiss: "Dismiss",
    undo: "Undo the last change",
  },
  move: {
    hint: "Drag a point or a body. Every length is kept.",
    speeds: "Speeds of the drivers",
    speedHint: "A number with its unit, such as 10 rpm or 30 mm/s, or a formula",
    configurations: "Assembly modes",
    find: "Find all assembly modes",
    only: "This is the only configuration with the present free coordinates.",
    complete: "All modes were found.",
    partial: "There may be more modes.",
    mode: (k: number) => `Mode ${k}`,
    locked: "Held during a drag",
    reset: "Back to the start",
    play: "Play the drivers",
    mobility: "Mobility",
    moreLoops: (n: number) => `… and ${n} more loops of four bars`,
    count: (n: number, complete: boolean) => (complete ? String(n) : `at least ${n}`),
    freedom: "Degrees of freedom",
    redundant: "Redundant equations",
    gruebler: "Grübler count",
    rank: "Rank of the constraints",
    fourBar: (pins: string, kind: string, turning: string) =>
      `${pins}: ${kind}${turning ? `; turns fully: ${turning}` : ""}`,
  },
  live: {
    energies: { kinetic: "Kinetic", potential: "Potential", dissipated: "Dissipated", work: "Work of drivers" },
    step: "One step (1/60 s)",
    restart: "Back to the start",
    hint: "Pull at a body with the mouse, or at the selected one with the arrow keys.",
    pulled: (body: string) => `The arrow keys pull at ${body}; esc lets go.`,
    energy: "Energy",
    balance: "Relative error of the balance",
    residual: "Residual of the joints",
    parameters: "Parameters",
    event: (names: string) => `Event: ${names}`,
  },
  read: {
    arrows: { reactions: "Reactions", force: "Forces", velocities: "Velocities", accelerations: "Accelerations" },
    run: "Run",
    running: "Running …",
    analysis: "Analysis",
    defaults: "from this pose",
    on: (body: string) => `on ${body}`,
    end: "End / s",
    over: "over a quantity",
    quantityOver: "Quantity on the axis",
    ends: ["from", "to"],
    noRange: "The range is not complete. Write its first and its last value.",
    forces,
    overNote: (name: string, condition: string) =>
      `Rates are derivatives by ${name}. Forces, torques and powers are those ${condition}.`,
    notUnique: (names: readonly string[]) =>
      `* Not unique: of the possible reactions of redundant joints, the smallest are shown (minimum norm): ${names.join(", ")}.`,
    done: (count: number, name: string, end: string) => `${count} states up to ${name} = ${end}`,
    begun: (names: string) => `The motion begins here: the law of ${names} was changed. Undo restores it.`,
    stops: (owner: string, value: string, reason: string) => `${owner} stops at ${value}: ${reason}.`,
    swings: (text: string) => `${text} It swings between its ends now; undo restores the former law.`,
    swing: "Swing between the ends",
    singular: (time: string, names: string) =>
      `A dead point${time ? ` at ${time}` : ""}: ${names} do not determine how the mechanism goes on.`,
    undetermined: "The motion ends here: in this position it is not determined how the mechanism goes on.",
    none: "Run an analysis to read its results.",
    found: "The result is beside the drawing.",
    findings: "Result",
    nothing: "The result has no values.",
    position: "Position",
    drawn: (name: string) => `Drawn: ${name}`,
    plots: "Plots",
    addPlot: "Add plot",
    others: "Measures and angles",
    addQuantity: "Add a quantity …",
    compare: "Compare …",
    compareHint: "Open a stored run (solution.npz of kempe run, or NPZ of this page); its curves are dashed",
    compared: (file: string, n: number) => `${n} quantities of ${file} are compared.`,
    notCompared: (file: string) => `${file} is not a stored run of a mechanism with these bodies.`,
    stored: "stored",
    otherAxis: (own: string, present: string, positions: boolean) =>
      `The stored run is over ${variable(own)}, the plots are over ${variable(present)}. ${
        positions ? "Only its positions are drawn." : `It is not drawn. A run over ${variable(own)} can be compared.`
      }`,
    endComparison: (file: string) => `End the comparison with ${file}`,
    csvHint: "Save the plotted curves as CSV, in SI units and rad",
    npzHint: "Save times, poses and plotted quantities for NumPy",
    pngHint: "Save the plots as PNG",
    svgHint: "Save the plots as SVG",
    plotOf: (names: string) => `Plot of ${names}; + and − stretch it, 0 shows all of it`,
    log: "log",
    logHint: "Logarithmic axis",
    onBody: ARROWS_ON,
    onAll: ON_ALL,
    peak: "peak",
  },
  units: {
    title: "Units of the display",
    length: "Lengths",
    lengthHint: "Unit of typed lengths, readings, plots and tables; with m, small values are written in mm",
    degrees: "° and rpm",
  },
  gallery: { title: "Examples", close: "Close", open: "Open" },
  ready: {
    title: "What can be computed",
    yes: "ready",
    add: (label: string) => `add a ${label.toLowerCase()}`,
    text: "show the text",
    notSingle: (freedom: number) =>
      freedom === 0
        ? "nothing can move; limits need a degree of freedom"
        : `${freedom} degrees of freedom are left; limits need drivers for all but one`,
    names: {
      assembly: "Assembly",
      dynamics: "Dynamics",
      kinematics: "Kinematics",
      inverse_dynamics: "Inverse dynamics",
      equilibrium: "Equilibrium",
      modes: "Modes",
      limits: "Limits",
    } as Record<string, string>,
  },
  share: {
    title: "Share",
    text: "The link holds the whole model, compressed. Nothing is sent to anyone until you send the link.",
    length: (n: number, most: number) => `${n} of at most ${most} characters`,
    tooLong: (n: number, most: number) =>
      `The model needs ${n} characters; a link has at most ${most}. Save the file and send it instead.`,
    copy: "Copy the link",
    copied: "The link was copied.",
    damaged: "The link is damaged or too long; it was not opened.",
    pageTitle: "As a page",
    page: "One file with this mechanism and the whole studio, for a lecture, a disk or any web server. It needs no network.",
    savePage: "Save as a page",
  },
  help: {
    title: "Keys and help",
    licences: "Licences of the software in this page",
    keys: [
      ["1 2 3 4", "edit, move, live, read"],
      ["ctrl Z, ctrl shift Z", "undo, redo"],
      ["ctrl S, ctrl shift S, ctrl O", "save, save in another file, open"],
      ["ctrl C, ctrl V", "copy and paste the selected body"],
      ["del", "delete the selection"],
      ["esc", "end the tool, clear the selection; in Live, let go"],
      ["enter", "finish a body with several points"],
      ["digits", "length of the line that is being drawn"],
      [
        "arrow keys",
        "move the selected point; with a tool, the place of the next click; in Move, the body; in Live, pull at it",
      ],
      ["shift arrow keys", "move the sheet"],
      ["alt", "place and drag freely, without snapping and pins"],
      ["+ − 0", "zoom in, out, show everything"],
      ["space", "play, pause; with a tool or to scale a picture, click at the place that the arrow keys move"],
      ["right click, long press", "what is possible at this place"],
      ["wheel, two fingers", "zoom; drag the empty sheet to move it"],
    ] as [string, string][],
  },
  hints: {
    dismiss: "Hide this hint",
    all: {
      edit: "Drag a point to change the geometry; everything that is pinned there follows.",
      move: "Drag the mechanism; arrow keys push the selected body.",
      live: "Hold a body with the mouse, or press the arrow keys, to pull at it; space pauses.",
      read: "The slider below the drawing shows any time of the run; curves follow.",
      two: "Type digits after the first click for an exact length; begin at a point to pin the bar there.",
      many: "Click all points of the body; enter or a double click finishes it.",
      one: "Click where the mass is; on a point it is pinned there.",
      fixed: "Each click makes a fixed point; a body that begins there is pinned to ground.",
      reference: "The line below the drawing names what to click next; esc begins again.",
    },
  },
  guide: {
    title: "A first four-bar linkage",
    begin: "Build a four-bar step by step",
    replaces: "It begins on an empty sheet. Undo brings back what you have drawn.",
    skip: "Skip",
    leave: "Leave",
    end: "Done",
    count: (k: number, n: number) => `${k}/${n}`,
    mode: (name: string) => `Switch to “${name}”.`,
    tool: (label: string, step: string) =>
      `Choose the tool “${label}”: follow the dashed frame.${step === "driver" ? " It turns the crank." : ""}`,
    steps: {
      ground: "Click two fixed points. They hold the linkage.",
      crank: "Draw the crank: click a fixed point, then its free end. The bar is pinned where it begins.",
      coupler: "Draw the coupler: from the end of the crank to a new point.",
      rocker: "Draw the rocker: from the end of the coupler to the other fixed point. The loop closes.",
      driver:
        "Click the crank. The driver turns it ten times in each minute; the parameter of its speed can be changed.",
      move: "Drag the end of the crank around. Every length is kept.",
      live: "The driver turns the crank. Pull at a bar and watch the energy.",
      read: "The analysis is done: paths on the sheet, curves at the side. Tick “Reactions” for the forces in the pins.",
    },
  },
} as const;
