"""The loop over body steps for engines with compiled functions: reading, stepping and recording without Python."""

import importlib
import inspect
from functools import cache
from pathlib import Path
from types import ModuleType

from neuromech.compiler.cache import import_file, module_file
from neuromech.compiler.conditions import chosen
from neuromech.compiler.program import Program
from neuromech.components.base import Component
from neuromech.graph.swing import aimed
from neuromech.graph.terrain import ground_height

FINISHED, BAD_TORQUE, FELL, BAD_STATE, ENGINE_FAILED = range(5)

_SOURCE = '''"""Generated loop for {native} around {step}."""

from {native} import place, push, read, step
import {step} as step_module
from {step} import BODY, CONTACTS, JOINTS, TORQUE

from neuromech.compiler import ground
from neuromech.compiler.numerics import compiled, within
from neuromech.compiler.pendulums import PLACE, lead
from neuromech.compiler.pushes import acting, share_of_step, show_pushes

advance, tick, height_below = within(step_module.advance), within(step_module.tick), within(ground.height_below)


@compiled
def run(first, last, dt, x, s, u, p, F, I, R, T, D, engine, lowest, least_cosine, surface, pushed, hanging, room):
    """Advance from body step `first` to `last`; return the step reached, why it ended, and which number is bad."""
    n, body = I[JOINTS], I[BODY]
    state = s[body : I[TORQUE]]
    weights = state[2 * n + 13 + 3 * I[CONTACTS] :]
    corners, steps = surface
    pushes, places = pushed
    pendulums, hit, now, gravity = hanging
    torque = s[I[TORQUE] : I[TORQUE] + n]
    for number in range(first, last):
        if read(engine, state) != 0:
            return number, {failed}, 0
        if <pushes>:
            show_pushes(number, dt, pushes, places, s)
        bad = tick(number, dt, x, s, u, p, F, I, R, T, D)
        if bad >= 0:
            return number, {torque}, bad
        tilt = 1.0 - 2.0 * (state[2 * n + 3] ** 2 + state[2 * n + 4] ** 2)
        height = state[2 * n + 2] - height_below(state[2 * n], state[2 * n + 1], corners, steps)
        if height < lowest or tilt < least_cosine:
            return number, {fell}, 0
        bad = advance(number, dt, x, s, u, p, F, I)
        if bad >= 0:
            return number, {state}, bad
        if <pushes>:
            for k in range(places.shape[0]):
                share = share_of_step(number, dt, pushes[k])
                if share > 0.0:
                    acting(share, pushes[k], places[k, 0], D[0], D[1], room)
                    push(engine, places[k, 0], room)
        if <pendulums>:
            for k in range(hit.shape[0]):
                weight, root = weights[9 * k : 9 * k + 9], state[2 * n + 7 : 2 * n + 13]
                if lead(number, dt, gravity, pendulums[k], hit[k], now[k], weight, root, D[0], D[1], room):
                    place(engine, k, now[k, PLACE:])
                push(engine, D[1].shape[0] + k, room)
        if step(engine, torque) != 0:
            return number, {failed}, 0
    return last, {finished}, 0
'''


def compiled_loop(program: Program, native_module: str, *, pushes: bool, pendulums: bool) -> ModuleType:
    """Return the module whose `run` steps a program with the compiled functions of an engine.

    Args:
        program: from `lower`.
        native_module: with the functions `place`, `push`, `read` and `step` of the engine.
        pushes: whether there are any, else the loop is compiled without them.
        pendulums: the same.
    """
    kinds = tuple(kind.cls for kind in program.shape.kinds)
    flags = (("pushes", pushes), ("pendulums", pendulums))
    return import_file(_loop_file(program.module.__name__, program.module_file.parent, native_module, kinds, flags))


@cache
def _loop_file(
    step: str,
    _folder: Path,
    native_module: str,
    kinds: tuple[type[Component], ...],
    flags: tuple[tuple[str, bool], ...],
) -> Path:
    """Return the file of a loop; what its name depends on is read once for each folder of generated modules."""
    source = chosen(_SOURCE, dict(flags)).format(
        native=native_module,
        step=step,
        finished=FINISHED,
        torque=BAD_TORQUE,
        fell=FELL,
        state=BAD_STATE,
        failed=ENGINE_FAILED,
    )
    engine = importlib.import_module(native_module)
    files = (str(engine.__file__), inspect.getfile(ground_height), inspect.getfile(aimed))
    return module_file(source, kinds, map(Path, files))
