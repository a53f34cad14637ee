"""Says how to compile and start each language's programs with the tools on this computer."""

import os
from dataclasses import dataclass, field
from pathlib import Path

from . import finding

WARNINGS = ("-Wall", "-Wextra", "-Wshadow", "-Wpedantic")
# A small heap's collector and one thread of it: a program starts sooner, and in little memory.
JVM = ("-Xshare:auto", "-XX:+UseSerialGC")


@dataclass(frozen=True)
class Toolchain:
    """Commands to compile and to start a program, as lists of words.

    The compiler warns of all it can.
    """

    compile: tuple[str, ...] = field(
        metadata={"doc": "run once in the folder of the sources; () where nothing is compiled"}
    )
    start: tuple[str, ...] = field(
        metadata={"doc": "run from anywhere, with the folder for {folder}"}
    )

    def started_in(self, folder: Path) -> list[str]:
        """The command that starts the program built in this folder."""
        return [part.replace("{folder}", str(folder)) for part in self.start]


def cpp() -> Toolchain:
    """driver.cpp and the headers it includes, C++17 with Eigen, $CXX or g++ or clang++.

    Raises MissingToolError. Eigen is sought in $ARMDYN_EIGEN, or else beside the compiler and in
    the usual places.
    """
    compiler = finding.program(
        "A C++ compiler",
        [chosen] if (chosen := os.environ.get("CXX")) else ["g++", "clang++"],
        "Debian or Ubuntu: apt install g++. macOS: xcode-select --install. Windows: MSYS2, and in "
        "it pacman -S mingw-w64-ucrt-x86_64-gcc.",
    )
    prefixes = [compiler.parents[1], Path("/usr"), Path("/usr/local"), Path("/opt/homebrew")]
    eigen = finding.folder(
        "Eigen",
        "ARMDYN_EIGEN",
        dict.fromkeys(prefix / "include" / "eigen3" for prefix in prefixes),
        "Eigen/Dense",
        "Debian or Ubuntu: apt install libeigen3-dev. macOS: brew install eigen. Windows: MSYS2, "
        "and in it pacman -S mingw-w64-ucrt-x86_64-eigen3.",
    )
    made = "driver.exe" if os.name == "nt" else "driver"
    flags = ("-std=c++17", "-O2", *WARNINGS, "-isystem", str(eigen))
    return Toolchain((str(compiler), *flags, "driver.cpp", "-o", made), (f"{{folder}}/{made}",))


def java() -> Toolchain:
    """Driver.java and what it needs of the classes beside it, with EJML's SimpleMatrix.

    Raises MissingToolError. EJML's jars are sought in $ARMDYN_EJML, or else where Debian has them.
    """
    install = (
        "Debian or Ubuntu: apt install default-jdk-headless. macOS: brew install openjdk. "
        "Windows: winget install EclipseAdoptium.Temurin.21.JDK."
    )
    compiler = finding.program("A Java compiler", ["javac"], install)
    java = finding.program("Java", ["java"], install)
    folder = finding.folder(
        "EJML",
        "ARMDYN_EJML",
        [Path("/usr/share/java")],
        "ejml-simple*.jar",
        "Debian or Ubuntu: apt install libejml-java. macOS, Windows: the jars of EJML 0.41 from "
        "ejml.org.",
    )
    jars = sorted({str(jar.resolve()) for jar in folder.glob("ejml-*.jar")})
    compiled = os.pathsep.join([".", *jars])
    # -path: jars name others that are not there.
    flags = ("-encoding", "UTF-8", "-proc:none", "-Xlint:all,-path", "-cp", compiled)
    path = os.pathsep.join(["{folder}", *jars])
    return Toolchain(
        (str(compiler), *flags, "Driver.java"),
        (str(java), *JVM, "-cp", path, "Driver"),
    )


def matlab() -> Toolchain:
    """driver.m and the functions beside it, run by GNU Octave. Raises MissingToolError."""
    octave = finding.program(
        "GNU Octave",
        ["octave-cli", "octave"],
        "Debian or Ubuntu: apt install octave. macOS: brew install octave. Windows: winget install "
        "GNU.Octave.",
    )
    return Toolchain(
        (), (str(octave), "--norc", "--quiet", "--path", "{folder}", "{folder}/driver.m")
    )


TOOLCHAINS = {"cpp": cpp, "java": java, "matlab": matlab}
