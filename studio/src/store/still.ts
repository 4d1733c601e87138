// Whether the system requests reduced motion: then nothing moves until the user starts it.

export function still(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
