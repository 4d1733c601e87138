// Builds dist/index.html: one file with the style, the script, the worker and the core.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import lzma from "lzma-native";
import { bundle } from "./bundle.mjs";
import { licences } from "./licences.mjs";
import { pack } from "./pack.mjs";
import { worded, words } from "./words.mjs";

const HERE = dirname(dirname(fileURLToPath(import.meta.url)));
const ROOT = dirname(HERE);
/** The compiled core; bindings/web/README.md says how it is built. */
const CORE = process.env.KEMPE_WEB ?? join(ROOT, "target", "web", "kempe_web.wasm");
/** Largest page, bytes compressed: 1.35 MB. */
const MOST = 1_480_000;

const OPTIONS = {
  minify: !process.env.KEMPE_PLAIN,
  format: "iife",
  jsx: "automatic",
  jsxImportSource: "preact",
  charset: "utf8",
};

/** The texts of the examples of the repository by family and name. */
function examples() {
  const examples = join(ROOT, "examples");
  const folders = [examples, join(examples, "classics")];
  const families = JSON.parse(readFileSync(join(HERE, "build", "families.json"), "utf8"));
  const read = (name) => {
    const folder = folders.find((one) => existsSync(join(one, `${name}.toml`)));
    return [name, readFileSync(join(folder, `${name}.toml`), "utf8")];
  };
  return Object.fromEntries(
    Object.entries(families).map(([family, names]) => [family, Object.fromEntries(names.map(read))]),
  );
}

/** Modules that are made here: the examples, and the worker as a text. */
const made = {
  name: "made",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: "made" }));
    onLoad({ filter: /^virtual:examples$/, namespace: "made" }, () => ({
      contents: `export default ${JSON.stringify(examples())}`,
    }));
    onLoad({ filter: /^virtual:worker$/, namespace: "made" }, async () => ({
      contents: `export default ${JSON.stringify((await bundle("src/core/worker.ts", OPTIONS)).script)}`,
    }));
  },
};

/**
 * The program and the core, taken apart, as base64 of xz, which is a third smaller than gzip. Its checksum is one that
 * the decoder knows; both parts have no words of four bytes, which its usual options expect. A preset would replace all
 * other options, so that they are those of the highest one.
 */
async function packed(program) {
  const size = Buffer.alloc(4);
  const written = Buffer.from(program);
  size.writeUInt32LE(written.length);
  const own = { dictSize: 2 ** 23, mode: lzma.MODE_NORMAL, niceLen: 273, mf: lzma.MF_BT4, depth: 512 };
  const filters = [{ id: lzma.FILTER_LZMA2, options: { ...own, lc: 1, lp: 0, pb: 0 } }];
  const coder = lzma.createStream("streamEncoder", { filters, check: lzma.CHECK_CRC32 });
  coder.end(Buffer.concat([size, written, pack(readFileSync(CORE))]));
  const parts = [];
  for await (const part of coder) parts.push(part);
  return Buffer.concat(parts).toString("base64");
}

function hash(text) {
  return `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
}

function version() {
  return /^version = "(.*)"/m.exec(readFileSync(join(ROOT, "Cargo.toml"), "utf8"))?.[1] ?? "";
}

const { script, style } = await bundle("src/main.tsx", { ...OPTIONS, plugins: [made] });
const { script: boot } = await bundle("src/boot.ts", { ...OPTIONS, format: "esm" });
const policy = [
  "default-src 'none'",
  `script-src ${hash(boot)} ${hash(script)} 'wasm-unsafe-eval'`,
  `style-src ${hash(style)}`,
  "worker-src blob:",
  "img-src data: blob:",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");
const parts = {
  policy,
  version: version(),
  // the checksum that tools/build_studio.sh gets from python/kempe/studio/sources.py
  sources: process.env.KEMPE_SOURCES ?? "unknown",
  style,
  boot,
  packed: await packed(script),
  // "<" could end the element
  licences: licences(HERE, join(ROOT, "THIRD_PARTY_NOTICES.txt")).replaceAll("<", "‹").replaceAll(">", "›"),
};
const written = worded(readFileSync(join(HERE, "index.html"), "utf8"), (await words()).studioPage);
const page = written.replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
mkdirSync(join(HERE, "dist"), { recursive: true });
writeFileSync(join(HERE, "dist", "index.html"), page);
const size = gzipSync(page, { level: 9 }).length;
console.log(`dist/index.html: ${(page.length / 1000).toFixed(0)} kB, ${(size / 1000).toFixed(0)} kB compressed`);
if (!process.env.KEMPE_PLAIN && size > MOST)
  throw new Error(`the page has ${size} bytes compressed; the limit is ${MOST}`);
