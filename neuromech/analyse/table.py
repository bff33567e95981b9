"""The measures that a claim or a study may name."""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import get_args

from neuromech.analyse.curves import curve_correlation
from neuromech.analyse.cycles import NO_RHYTHM
from neuromech.analyse.energy import cost_of_transport, energy_per_distance, metabolic_energy, metabolic_power
from neuromech.analyse.forces import force_humps, ground_reaction_peak, loading_peak, push_off_peak
from neuromech.analyse.kinds import MeasureKind
from neuromech.analyse.levels import (
    correlation,
    final,
    fraction_active,
    held,
    maximum,
    mean,
    minimum,
    outcome,
    rms,
    rms_difference,
    silence,
    span,
    standard_deviation,
)
from neuromech.analyse.locomotion import (
    distance,
    froude_number,
    heading_drift,
    moving_time,
    speed,
    speed_range,
    time_alive,
    travel_direction,
)
from neuromech.analyse.oscillation import (
    amplitude,
    burst_duration,
    center,
    cycle_range,
    period,
    rhythm,
    settling_time,
)
from neuromech.analyse.phases import GAITS, gait, interlimb_phase, interlimb_phases, phase, phase_order
from neuromech.analyse.stability import floquet_multiplier, recovery_steps
from neuromech.analyse.steps import step_length, step_length_similarity, step_length_snr, stride_length
from neuromech.analyse.strides import (
    cycle_duration,
    double_support_duration,
    duty_factor,
    flight_duration,
    fraction_in_stance,
    period_ratio,
    running_time,
    stance_asymmetry,
    stance_duration,
    swing_duration,
    touchdowns,
    touchdowns_per_cycle,
)
from neuromech.errors import MeasureError, did_you_mean
from neuromech.simulate.recording import OutcomeKind
from neuromech.spec.measure import Measure

_CYCLE = ("reference or feet", "least_amplitude")

_VALUES = {
    "mean": MeasureKind(mean, "signal", ("signal",)),
    "minimum": MeasureKind(minimum, "signal", ("signal",)),
    "maximum": MeasureKind(maximum, "signal", ("signal",)),
    "range": MeasureKind(span, "signal", ("signal",), least=0.0),
    "rms": MeasureKind(rms, "signal", ("signal",), least=0.0),
    "standard_deviation": MeasureKind(standard_deviation, "signal", ("signal",), least=0.0),
    "final": MeasureKind(final, "signal", ("signal",)),
    "silence": MeasureKind(silence, "signal", ("signals",)),
    "held": MeasureKind(held, "text", ("signal", "level"), words=("held", "released")),
    "rms_difference": MeasureKind(rms_difference, "signal", ("signal", "reference"), least=0.0),
    "correlation": MeasureKind(correlation, "number", ("signal", "reference"), least=-1.0, most=1.0),
}

_RHYTHM = {
    "period": MeasureKind(period, "time", ("signal",), ("least_amplitude",), least=0.0),
    "rhythm": MeasureKind(rhythm, "text", ("signal",), ("least_amplitude",), words=("rhythm", NO_RHYTHM)),
    "center": MeasureKind(center, "signal", ("signal",), _CYCLE, feet=1),
    "amplitude": MeasureKind(amplitude, "signal", ("signal",), _CYCLE, feet=1, least=0.0),
    "cycle_range": MeasureKind(cycle_range, "signal", ("signal",), _CYCLE, feet=1, least=0.0),
    "settling_time": MeasureKind(settling_time, "time", ("signal", "tolerance"), _CYCLE, feet=1, least=0.0),
    "burst_duration": MeasureKind(burst_duration, "time", ("signal", "level"), least=0.0),
    "fraction_active": MeasureKind(
        fraction_active, "number", ("signal", "level or reference"), ("least_amplitude",), least=0.0, most=1.0
    ),
    "phase": MeasureKind(
        phase, "number", ("signal", "reference or feet"), ("event", "least_amplitude"), feet=1, least=0.0, most=1.0
    ),
    "phase_order": MeasureKind(phase_order, "text", ("signals", "reference or feet"), ("least_amplitude",), feet=1),
}

_WAY = {
    "outcome": MeasureKind(outcome, "text", of_early_end=True, words=get_args(OutcomeKind)),
    "time_alive": MeasureKind(time_alive, "time", of_early_end=True, least=0.0),
    "distance": MeasureKind(distance, "length", ("segment",), ("axis",), of_early_end=True),
    "speed": MeasureKind(speed, "speed", ("segment",), ("axis",), of_early_end=True),
    "speed_range": MeasureKind(speed_range, "speed", ("segment", "average_over"), ("axis",), least=0.0),
    "moving_time": MeasureKind(
        moving_time, "time", ("segment", "least_speed", "average_over"), ("axis",), of_early_end=True, least=0.0
    ),
    "froude_number": MeasureKind(
        froude_number, "number", ("segment", "leg_length"), ("axis",), of_early_end=True, least=0.0
    ),
    "travel_direction": MeasureKind(travel_direction, "angle", ("segment",), least=-math.pi, most=math.pi),
    "heading_drift": MeasureKind(heading_drift, "angle", ("segment",)),
}

