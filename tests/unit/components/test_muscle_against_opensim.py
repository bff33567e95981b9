"""The muscle–tendon unit against OpenSim's Millard muscle: the same trials, and the same curves in both.

Three computations of the tendon's force are compared: ours; OpenSim's, with its curves fitted to ours; and the
equations of ours, integrated by SciPy, with OpenSim's curves put in. What the last two differ in is dynamics, what the
first two differ in is mostly curves. `pip install --group opensim` brings OpenSim.
"""

from dataclasses import dataclass
from math import exp, log, pi

import numba
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

from neuromech.compiler.numerics import elementwise
from neuromech.components.muscle_tendon import MuscleTendonUnit

opensim = pytest.importorskip("opensim", reason="pip install --group opensim")
opensim.Logger.setLevelString("Off")
opensim.Logger.removeFileSink()

# The vastus of table 2.2: N, m, m, 1/s.
FORCE, OPTIMAL, SLACK, FASTEST = 6000.0, 0.08, 0.23, 12.0
STEP, TIME_CONSTANT = 1e-3, 0.01
LENGTHS, VELOCITIES, STRAINS = np.linspace(0.55, 1.45, 60), np.linspace(-1.0, 1.0, 80), np.linspace(0.0, 0.06, 60)


def own_force_length(length):
    return np.exp(log(0.05) * np.abs((length - 1.0) / 0.56) ** 3)


def own_force_velocity(velocity):
    eccentric = 1.5 + 0.5 * (velocity - 1.0) / (37.8 * velocity + 1.0)
    return np.where(velocity < 0.0, (1.0 + velocity) / (1.0 - 5.0 * velocity), eccentric)


def own_tendon(strain):
    return (np.maximum(0.0, strain) / 0.04) ** 2


@dataclass(frozen=True)
class Curves:
    """Parameters of OpenSim's curves, and how far they stay from ours at most, in maximal forces."""

    length: np.ndarray
    velocity: np.ndarray
    tendon: np.ndarray
    errors: tuple[float, float, float]

    def force_length(self):
        return opensim.ActiveForceLengthCurve(*self.length, 0.0)

    def force_velocity(self, cls=opensim.ForceVelocityCurve):
        """Slopes at the fastest velocities are ours: 1/6 and 0.5/38.8."""
        near, isometric, eccentric, *curviness = self.velocity
        return cls(1.0 / 6.0, near, isometric, 0.0129, eccentric, 1.5, *curviness)

    def tendon_force(self):
        return opensim.TendonForceLengthCurve(0.04, *self.tendon)


def values(curve, places):
    return np.array([curve.calcValue(float(place)) for place in places])


def fitted(make, start, bounds, places, wanted):
    found = least_squares(lambda p: values(make(p), places) - wanted, start, bounds=bounds, diff_step=1e-3, max_nfev=60)
    return found.x, float(np.abs(found.fun).max())


@pytest.fixture(scope="module")
def curves():
    nothing = np.zeros(0)
    make = Curves(nothing, nothing, nothing, (0.0, 0.0, 0.0))
    found = [
        fitted(
            lambda p: Curves(p, nothing, nothing, make.errors).force_length(),
            [0.44, 0.73, 1.6, 0.86], ([0.2, 0.5, 1.45, 0.0], [0.5, 0.95, 2.2, 1.5]),
            LENGTHS, own_force_length(LENGTHS),
        ),
        fitted(
            lambda p: Curves(nothing, p, nothing, make.errors).force_velocity(),
            [0.2, 6.0, 0.02, 0.6, 0.9], ([0.168, 3.0, 0.013, 0.0, 0.0], [0.6, 20.0, 0.5, 1.0, 1.0]),
            VELOCITIES, own_force_velocity(VELOCITIES),
        ),
        fitted(
            lambda p: Curves(nothing, nothing, p, make.errors).tendon_force(),
            [50.0, 0.667, 0.5], ([26.0, 0.05, 0.0], [80.0, 0.99, 1.0]),
            1.0 + STRAINS, own_tendon(STRAINS),
        ),
    ]  # fmt: skip
    (length, first), (velocity, second), (tendon, third) = found
    return Curves(length, velocity, tendon, (first, second, third))


