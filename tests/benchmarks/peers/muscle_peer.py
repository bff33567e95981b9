"""One muscle driven through a length history: `muscle_peer.py HISTORY (mujoco|opensim)`.

HISTORY holds `length` (fibre lengths as shares of the optimal length), `velocity` (optimal lengths per second) and
`activation`. `run N` evaluates N samples, round and round, and answers the seconds that it took. MuJoCo's muscle is
evaluated in C, called from a loop that numba compiles; OpenSim's Millard muscle with a rigid tendon is evaluated
through OpenSim's Python interface, which is the only way into its wheel: state set, dynamics realised, force read.
"""

import ctypes
import glob
import os
import sys
import time

import numpy as np
from talk import network, own_stdout, serve


def mujoco_run(history: dict):
    """Return version, scheme and run of MuJoCo's muscle."""
    import mujoco
    import numba

    library = ctypes.CDLL(glob.glob(os.path.join(os.path.dirname(mujoco.__file__), "libmujoco.so*"))[0])
    double, pointer = ctypes.c_double, ctypes.c_void_p
    gain, bias = library.mju_muscleGain, library.mju_muscleBias
    gain.restype, gain.argtypes = double, [double, double, pointer, double, pointer]
    bias.restype, bias.argtypes = double, [double, pointer, double, pointer]
    length, velocity, activation = (np.array(history[name]) for name in ("length", "velocity", "activation"))
    # Lengths are given in optimal lengths: with this operating range the tendon's length is the fibre's.
    limits = np.array([0.75, 1.05])
    settings = np.array([0.75, 1.05, 100.0, 200.0, 0.5, 1.6, 1.5, 1.3, 1.2])

    @numba.njit
    def loop(count, force, limits_at, settings_at):
        for k in range(count):
            n = k % length.shape[0]
            force[n] = activation[n] * gain(length[n], velocity[n], limits_at, 1.0, settings_at)
            force[n] += bias(length[n], limits_at, 1.0, settings_at)

    def run(count: int) -> tuple[float, np.ndarray]:
        force = np.zeros(len(length))
        started = time.perf_counter()
        loop(count, force, limits.ctypes.data, settings.ctypes.data)
        return time.perf_counter() - started, -force

    run(1)
    return mujoco.__version__, "built-in muscle, called from compiled code", run


def opensim_run(history: dict):
    """Return version, scheme and run of OpenSim's Millard muscle."""
    import opensim

    model = opensim.Model()
    block = opensim.Body("block", 1.0, opensim.Vec3(0), opensim.Inertia(1.0))
    slider = opensim.SliderJoint("slider", model.getGround(), block)
    coordinate = slider.updCoordinate()
    coordinate.setName("position")
    muscle = opensim.Millard2012EquilibriumMuscle("muscle", 100.0, 1.0, 0.5, 0.0)
    muscle.set_ignore_tendon_compliance(True)
    muscle.addNewPathPoint("origin", model.getGround(), opensim.Vec3(0))
    muscle.addNewPathPoint("insertion", block, opensim.Vec3(0))
    model.addBody(block)
    model.addJoint(slider)
    model.addForce(muscle)
    state = model.initSystem()

    def run(count: int) -> tuple[float, np.ndarray]:
        samples = list(zip(history["length"], history["velocity"], history["activation"], strict=True))
        force = np.zeros(len(samples))
        started = time.perf_counter()
        for k in range(count):
            n = k % len(samples)
            length, velocity, activation = samples[n]
            coordinate.setValue(state, length + 0.5, False)
            coordinate.setSpeedValue(state, velocity)
            muscle.setActivation(state, activation)
            model.realizeDynamics(state)
            force[n] = muscle.getActuation(state)
        return time.perf_counter() - started, force

    return opensim.GetVersion().split("-")[0], "Millard muscle with a rigid tendon, through Python", run


def main() -> None:
    """Serve runs of one engine's muscle."""
    answers, history, engine = own_stdout(), network(), sys.argv[2]
    if engine == "mujoco":
        version, scheme, run = mujoco_run(history)
        serve(answers, "MuJoCo", version, scheme, run)
    else:
        version, scheme, run = opensim_run(history)
        serve(answers, "OpenSim", version, scheme, run)


if __name__ == "__main__":
    main()
