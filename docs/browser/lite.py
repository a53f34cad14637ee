"""Builds the site: JupyterLab in the browser (JupyterLite), with the course's notebooks and packages."""

import json
import subprocess
import sys
import tempfile
import zipfile
from importlib import metadata
from pathlib import Path

from docs.browser.course import Course
from docs.browser.installed import wheel_of
from docs.browser.pyodide import LOCK, START, Pyodide, Wheel

KERNEL = "@jupyterlite/pyodide-kernel-extension"
WIDGETS = "@jupyter-widgets/jupyterlab-manager"
EXTENSIONS = Path(sys.prefix) / "share" / "jupyter" / "labextensions"
PLACE = "static/pyodide"
# The kernel's, which it would install one by one; and what each notebook imports.
AT_ONCE = (
    *("micropip", "piplite", "ipykernel", "comm", "pyodide-kernel", "jedi", "ipython"),
    *("numpy", "armdyn", "in-browser"),
)
# When a cell asks for them.
LATER = ("matplotlib", "scipy", "sympy", "tqdm", "ipywidgets")
NEVER_PYODIDES = {
    "comm": ("comm", ()),
    "jupyterlab-widgets": ("jupyterlab_widgets", ()),
    "ipywidgets": (
        "ipywidgets",
        ("comm", "ipython", "jupyterlab-widgets", "traitlets", "widgetsnbextension"),
    ),
}
WHERE_PYODIDE_LACKS = {
    "mpmath": ("mpmath", ()),
    "sympy": ("sympy", ("mpmath",)),
    "tqdm": ("tqdm", ()),
}
# Below its folder in a kernel's extension.
WHEELS_OF_KERNEL = "static/pypi"
SETTINGS = {
    "@jupyterlab/apputils-extension:notification": {"fetchNews": "false"},
    # As `autograder lab` sets it, for links to a section of a long lesson.
    "@jupyterlab/notebook-extension:tracker": {"windowingMode": "defer"},
}

# JupyterLite reads this element of the page, too, and does not start without it.
CONFIG = "jupyter-config-data"
FIRST = "lab/index.html?path=lessons/00-start-here.ipynb"
FRONT = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url={FIRST}">
<title>armdyn</title>
<script id="{CONFIG}" type="application/json">{{}}</script>
</head>
<body><p><a href="{FIRST}">Open the first lesson</a></p></body>
</html>
"""


class SiteError(RuntimeError):
    """JupyterLite did not build the site; the message is its own."""


def build(course: Course, pyodide: Pyodide, to: Path) -> None:
    """Write the site into the folder, which is made. SiteError, PyodideError, OSError."""
    with tempfile.TemporaryDirectory(prefix="lite-") as work:
        lite = Path(work)
        course.write_contents(lite / "contents")
        (lite / "jupyter_lite_config.json").write_text(json.dumps(_config(to)), encoding="utf-8")
        (lite / "jupyter-lite.json").write_text(
            json.dumps(_page(course, pyodide)), encoding="utf-8"
        )
        (lite / "overrides.json").write_text(json.dumps(SETTINGS), encoding="utf-8")
        command = [sys.executable, "-m", "jupyterlite_core", "build", "--lite-dir", str(lite)]
        made = subprocess.run(command, cwd=lite, capture_output=True, text=True, check=False)
        if made.returncode:
            raise SiteError(
                f"JupyterLite did not build the site: {(made.stderr or made.stdout)[-2000:]}"
            )
        (to / "index.html").write_text(FRONT, encoding="utf-8")
        course.write_numbers(to)
        pyodide.write(to / PLACE, _wheels(course, pyodide, lite), (*AT_ONCE, *LATER))


def _config(to: Path) -> dict:
    return {
        "LiteBuildConfig": {
            "apps": ["lab"],
            "contents": ["contents"],
            "output_dir": str(to.resolve()),
            # Not what else is installed beside the course, such as nbgrader's.
            "ignore_sys_prefix": ["federated_extensions"],
            "federated_extensions": [str(EXTENSIONS / name) for name in (KERNEL, WIDGETS)],
            "no_sourcemaps": True,
            "no_unused_shared_packages": True,
        }
    }


def _page(course: Course, pyodide: Pyodide) -> dict:
    """jupyter-lite.json: what the pages are told."""
    kernel: dict = {
        "disablePyPIFallback": True,
        "loadPyodideOptions": {"packages": list(AT_ONCE)},
    }
    if isinstance(pyodide.place, Path):
        kernel["pyodideUrl"] = f"./{PLACE}/{START}"
    else:
        kernel["pyodideUrl"] = f"{pyodide.place}/{START}"
        kernel["loadPyodideOptions"]["lockFileURL"] = f"./{PLACE}/{LOCK}"
    return {
        "jupyter-lite-schema-version": 0,
        "jupyter-config-data": {
            "appName": "armdyn",
            "contentsStorageName": "armdyn",
            "settingsStorageName": "armdyn settings",
            "workspacesStorageName": "armdyn workspaces",
            "litePluginSettings": {f"{KERNEL}:kernel": kernel},
        },
    }


def _wheels(course: Course, pyodide: Pyodide, folder: Path) -> list[Wheel]:
    found = [course.package(folder), course.start_up(folder), *_of_kernel()]
    for name, (imports, needs) in NEVER_PYODIDES.items():
        if not pyodide.has(name):
            found.append(wheel_of(name, imports, needs))
    for name, (imports, needs) in WHERE_PYODIDE_LACKS.items():
        if not pyodide.has(name):
            found.append(wheel_of(name, imports, needs))
    return found


def _of_kernel() -> list[Wheel]:
    """The wheels that the kernel's extension brings; of two versions of one, the newer."""
    found = {}
    for path in sorted((EXTENSIONS / KERNEL / WHEELS_OF_KERNEL).glob("*.whl")):
        name, version = path.name.split("-")[:2]
        with zipfile.ZipFile(path) as wheel:
            tops = {part.partition("/")[0].removesuffix(".py") for part in wheel.namelist()}
        imports = tuple(sorted(top for top in tops if not top.endswith(".dist-info")))
        needs = ("ipython", "comm", "ipykernel") if name == "pyodide_kernel" else ()
        needs = ("micropip",) if name == "piplite" else needs
        found[name] = Wheel(
            name.replace("_", "-"), version, path.name, path.read_bytes(), imports, needs
        )
    assert metadata.version("jupyterlite-pyodide-kernel") == found["pyodide_kernel"].version
    return list(found.values())
