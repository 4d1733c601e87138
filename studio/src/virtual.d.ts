// Modules that the build makes.
declare module "virtual:examples" {
  /** Texts by family and name. */
  const found: Record<string, Record<string, string>>;
  export default found;
}

declare module "virtual:worker" {
  const source: string;
  export default source;
}

declare module "*.css";
