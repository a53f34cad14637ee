"""python -m docs.site FOLDER: writes the pages into the folder; every warning of Sphinx is an error."""

import shutil
import sys
import tempfile
from pathlib import Path

from sphinx.cmd.build import build_main

from docs.site.sources import HERE, lay_out


def main(folder: Path) -> int:
    """Writes the site; returns Sphinx's exit code, 0 where it has nothing to complain of."""
    with tempfile.TemporaryDirectory() as work:
        source = Path(work).resolve() / "source"
        lay_out(source)
        shutil.rmtree(folder, ignore_errors=True)
        settings = ["-c", str(HERE), "-d", f"{work}/doctrees", "-q", "-W", "--keep-going"]
        return build_main(["-b", "html", *settings, str(source), str(folder)])


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