@dataclass(frozen=True)
class Trial:
    """A history of path length (m, m/s) and stimulation in steps of 1 ms, and what follows from it.

    `knots` are the times between steps (s), `way` the lengths there, `activity` the activation at a quarter of a step.
    """

    velocity: np.ndarray
    stimulation: np.ndarray
    start: float
    at_rest: float

    @property
    def knots(self):
        return np.arange(len(self.velocity) + 1) * STEP

    @property
    def way(self):
        return self.start + np.concatenate([[0.0], np.cumsum(self.velocity) * STEP])

    @property
    def activity(self):
        found = [self.at_rest]
        for stimulation in np.repeat(self.stimulation, 4):
            found.append(stimulation + (found[-1] - stimulation) * exp(-0.25 * STEP / TIME_CONSTANT))
        return np.array(found)


def speed_of_ramp(speed):
    """A ramp of 80 ms from 50 ms on, without jumps of speed, at which OpenSim's integrator stops."""
    time = np.arange(300) * STEP
    return np.where((time >= 0.05) & (time < 0.13), 0.5 * speed * (1.0 - np.cos(2.0 * pi * (time - 0.05) / 0.08)), 0.0)


BURST = np.where((np.arange(300) >= 50) & (np.arange(300) < 200), 0.9, 0.05)
TRIALS = {
    "isometric": Trial(np.zeros(300), BURST, 0.31, 0.05),
    "isometric and short": Trial(np.zeros(300), BURST, 0.295, 0.05),
    "stretched": Trial(speed_of_ramp(0.15), np.full(300, 0.5), 0.302, 0.5),
    "shortened": Trial(speed_of_ramp(-0.15), np.full(300, 0.5), 0.314, 0.5),
}
advance = elementwise(MuscleTendonUnit.advance)


@numba.njit
def own_run(way, velocity, stimulation, activation, fibre):
    """Mean force (N) in each step, with the fibre steps of 0.5 ms that documents use."""
    found = np.zeros(len(velocity))
    for k in range(len(velocity)):
        for part in range(2):
            activation, fibre, mean = advance(
                activation, fibre, stimulation[k], way[k], velocity[k], 6000.0, 0.08, 0.23, 12.0,
                0.56, 0.05, 5.0, 1.5, 0.04, 0.01, 0.5e-3, 0.5e-3 * part,
            )  # fmt: skip
            found[k] += 0.5 * mean
    return found


def own_force(trial):
    path = {"kind": "lever_arms", "reference_length": "1 m"}
    arm = {"kind": "constant", "radius": "1 m", "reference_angle": "0 deg"}
    unit = MuscleTendonUnit(
        motoneuron="pool",
        path={**path, "arms": {"knee": arm}},
        maximal_force=f"{FORCE} N",
        optimal_length=f"{OPTIMAL} m",
        tendon_slack_length=f"{SLACK} m",
        maximal_velocity=f"{FASTEST} 1/s",
        initial_activation=trial.at_rest,
    )
    fibre = unit.states_at_rest(trial.start)["fibre_length"]
    return own_run(trial.way, trial.velocity, trial.stimulation, trial.at_rest, fibre)


def means(force):
    """Mean of each millisecond from samples at its ends and its middle, by the trapezoid rule."""
    return 0.25 * (force[:-2:2] + 2.0 * force[1::2] + force[2::2])


def function_through(cls, time, heights):
    function = cls()
    for t, height in zip(time, heights, strict=True):
        function.addPoint(float(t), float(height))
    return function


