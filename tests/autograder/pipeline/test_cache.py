"""What a kept result depends on."""

from pathlib import Path

from autograder.pipeline import cache

ROOT = Path(__file__).parents[3]


def test_a_result_depends_on_all_of_the_code(monkeypatch):
    read = {}
    sources = cache._sources

    def recorded(package):
        read[package] = [name for name, _ in sources(package)]
        return sources(package)

    monkeypatch.setattr(cache, "_sources", recorded)
    cache.code_version.__wrapped__()
    for folder, package in (
        ("autograder", ROOT / "autograder"),
        ("armdyn", ROOT / "lib" / "armdyn"),
    ):
        (names,) = [names for at, names in read.items() if at.name == folder]
        assert names == sorted(
            path.relative_to(package).as_posix()
            for path in package.rglob("*.*")
            if path.suffix in cache.SOURCES
        )
