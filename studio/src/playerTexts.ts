// All English texts of the player.

/** The choice of the body whose arrows are shown, in the player and in the studio. */
export const ARROWS_ON = "Arrows on";
export const ON_ALL = "all bodies";
/** The line beside arrows of forces over a quantity, in the player and in the studio. */
export const forces = (condition: string) => `forces ${condition}`;

/** Of the script of the player. */
export const playerTexts = {
  linkage: "Linkage",
  theLinkage: "the linkage",
  drawingOf: (title: string) => `Drawing of ${title}`,
  plotOf: (name: string) => `Plot over time: ${name}`,
  on: (body: string) => `on ${body}`,
  remarked: (remark: string) => `(${remark})`,
  forces,
  of: (end: string) => `of ${end}`,
  play: "Play",
  pause: "Pause",
  instants: (count: number) => `${count} instants of the solution`,
  within: (percent: number) => `; between them, forces and accelerations are within ${percent} %`,
  notBetween: ", not interpolated",
  all: "All",
  allBodies: "All bodies",
  allPoints: "All points",
  groups: {
    bodies: "Bodies",
    points: "Bodies and points",
    reactions: "Reactions",
    forces: "Force elements",
    coordinates: "Joint coordinates",
    states: "States",
    energy: "Energy",
    accuracy: "Accuracy",
  },
  turning: { angle: "Angle", omega: "Angular velocity", alpha: "Angular acceleration" },
  moving: {
    x: "Position x",
    y: "Position y",
    vx: "Velocity x",
    vy: "Velocity y",
    speed: "Speed",
    ax: "Acceleration x",
    ay: "Acceleration y",
    acceleration: "Acceleration",
  },
  acting: { reactions: (part: string) => `Reaction ${part}`, forces: (part: string) => `Element ${part}` },
  parts: { force: "force", force_x: "force x", force_y: "force y", torque: "torque" },
  channels: { coordinates: "Coordinate", states: "State", energy: "Energy", accuracy: "Residual |Φ|" },
} as const;

/** Of studio/player.html, which the build puts in. */
export const playerPage = {
  noScript: "This animation needs JavaScript.",
  seconds: "time in seconds",
  drawing: { drawing: "Drawing", show: "Show", names: "Names", numbers: "Numbers", paths: "Paths" },
  arrows: { reactions: "Reactions", force: "Forces", velocities: "Velocities", accelerations: "Accelerations" },
  reactions: "Force of each joint on its second body, or on the chosen body",
  force: "Force of each driver and force element on its second body, or on the chosen body",
  velocities: "Velocity of the traced points, or of the points of the chosen body",
  accelerations: "Acceleration of the traced points, or of the points of the chosen body",
  onBody: ARROWS_ON,
  onAll: ON_ALL,
  view: { view: "View", in: "Zoom in", out: "Zoom out", fit: "Fit", all: "Show everything" },
  scale: { longer: "Longer arrows", shorter: "Shorter arrows" },
  save: { png: "PNG", csv: "CSV", drawing: "Save the drawing as PNG", plots: "Save the plots as PNG" },
  values: { csv: "Save the plotted curves as CSV", units: "in SI units and rad" },
  plots: { plots: "Plots", degrees: "° and rpm", add: "Add plot", addHint: "Add a plot" },
  playback: {
    playback: "Playback",
    play: "Play",
    hint: "Play or pause",
    speed: "Speed",
    time: "Time",
    repeat: "Repeat",
  },
  frames: { first: "To the start", back: "One frame back", forward: "One frame forward", last: "To the end" },
  card: { quantity: "Quantity", subject: "Bodies or elements", log: "log", logHint: "Logarithmic axis" },
  legend: { remove: "Remove this plot", values: "Values" },
  names: { keys: "Keys", space: "space", home: "Home", end: "End" },
  keys: [
    "play, pause",
    "one frame; ten with shift",
    "faster, slower",
    "start, end",
    "zoom in, out, show all",
    "repeat",
  ],
  drag: ["drag, wheel", "move and zoom the drawing"],
  click: ["click in a plot", "go to that time"],
  wheel: ["ctrl and wheel", "stretch the plots, as + and - in a plot; double click shows all"],
} as const;