def opensim_force(trial, curves):
    """Return mean forces (N) of OpenSim's muscle between ground and a block whose way is given, and the first fibre."""
    model = opensim.Model()
    model.setGravity(opensim.Vec3(0))
    block = opensim.Body("block", 1.0, opensim.Vec3(0), opensim.Inertia(1.0))
    slider = opensim.SliderJoint("slider", model.getGround(), block)
    coordinate = slider.updCoordinate()
    coordinate.setPrescribedFunction(function_through(opensim.SimmSpline, trial.knots, trial.way))
    coordinate.setDefaultIsPrescribed(True)
    muscle = opensim.Millard2012EquilibriumMuscle("vastus", FORCE, OPTIMAL, SLACK, 0.0)
    muscle.setMaxContractionVelocity(FASTEST)
    muscle.set_ignore_activation_dynamics(True)
    muscle.setFiberDamping(0.0)
    muscle.setActiveForceLengthCurve(curves.force_length())
    muscle.setForceVelocityCurve(curves.force_velocity())
    muscle.setTendonForceLengthCurve(curves.tendon_force())
    muscle.addNewPathPoint("origin", model.getGround(), opensim.Vec3(0))
    muscle.addNewPathPoint("insertion", block, opensim.Vec3(0))
    model.addBody(block)
    model.addJoint(slider)
    model.addForce(muscle)
    controller = opensim.PrescribedController()
    controller.addActuator(muscle)
    quarters = np.linspace(0.0, trial.knots[-1], len(trial.activity))
    activity = function_through(opensim.PiecewiseLinearFunction, quarters, trial.activity)
    controller.prescribeControlForActuator("vastus", activity)
    model.addController(controller)
    state = model.initSystem()
    model.equilibrateMuscles(state)
    fibre = muscle.getFiberLength(state)
    manager = opensim.Manager(model)
    manager.setIntegratorAccuracy(1e-7)
    manager.initialize(state)
    found = [muscle.getActuation(state)]
    for t in np.linspace(0.0, trial.knots[-1], 2 * len(trial.velocity) + 1)[1:]:
        state = manager.integrate(float(t))
        model.realizeDynamics(state)
        found.append(muscle.getActuation(state))
    return means(np.array(found)), fibre


def mixed_force(trial, curves, fibre):
    """Return mean forces (N) of our equations with OpenSim's curves, from a fibre length (m) on."""
    lengths, strains, factors = np.linspace(0.3, 1.8, 6001), np.linspace(0.0, 0.1, 6001), np.linspace(0.0, 1.5, 6001)
    active, tendon = values(curves.force_length(), lengths), values(curves.tendon_force(), 1.0 + strains)
    velocity = values(curves.force_velocity(opensim.ForceVelocityInverseCurve), factors)
    passive = values(opensim.FiberForceLengthCurve(), lengths)
    quarters = np.linspace(0.0, trial.knots[-1], len(trial.activity))
    way = trial.way

    def pull(t, length):
        return np.interp((np.interp(t, trial.knots, way) - length) / SLACK - 1.0, strains, tendon)

    def rate(t, state):
        length = state[0]
        able = np.interp(t, quarters, trial.activity) * np.interp(length / OPTIMAL, lengths, active)
        factor = (pull(t, length) - np.interp(length / OPTIMAL, lengths, passive)) / able
        return [OPTIMAL * FASTEST * np.interp(min(max(factor, 0.0), 1.5), factors, velocity)]

    times = np.linspace(0.0, trial.knots[-1], 2 * len(trial.velocity) + 1)
    ends = (0.0, float(trial.knots[-1]))
    found = solve_ivp(rate, ends, [fibre], t_eval=times, max_step=5e-4, rtol=1e-6, atol=1e-9)
    return means(FORCE * pull(times, found.y[0]))


def test_curves_of_opensim_can_be_brought_near_ours_but_not_onto_them(curves):
    """Its curves are splines of fifth order; ours have a corner at zero velocity and a cubic top."""
    assert np.all(np.array(curves.errors) < (0.11, 0.08, 0.065))
    assert np.all(np.array(curves.errors) > 0.03)


@pytest.mark.parametrize("name", TRIALS)
def test_with_the_same_curves_force_differs_by_less_than_two_thousandths(curves, name):
    theirs, fibre = opensim_force(TRIALS[name], curves)
    assert np.ptp(theirs) > 0.1 * FORCE
    assert np.abs(mixed_force(TRIALS[name], curves, fibre) - theirs).max() < 2e-3 * FORCE


@pytest.mark.parametrize("name", TRIALS)
def test_with_our_own_curves_it_differs_by_less_than_their_difference(curves, name):
    theirs, _ = opensim_force(TRIALS[name], curves)
    difference = own_force(TRIALS[name]) - theirs
    assert np.abs(difference).max() < 0.075 * FORCE < max(curves.errors) * FORCE
    assert np.sqrt(np.mean(difference**2)) < 0.03 * FORCE