_STRIDES = {
    "touchdowns": MeasureKind(touchdowns, "number", ("feet",), of_early_end=True, least=0.0),
    "cycle_duration": MeasureKind(cycle_duration, "time", ("feet",), least=0.0),
    "stance_duration": MeasureKind(stance_duration, "time", ("feet",), least=0.0),
    "swing_duration": MeasureKind(swing_duration, "time", ("feet",), least=0.0),
    "duty_factor": MeasureKind(duty_factor, "number", ("feet",), least=0.0, most=1.0),
    "double_support_duration": MeasureKind(double_support_duration, "time", ("feet",), feet=2, least=0.0),
    "flight_duration": MeasureKind(flight_duration, "time", ("feet",), feet=2),
    "running_time": MeasureKind(running_time, "time", ("feet",), feet=2, of_early_end=True, least=0.0),
    "stance_asymmetry": MeasureKind(stance_asymmetry, "number", ("feet",), feet=2, least=0.0, most=2.0),
    "period_ratio": MeasureKind(
        period_ratio, "number", ("signals or feet",), ("least_amplitude",), feet=2, signals=2, least=0.0
    ),
    "touchdowns_per_cycle": MeasureKind(
        touchdowns_per_cycle, "number", ("feet", "reference"), ("least_amplitude",), least=0.0
    ),
    "fraction_in_stance": MeasureKind(fraction_in_stance, "number", ("signal", "feet"), feet=1, least=0.0, most=1.0),
    "step_length": MeasureKind(step_length, "length", ("feet",), ("axis",), feet=2),
    "stride_length": MeasureKind(stride_length, "length", ("feet",), ("axis",)),
    "step_length_snr": MeasureKind(step_length_snr, "number", ("feet",), ("axis",), feet=2),
    "step_length_similarity": MeasureKind(step_length_similarity, "number", ("feet",), ("axis",), feet=2),
    "ground_reaction_peak": MeasureKind(ground_reaction_peak, "number", ("feet",), ("average_over",), least=0.0),
    "loading_peak": MeasureKind(loading_peak, "number", ("feet",), ("average_over",), least=0.0),
    "push_off_peak": MeasureKind(push_off_peak, "number", ("feet",), ("average_over",), least=0.0),
    "force_humps": MeasureKind(force_humps, "number", ("feet",), ("average_over",), least=0.0),
    "interlimb_phase": MeasureKind(interlimb_phase, "number", ("feet",), feet=2, least=0.0, most=1.0),
    "interlimb_phases": MeasureKind(interlimb_phases, "text", ("signals or feet",), ("least_amplitude",)),
    "gait": MeasureKind(gait, "text", ("signals or feet",), ("tolerance", "least_amplitude"), feet=4, words=GAITS),
}

_FORM = {
    "curve_correlation": MeasureKind(
        curve_correlation, "number", ("signals", "curve", "feet"), feet=1, least=-1.0, most=1.0
    ),
    "floquet_multiplier": MeasureKind(
        floquet_multiplier, "number", ("signals", "reference or feet"), ("least_amplitude",), feet=1, least=0.0
    ),
    "recovery_steps": MeasureKind(recovery_steps, "number", ("signal", "feet", "tolerance", "perturbed_at"), least=0.0),
}

_ENERGY = {
    "metabolic_energy": MeasureKind(
        metabolic_energy, "energy", ("muscles",), ("maintenance",), of_early_end=True, least=0.0
    ),
    "metabolic_power": MeasureKind(metabolic_power, "power", ("muscles",), ("maintenance",), least=0.0),
    "energy_per_distance": MeasureKind(
        energy_per_distance, "energy per distance", ("muscles", "segment"), ("axis", "maintenance"), least=0.0
    ),
    "cost_of_transport": MeasureKind(
        cost_of_transport, "number", ("muscles", "segment"), ("axis", "maintenance"), least=0.0
    ),
}

MEASURES: Mapping[str, MeasureKind] = MappingProxyType(_WAY | _STRIDES | _RHYTHM | _FORM | _ENERGY | _VALUES)


def measure_kind(spec: Measure) -> MeasureKind:
    """Return the kind that a measure names.

    Raises:
        MeasureError: there is no such kind, an argument is missing, or one means nothing to the kind.
    """
    if spec.kind not in MEASURES:
        raise MeasureError(f"'{spec.kind}' is not a measure. Hint: {did_you_mean(spec.kind, MEASURES)}")
    kind = MEASURES[spec.kind]
    kind.check(spec)
    return kind
