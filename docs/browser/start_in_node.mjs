// Starts a site's Python as a page does, up to where a check can be called, and writes the bytecode of all
// modules that this imports from packages.
//
// Arguments: the site's folder with Pyodide; the folder to write into, each file by its path below
// site-packages; the packages of a kernel; what is imported, by names with commas between.
import { mkdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";

const [place, to, packages, imports] = process.argv.slice(2);

process.on("uncaughtException", (error) => {
  console.error(String(error.message ?? error));
  process.exit(1);
});

const { loadPyodide } = await import(pathToFileURL(join(place, "pyodide.mjs")));
const quiet = () => {};
const pyodide = await loadPyodide({
  indexURL: `${place}/`,
  packages: packages.split(","),
  stdout: quiet,
  stderr: quiet,
});
await pyodide.loadPackagesFromImports(`import ${imports}`, { messageCallback: quiet });
const compiled = pyodide.runPython(`
import ${imports}
import json, py_compile, sys
from pathlib import Path

site = Path(numpy.__file__).parents[1]
files = (getattr(module, "__file__", None) or "" for module in list(sys.modules.values()))
sources = {Path(file) for file in files if file.endswith(".py") and site in Path(file).parents}
# The page's files have no times of their own to compare.
mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
json.dumps({
    str(Path(file).relative_to(site)): file
    for source in sorted(sources)
    if (file := py_compile.compile(str(source), doraise=True, invalidation_mode=mode))
})
`);
for (const [name, file] of Object.entries(JSON.parse(compiled))) {
  mkdirSync(dirname(join(to, name)), { recursive: true });
  writeFileSync(join(to, name), pyodide.FS.readFile(file));
}
process.exit(0);
