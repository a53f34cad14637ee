"""The files of a model's program in Java with EJML."""

from pathlib import Path

from armdyn.codegen.java import java
from armdyn.derive import Derivation
from armdyn.ports.toolchain import TOOLCHAINS

toolchain = TOOLCHAINS["java"]

_MODEL = """import org.ejml.simple.SimpleMatrix;

/** A generated model as the driver takes it, with a solver of its own. */
record Model(Generated model) implements Arm {{
  static final int JOINTS = {n};
  static final int PARAMETERS = {count};

  static Arm of(double[] p) {{
    return new Model(new Generated({values}));
  }}

  @Override
  public SimpleMatrix M(SimpleMatrix q) {{
    return model.M(q);
  }}

  @Override
  public SimpleMatrix C(SimpleMatrix q, SimpleMatrix qd) {{
    return model.C(q, qd);
  }}

  @Override
  public SimpleMatrix g_vec(SimpleMatrix q) {{
    return model.g_vec(q);
  }}

  @Override
  public SimpleMatrix f_vec(SimpleMatrix qd) {{
    return model.f_vec(qd);
  }}

  @Override
  public double potential_energy(SimpleMatrix q) {{
    return model.potential_energy(q);
  }}

  @Override
  public SimpleMatrix dynamics(
      SimpleMatrix q, SimpleMatrix qd, SimpleMatrix u, LinearSolver solver) {{
    return model.dynamics(q, qd, u);
  }}
}}
"""


def hand_written() -> dict[str, str]:
    """The arm of Planar2R.java, with the driver."""
    return _files("Planar2R.java", "Model.java", "Arm.java", "LinearSolver.java", "Driver.java")


def generated(derivation: Derivation) -> dict[str, str]:
    """What codegen writes for the derivation, with the driver; ValueError as `codegen.java`."""
    count = len(derivation.parameters)
    values = ", ".join(f"p[{i}]" for i in range(count))
    model = _MODEL.format(n=derivation.n, count=count, values=values)
    return _files("Arm.java", "LinearSolver.java", "Driver.java") | {
        "Generated.java": java(derivation, "Generated"),
        "Model.java": model,
    }


def _files(*names):
    return {name: Path(__file__).with_name(name).read_text(encoding="utf-8") for name in names}
