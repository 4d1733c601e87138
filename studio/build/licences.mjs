// The licences of the packages in the page, and of the crates in the core.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

/** Licences whose terms are met by their text in the page. */
const ALLOWED = ["MIT", "ISC", "BSD-2-Clause", "BSD-3-Clause", "Apache-2.0", "0BSD"];

/**
 * One text with all licences. Development packages are left out.
 * @throws Error a package has another licence
 */
export function licences(studio, notices) {
  const { packages } = JSON.parse(readFileSync(join(studio, "package-lock.json"), "utf8"));
  const shipped = Object.entries(packages).filter(([folder, one]) => folder && !one.dev);
  return [readFileSync(notices, "utf8"), ...shipped.map(([folder, one]) => ofPackage(join(studio, folder), one))].join(
    "\n\n",
  );
}

function ofPackage(folder, { version, license }) {
  const { name, author } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  if (!ALLOWED.includes(license)) throw new Error(`${name} has the licence ${license}, which the page may not contain`);
  const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
  const text = file ? readFileSync(join(folder, file), "utf8") : `Copyright (c) ${author?.name ?? author}`;
  return `${name} ${version} (${license})\n\n${text.trim()}`;
}
