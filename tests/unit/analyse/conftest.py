"""Synthetic recordings whose measures are known exactly."""

import numpy as np
import pytest

from neuromech.simulate.anatomy import NO_BODY
from neuromech.simulate.recording import GroupData, Outcome, Provenance, Recording

STEP = 0.5e-3


@pytest.fixture
def time():
    return np.arange(0.0, 5.0 + STEP / 2, STEP)


@pytest.fixture
def record(time):
    """Make a recording from {name: values} or {name: (values, unit)}."""

    def make(signals, outcome=None, time=time, anatomy=NO_BODY):
        pairs = [pair if isinstance(pair, tuple) else (pair, "") for pair in signals.values()]
        values = np.column_stack([values for values, _ in pairs])
        units = tuple(unit for _, unit in pairs)
        ended = outcome or Outcome("finished", float(time[-1]))
        origin = Provenance("synthetic", "", "0", {}, "none", "any", 0, {}, ended, ended.time, 1.0, anatomy)
        return Recording.from_groups({"all": GroupData(time, tuple(signals), values, units)}, origin)

    return make


@pytest.fixture
def burst(time):
    """Make half-sine bursts: activity from phase `onset` for part `duty` of each cycle, zero elsewhere."""

    def make(period=0.457, onset=0.0, duty=0.3, height=0.4, time=time):
        phase = (time / period - onset) % 1.0
        return np.where(phase < duty, height * np.sin(np.pi * phase / duty), 0.0)

    return make
