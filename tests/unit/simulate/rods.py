"""A rod on a hinge between two passive muscles, as plain values of a document."""

MASS, ARM, INERTIA, GRAVITY, START_DEGREES = 0.3, 0.2, 2e-3 + 0.3 * 0.2**2, 9.81, 40


def muscle(optimal, stiffness, scale, arm="20 mm"):
    path = {"kind": "constant_moment_arms", "reference_length": "140 mm", "reference_angles": {"hinge": "0 deg"}}
    return {
        "kind": "brown_muscle",
        **dict.fromkeys(("motoneuron", "flexor", "extensor"), "pool"),
        "path": {**path, "moment_arms": {"hinge": arm}},
        "maximal_force": "50 N",
        "optimal_length": optimal,
        "standing_length": optimal,
        "passive_stiffness_in_flexion": stiffness,
        "passive_stiffness_in_extension": stiffness,
        "passive_scale": scale,
    }


def rod(step=1, passive=1, coupling="observer_implicit", damping="0 N m s/rad", duration=3):
    """A rod that hangs from a hinge, let go at 40°, with muscles that no motoneuron activates.

    The passive force of the one is a spring that hardens from 1.4 optimal lengths on; the other has none.
    """
    hinge = {"parent": "base", "child": "rod", "position": ["0 m", "0 m", "0 m"], "axis": [0, 1, 0]}
    return {
        "network": {"neurons": {"pool": {"kind": "rate_neuron", "time_constant": "10 ms", "half_activity_input": 1e6}}},
        "muscles": {"spring": muscle("100 mm", 0.2, passive), "slack": muscle("200 mm", 0, 0)},
        "body": {
            "engine": "hinge",
            "segments": {
                "base": {"mass": "1 kg", "inertia": ["1 g m^2", "1 g m^2", "1 g m^2"]},
                "rod": {
                    "mass": f"{MASS} kg",
                    "center_of_mass": ["0 m", "0 m", f"{-ARM} m"],
                    "inertia": ["2 g m^2", "2 g m^2", "0.1 g m^2"],
                },
            },
            "joints": {"hinge": {**hinge, "initial_angle": f"{START_DEGREES} deg", "damping": damping}},
        },
        "solver": {"step": f"{step} ms", "body_step": f"{step} ms", "coupling": coupling},
        "protocol": {"duration": f"{duration} s"},
        "record": {"all": {"signals": ["hinge.*", "spring.*"], "every": f"{step} ms"}},
    }
