// Choosing files.
import { report } from "../store/session";

/** Let the user choose a file of some types, and pass it to `take`. */
export function choose(accept: string, take: (file: File) => Promise<void>): void {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = accept;
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file) take(file).catch(report);
  });
  input.click();
}
