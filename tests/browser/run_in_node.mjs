// Runs notebooks in a site's Python, in Node: the kernel that a page has, without the page.
//
// Arguments: the site's folder; a file with the tasks, [{ name, folder, cells: [source, …] }]; and a file
// for the replies, [{ name, seconds, outputs: [what each cell gave] }].
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { pathToFileURL } from "node:url";

const [site, tasks, to] = process.argv.slice(2);
const place = join(site, "static", "pyodide");
const page = JSON.parse(readFileSync(join(site, "jupyter-lite.json"), "utf8"))["jupyter-config-data"];
const kernelOf = "@jupyterlite/pyodide-kernel-extension:kernel";
const { packages } = page.litePluginSettings[kernelOf].loadPyodideOptions;

// Node would print the line of the error, and that is all of Pyodide.
process.on("uncaughtException", (error) => {
  console.error(error.stack ?? error);
  process.exit(1);
});

const { loadPyodide } = await import(pathToFileURL(join(place, "pyodide.mjs")));
const quiet = () => {};
const indexURL = `${place}/`;
const pyodide = await loadPyodide({ indexURL, packages, stdout: quiet, stderr: quiet });

// A page asks the site for the numbers of a check, and Node has no XMLHttpRequest: here they lie beside.
const stored = pyodide.runPython(`
import json, pathlib, autograder.stored
where = json.loads((pathlib.Path(autograder.stored.__file__).parent / "where.json").read_text())
json.dumps([str(autograder.stored.files.FOLDER), where["folder"], where["names"]])
`);
const [data, folder, names] = JSON.parse(stored);
for (const name of names) pyodide.FS.writeFile(`${data}/${name}`, readFileSync(join(site, folder, name)));

pyodide.runPython("import pyodide_kernel");
const module = pyodide.globals.get("pyodide_kernel");
const kernel = module.kernel_instance;
const shell = kernel.interpreter;
const plain = (value) => value?.toJs?.({ dict_converter: Object.fromEntries }) ?? value;
let outputs = [];
const stream = (name, text) => outputs.at(-1).push({ stream: name, text });
const shown = (data) => outputs.at(-1).push({ data: plain(data) });
module.stdout_stream.publish_stream_callback = stream;
module.stderr_stream.publish_stream_callback = stream;
shell.display_pub.display_data_callback = shown;
shell.display_pub.update_display_data_callback = shown;
shell.display_pub.clear_output_callback = quiet;
shell.displayhook.publish_execution_result = (count, data) => shown(data);
shell.send_comm = quiet;
kernel._parent_header = pyodide.toPy({ header: {} });

const replies = [];
for (const task of JSON.parse(readFileSync(tasks, "utf8"))) {
  const started = performance.now();
  shell.reset();
  pyodide.FS.mkdirTree(task.folder);
  pyodide.FS.chdir(task.folder);
  pyodide.FS.writeFile(`${basename(task.name)}.ipynb`, "{}");
  outputs = [];
  for (const cell of task.cells) {
    outputs.push([]);
    const result = plain(await kernel.run(cell));
    if (result.status === "error") {
      outputs.at(-1).push({ error: result.ename, text: result.evalue, trace: plain(result.traceback) });
    }
  }
  const seconds = (performance.now() - started) / 1000;
  replies.push({ name: task.name, seconds, outputs });
}
writeFileSync(to, JSON.stringify(replies));
process.exit(0);
