"""Knows each language: how an answer looks in it, how it is built, and how it fails."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

try:
    from armdyn.ports import toolchain
except ImportError:  # in the sandbox there is no armdyn, only this part of it
    import toolchain  # type: ignore[import-not-found, no-redef]

HERE = Path(__file__).parent
# The functions that may be written in these languages, and their arguments.
ARGUMENTS = {"M": "q, arm", "C": "q, qd, arm"}
# A Java machine takes all the memory and threads it finds; a sandbox has few.
JVM = (
    "-XX:+UseSerialGC",
    "-XX:TieredStopAtLevel=1",
    "-XX:ActiveProcessorCount=1",
    "-XX:-UsePerfData",
    "-XX:ReservedCodeCacheSize=32m",
    "-XX:CompressedClassSpaceSize=64m",
    "-Xmx256m",
)


@dataclass(frozen=True)
class Language:
    """One of the languages.

    key: its name among armdyn's ports. drivers: the files beside the student's; $NAME and $ARGUMENTS
    in them are filled in. signature: by the function's name. failures: matches the part of a program's
    last output that says why it ended; {file} and {name} are the student's.
    """

    key: str
    suffix: str
    drivers: tuple[str, ...]
    signature: dict[str, str]
    failures: str

    def toolchain(self):
        """How its programs are built and started here; MissingToolError says what to install."""
        found = toolchain.TOOLCHAINS[self.key]()
        if self.key == "cpp":  # a warning would stand before the error that matters
            return replace(found, compile=(*found.compile, "-w"))
        if self.key == "java":
            compiler, *flags = found.compile
            java, *options = found.start
            return replace(
                found,
                compile=(compiler, *(f"-J{option}" for option in JVM), *flags),
                start=(java, *JVM, *options),
            )
        return found

    def files(self, name: str, text: str) -> dict[str, str]:
        """The student's file with this text, and the files around it."""
        files = {name + self.suffix: text}
        for driver in self.drivers:
            source = (HERE / driver).read_text(encoding="utf-8")
            source = source.replace("$NAME", name).replace("$ARGUMENTS", ARGUMENTS[name])
            files[driver] = source
        return files

    def first_error(self, name: str, text: str) -> str:
        """The first error of a compiler, with the place in the student's file."""
        file = name + self.suffix
        lines = text.splitlines()
        at = next((k for k, line in enumerate(lines) if "error:" in line), None)
        if at is None:
            return text
        error = lines[at].partition("error:")[2].strip()
        # javac names what it could not find in the lines below.
        below = [line.split() for line in lines[at + 1 : at + 5]]
        error += "".join(f" ({' '.join(words)})" for words in below if words[:1] == ["symbol:"])
        if lines[at].startswith(self.drivers[0]):
            return f"{file} must define {self.signature[name]}: {error}"
        # For an error in a library's template, the lines around it lead to the student's line.
        around = [lines[at], *reversed(lines[:at]), *lines[at + 1 :]]
        places = (re.search(rf"{re.escape(file)}:\d+(:\d+)?", line) for line in around)
        place = next(filter(None, places), None)
        return f"{place.group() if place else file}: {error}"

    def last_words(self, name: str, text: str) -> str:
        """The part of a program's last output that says why it ended."""
        telling = self.failures.format(file=re.escape(name + self.suffix), name=name)
        found = [match.group().strip() for match in re.finditer(telling, text, re.MULTILINE)]
        return "; ".join(dict.fromkeys(found[:3]))


LANGUAGES = {
    language.suffix: language
    for language in (
        Language(
            "cpp",
            ".cpp",
            ("driver.cpp", "arm.hpp"),
            {
                "M": "Eigen::Matrix2d M(const Eigen::Vector2d& q, const Arm& arm)",
                "C": "Eigen::Matrix2d C(const Eigen::Vector2d& q, const Eigen::Vector2d& qd, "
                "const Arm& arm)",
            },
            r"(?<=terminate called after throwing an instance of ).*|what\(\):.*|Assertion.*",
        ),
        Language(
            "java",
            ".java",
            ("Driver.java", "Arm.java"),
            {
                "M": "class M with static SimpleMatrix M(SimpleMatrix q, Arm arm)",
                "C": "class C with static SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd, Arm arm)",
            },
            r"(?<=^Exception in thread \"main\" ).*|\({file}:\d+\)",
        ),
        Language(
            "matlab",
            ".m",
            ("driver.m",),
            {"M": "function value = M(q, arm)", "C": "function value = C(q, qd, arm)"},
            r"(?<=^error: )(?!called from|ignoring).*|^ *{name} at line.*|^ *syntax error|^>>>.*",
        ),
    )
}
