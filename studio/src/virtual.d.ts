// Modules that the build makes.
declare module "virtual:examples" {
  export const examples: { name: string; title: string; family: string; text: string }[];
}

declare module "virtual:worker" {
  const source: string;
  export default source;
}

declare module "*.css";
