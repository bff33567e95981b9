"""Documents for the tests of the spec layer."""

import pytest

from neuromech.components.catalogue import Catalogue
from neuromech.spec.load import load

HALF_CENTRE = """\
neuromech: 1
name: half centre
parameters:
  drive: {value: 2.05, minimum: 0, maximum: 3}
  rhythm_time: {value: 300 ms}
modules:
  leg:
    arguments:
      tau: {default: "${rhythm_time}"}
      other:
      hip: {default: [10 mm, 20 mm, 0 mm]}
    network:
      neurons:
        RG-F: {kind: rybak_neuron, sodium_conductance: 3.5 nS, maximal_inactivation_time: "${tau}"}
        In: {kind: rybak_interneuron}
      synapses:
        excitatory:
          RG-F: {In: 0.4}
        interlimb:
          RG-F: {"${other}.RG-F": 0.1}
    body:
      segments:
        thigh:
          mass: 200 g
          inertia: [1e-4 kg m^2, 1e-4 kg m^2, 1e-5 kg m^2]
          center_of_mass: [0 mm, -5 mm, -30 mm]
      joints:
        hip: {parent: trunk, child: thigh, position: "${hip}", axis: [0.1, 1, 0.2]}
instances:
  LF: {use: leg, with: {other: RF}}
  RF: {mirror: LF, with: {other: LF}}
network:
  drives:
    MLR: {kind: descending_drive, strength: "${drive}"}
  synapses:
    excitatory:
      MLR: {LF.RG-F: 0.1, RF.RG-F: 0.1}
body:
  engine: hinge
  segments:
    trunk: {mass: 1 kg, inertia: [1e-3 kg m^2, 1e-3 kg m^2, 1e-3 kg m^2]}
protocol:
  duration: 2 s
record:
  all: {signals: ["*"], every: 1 ms}
"""


@pytest.fixture
def write(tmp_path, monkeypatch):
    """A function that writes a document into an empty current folder and returns its relative path."""
    monkeypatch.chdir(tmp_path)

    def _write(text, name="document.yaml"):
        path = tmp_path.__class__(name)
        path.write_text(text, encoding="utf-8")
        return path

    return _write


@pytest.fixture
def loaded(write):
    """A function that loads the text of a document."""

    def _loaded(text, *overrides):
        return load(write(text), catalogue=Catalogue.built_in(), overrides=overrides)

    return _loaded


@pytest.fixture
def half_centre():
    """The text of a valid document that uses modules, a mirror and parameters."""
    return HALF_CENTRE
