"""Lever arms of muscles over the angles of their joints, as in Dzeladini 2013 Fig. 2.2."""

import tempfile
from math import degrees, radians
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from ruamel.yaml import YAML

from neuromech.compiler.paths import CONSTANT, COSINE, GEOMETRIC, lever
from neuromech.components.base import Muscle
from neuromech.components.catalogue import BUILT_IN, Catalogue
from neuromech.components.paths import ConstantArm, LeverArm, LeverArms
from neuromech.errors import DocumentError
from neuromech.graph.build import build
from neuromech.graph.model import ModelGraph
from neuromech.report.layout import NotDrawableError, panels
from neuromech.simulate.recording import Recording
from neuromech.spec.load import load

_FORMS = {"constant": CONSTANT, "cosine": COSINE, "geometric": GEOMETRIC}
_BESIDE = {"cosine": "geometric", "geometric": "cosine"}
_ELSE = (-45.0, 45.0)
"""Angles (deg) that are shown of a joint that has no limits."""

# Recorded documents hold numbers where they had parameters, which nothing follows any more.
_NO_MATTER = ("parameters", "record", "claims", "study", "sweeps")


def lever_arm_figure(recording: Recording) -> Figure:
    """Return the lever arms of the muscles of one leg over the range of each joint.

    Dashed beside a cosine (equation 2.19) is the exact lever arm of a straight line (2.20), and the other way round.

    Raises:
        NotDrawableError: no muscle has lever arms, or the document needs components that are not at hand.
    """
    if LeverArms.kind_name() not in recording.provenance.specification:
        raise NotDrawableError("no muscle has lever arms")
    graph = _graph(recording)
    arms = _arms(graph)
    if not arms:
        raise NotDrawableError("no muscle has lever arms")
    figure, axes = panels(list(arms), 3.4, 2.5, columns=3)
    for one, (joint, muscles) in zip(axes, arms.items(), strict=True):
        for number, (muscle, arm) in enumerate(muscles.items()):
            _draw(one, muscle, arm, _range(graph, joint), f"C{number}")
        one.axhline(0.0, color="0.8", linewidth=0.5, zorder=0)
        one.set_xlabel("joint angle (deg)")
        one.set_ylabel("lever arm (mm)")
        one.legend(loc="lower left", bbox_to_anchor=(0.0, 1.1), ncols=3)
    return figure


def lever_arm(form: str, arm: LeverArm, angle: float) -> float:
    """Return a lever arm (m) at an angle of the body's joint (rad), in another form than its own if you like."""
    peak = 0.0 if isinstance(arm, ConstantArm) else float(arm.angle_of_maximum)
    turned = angle + float(arm.zero_angle)
    found: tuple[float, float] = lever.py_func(
        _FORMS[form], float(arm.radius), turned, float(arm.reference_angle), peak
    )
    return found[0]


def _graph(recording: Recording) -> ModelGraph:
    document = YAML(typ="safe").load(recording.provenance.specification) or {}
    document = {key: value for key, value in document.items() if key not in _NO_MATTER}
    with tempfile.TemporaryDirectory(prefix="neuromech-") as folder:
        file = Path(folder, "document.yaml")
        YAML(typ="safe").dump(document | {"protocol": {"duration": "1 s"}}, file)
        try:
            return build(load(file, catalogue=Catalogue(BUILT_IN)))
        except DocumentError as error:
            first = error.problems[0]
            reason = f"the document in the recording cannot be used: {first.path} {first.message}"
            raise NotDrawableError(reason) from error


def _arms(graph: ModelGraph) -> dict[str, dict[str, LeverArm]]:
    """Return {joint: {muscle: lever arm}} of the first leg."""
    found: dict[str, dict[str, LeverArm]] = {}
    scope = None
    for element in graph.elements("muscle"):
        own = element.name.rpartition(".")[0]
        path = getattr(element.spec, "path", None)
        if isinstance(element.spec, Muscle) and isinstance(path, LeverArms) and scope in (None, own):
            scope = own
            for joint, arm in path.arms.items():
                found.setdefault(joint, {})[element.name.rpartition(".")[2]] = arm
    return found


def _range(graph: ModelGraph, joint: str) -> tuple[float, float]:
    limits = graph.body.joints[joint].soft_limit if graph.body else None
    return _ELSE if limits is None else (degrees(limits.range[0]), degrees(limits.range[1]))


def _draw(axes: Axes, muscle: str, arm: LeverArm, ends: tuple[float, float], color: str) -> None:
    angles = np.linspace(*ends, 200)
    for form, style in ((arm.kind, "-"), (_BESIDE.get(arm.kind), "--")):
        if form is not None:
            arms = [1e3 * lever_arm(form, arm, radians(angle)) for angle in angles]
            axes.plot(angles, arms, style, color=color, linewidth=1.2, label=muscle if style == "-" else None)
