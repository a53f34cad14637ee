"""The README's example runs as it stands."""

import re
from pathlib import Path

import pytest

README = Path(__file__).parents[1] / "README.md"


# Its model is in C, or in NumPy with a word on what to install.
@pytest.mark.filterwarnings("ignore:No working C compiler:RuntimeWarning")
def test_example_runs(capsys, monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path))
    (example,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.S)
    names = {}
    exec(example, names)
    assert "holds" in capsys.readouterr().out
    assert abs(names["energy_drift"](names["arm"], names["x"])).max() < 1e-5
    assert names["fast"].n == 3
