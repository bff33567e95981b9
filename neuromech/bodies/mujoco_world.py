"""Building a MuJoCo model: the package, the compiled body, the laws of its contacts, checked after compiling."""

import ctypes
import importlib
import logging
from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from neuromech.bodies.base import body_problem
from neuromech.bodies.mjcf import CONTACT, SLIP_RATE, TIME_CONSTANT, ground_pieces, mjcf_text
from neuromech.errors import DocumentError, MissingExtraError, Problem
from neuromech.graph.engines import refusals
from neuromech.graph.model import BodyModel
from neuromech.graph.terrain import terrain
from neuromech.spec.model import Contact

_INERTIA_TOLERANCE: Final = 1e-9
# Impedances that MuJoCo works with; it cuts others off without a word.
_IMPEDANCE: Final = (1e-4, 0.9999)

_log = logging.getLogger(__name__)


def load_mujoco() -> Any:
    """Import the package `mujoco`, which is an extra.

    MuJoCo writes warnings to a file in the working directory where nobody takes them; they go to the log instead.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        mujoco = importlib.import_module("mujoco")
    except ModuleNotFoundError as error:
        raise MissingExtraError("mujoco", "mujoco") from error
    if mujoco.get_mju_user_warning() is None:
        mujoco.set_mju_user_warning(_log.info)
    return mujoco


def build_model(mujoco: Any, body: BodyModel, step: float) -> Any:
    """Return MuJoCo's model of a body.

    Args:
        mujoco: the package.
        body: the body.
        step: in seconds.

    Raises:
        DocumentError: MuJoCo cannot move this body.
    """
    problems = [
        *(body_problem(refusal.message, refusal.hint) for refusal in refusals(body, "mujoco")),
        *_long_step(body, step),
    ]
    if problems:
        raise DocumentError(problems)
    try:
        model = mujoco.MjModel.from_xml_string(mjcf_text(body, step))
    except ValueError as error:
        raise DocumentError([body_problem(f"MuJoCo cannot load the body: {error}")]) from error
    problems = [*_changed_inertias(model, body), *_set_contact_laws(model, body, step)]
    if problems:
        raise DocumentError(problems)
    return model


def step_address(mujoco: Any) -> int | None:
    """Return the address of MuJoCo's C function `mj_step`, None where the system does not tell."""
    try:
        # Symbols are looked up in the libraries that the binding was linked with, too.
        function = ctypes.CDLL(mujoco._functions.__file__).mj_step
    except (OSError, AttributeError):
        return None
    return ctypes.cast(function, ctypes.c_void_p).value


def _long_step(body: BodyModel, step: float) -> Iterator[Problem]:
    rigid = [name for name, contact in body.contacts.items() if contact.stiffness is None]
    if rigid and 2.0 * step > TIME_CONSTANT:
        message = (
            f"MuJoCo's contacts need a body_step of at most {500.0 * TIME_CONSTANT:g} ms, not {1000.0 * step:g} ms"
        )
        yield body_problem(message, f"shorten the step, or give '{rigid[0]}' a stiffness and a damping")


def _changed_inertias(model: Any, body: BodyModel) -> Iterator[Problem]:
    for name, segment in body.segments.items():
        compiled = model.body(name)
        wanted = (float(segment.mass), *map(float, segment.center_of_mass), *map(float, segment.inertia))
        found = (*compiled.mass, *compiled.ipos, *compiled.inertia)
        if not (np.allclose(found, wanted, rtol=_INERTIA_TOLERANCE, atol=0.0) and compiled.iquat[0] == 1.0):
            yield body_problem(f"MuJoCo changes mass or inertia of segment '{name}'")


def _set_contact_laws(model: Any, body: BodyModel, step: float) -> Iterator[Problem]:
    if body.world.ground is None:
        return
    pieces = len(ground_pieces(terrain(body.world.ground)))
    for number, (name, contact) in enumerate(body.contacts.items()):
        if contact.stiffness is None or contact.damping is None:
            continue
        mobility = float(model.body_invweight0[model.geom(CONTACT + name).bodyid[0], 0])
        impedance, reference = _spring_and_damper(contact, mobility, step)
        if not _IMPEDANCE[0] <= impedance <= _IMPEDANCE[1]:
            hint = "change its stiffness and damping, or leave both out"
            yield body_problem(f"contact '{name}' is too stiff or too soft for MuJoCo at this step", hint)
            continue
        rows = slice(number * pieces, (number + 1) * pieces)
        model.pair_solref[rows] = reference
        model.pair_solreffriction[rows, 1] = -SLIP_RATE * impedance
        model.pair_solimp[rows, :3] = (impedance, impedance, 1.0)


def _spring_and_damper(contact: Contact, mobility: float, step: float) -> tuple[float, tuple[float, float]]:
    """Return impedance d and reference (−stiffness, −damping) for which a contact force is f = K p − C v.

    p is the penetration and v the normal velocity at the end of the step, as in Bullet. MuJoCo solves
    (A + R) f = a_ref − a_0 with R = mobility (1 − d)/d and a_ref = −(damping/d) v + (stiffness/d) p for a constant d;
    f = K p − C v after a step dt of a = a_0 + A f is the same where R = 1/(dt (dt K + C)), damping/d = 1/dt and
    stiffness/d = K/(dt (dt K + C)). Source: MuJoCo, Computation, Parameters of constraints.
    """
    stiffness, damping = float(contact.stiffness or 0.0), float(contact.damping or 0.0)
    viscous = step * stiffness + damping
    impedance = mobility / (mobility + 1.0 / (step * viscous))
    return impedance, (-impedance * stiffness / (step * viscous), -impedance / step)
