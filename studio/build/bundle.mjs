// One script and one style of all that an entry imports.
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const STUDIO = dirname(dirname(fileURLToPath(import.meta.url)));

/** Bundle an entry, a path in the folder of the studio. */
export async function bundle(entry, options) {
  const { outputFiles } = await build({
    entryPoints: [join(STUDIO, entry)],
    absWorkingDir: STUDIO,
    bundle: true,
    write: false,
    outdir: "out",
    target: "es2022",
    legalComments: "none",
    ...options,
  });
  const text = (suffix) => outputFiles.find(({ path }) => path.endsWith(suffix))?.text.trim() ?? "";
  return { script: text(".js"), style: text(".css") };
}
