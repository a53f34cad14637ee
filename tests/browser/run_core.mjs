// Runs a program in a Pyodide that has no packages but those of a lock file of ours, in Node.
//
// Arguments: Pyodide's folder; the lock file; the packages to load, with commas; a zip to unpack at /zip; and
// the program, whose last value is printed.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [core, lockFileURL, packages, zip, program] = process.argv.slice(2);
process.on("uncaughtException", (error) => {
  console.error(String(error.message ?? error).slice(-6000));
  process.exit(1);
});
const { loadPyodide } = await import(pathToFileURL(join(core, "pyodide.mjs")));
const quiet = () => {};
const pyodide = await loadPyodide({
  indexURL: `${core}/`, lockFileURL, packages: packages.split(","), stdout: quiet, stderr: quiet,
});
pyodide.unpackArchive(new Uint8Array(readFileSync(zip)), "zip", { extractDir: "/zip" });
console.log(pyodide.runPython(readFileSync(program, "utf8")));
process.exit(0);
