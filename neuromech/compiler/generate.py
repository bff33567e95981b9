"""Shape -> source of the module that steps it. The module is meant to be read: `neuromech compile SPEC`."""

from collections.abc import Callable, Iterator
from typing import Any

from neuromech.compiler.conditions import chosen
from neuromech.compiler.shape import (
    KindShape,
    Shape,
    argument_names,
    evaluated_with_body,
    has_feedthrough,
    is_commanded,
    is_divided,
    is_scheduled,
)
from neuromech.compiler.template_body import BODY
from neuromech.compiler.template_network import NETWORK, NO_BODY, STEPPERS
from neuromech.compiler.template_record import RECORD
from neuromech.compiler.template_sums import GATHER, GATHER_SLOTS, ROWS, TEAM_GATHER

# Arguments of `advance` that are no state, input or parameter.
_OF_STEP = ("duration", "elapsed")


def generate(shape: Shape) -> str:
    """Return the source of the step module for a shape.

    Raises:
        TypeError: an equation has an argument that is no state, input or parameter of its class.
    """
    parts = [
        _imports(shape),
        _positions(shape),
        *(_equations(kind) for kind in shape.kinds),
        ROWS,
        TEAM_GATHER if shape.has_threads else GATHER,
        GATHER_SLOTS if shape.has_short_rows else "",
        _outputs(shape),
        _dispatch("evaluate_network", shape, with_body=False),
        _dispatch("evaluate_mechanics", shape, with_body=True),
        _inputs(shape),
        _flows(shape),
        _advances(shape),
        _arrivals(shape),
        NETWORK,
        RECORD,
        STEPPERS[shape.method],
        BODY if shape.has_body else NO_BODY,
    ]
    return _fill("\n\n".join(part.strip("\n") for part in parts if part) + "\n", shape)


def _fill(text: str, shape: Shape) -> str:
    relays = any(is_scheduled(kind) and not evaluated_with_body(kind.cls) for kind in shape.kinds)
    flags = {
        "delays": shape.has_delays,
        "shared weights": shape.has_shared_weights,
        "relays": relays,
        "commanded": any(is_commanded(kind.cls) for kind in shape.kinds),
        "memory": any(kind.cls.advance for kind in shape.kinds if not evaluated_with_body(kind.cls)),
    }
    text = chosen(text, flags)
    for name in shape.header():
        text = text.replace(f"<{name}>", f"I[{_constant(name)}]")
    return text


def _constant(name: str) -> str:
    return name.replace(".", "_").upper()


def _positions(shape: Shape) -> str:
    lines = ["# Where the integer buffer holds each offset into the buffers, and each count."]
    return "\n".join([*lines, *(f"{_constant(name)} = {position}" for name, position in shape.header().items())])


def _imports(shape: Shape) -> str:
    kinds = ", ".join(kind.name for kind in shape.kinds)
    lines = [
        f'"""Generated step for {kinds}; {shape.method}."""',
        "",
        "import numpy as np",
        "",
        "from neuromech.compiler.coupling import muscle_damping, muscle_torque, observer_implicit, soft_limit",
        "from neuromech.compiler.dynamics import inertia_of_all",
        "from neuromech.compiler.kinematics import contact_positions, forward_kinematics, roll_pitch_yaw",
        "from neuromech.compiler.kinematics import segment_velocities, world_axis",
        "from neuromech.compiler.numerics import compiled, copy_from, elementwise, interpolate",
        "from neuromech.compiler.numerics import part, relaxed, sum_at, weighted_sum_at",
        "from neuromech.compiler.paths import LEVER_ARMS, STRAIGHT_LINES, lever, straight_path",
        "from neuromech.compiler.span import places_of, span_of",
        "from neuromech.compiler.team import DONE, FIRST, HELPERS, LAST, NEXT, ORDER, PART, STOP",
        "from neuromech.compiler.team import add, load, rest_now_and_then, store",
        *sorted({f"from {kind.cls.__module__} import {kind.cls.__qualname__}" for kind in shape.kinds}),
    ]
    return "\n".join(lines)


def _equations(kind: KindShape) -> str:
    cls = kind.cls
    lines = [f"# {kind.name}: {cls.source}"]
    lines += [
        f"{kind.name}_{part} = elementwise({cls.__qualname__}.{part})"
        for part in ("output", "flow", "advance")
        if getattr(cls, part)
    ]
    return "\n".join(lines)


def _outputs(shape: Shape) -> str:
    lines = [
        "@part",
        "def network_outputs(x, s, u, p, F, I):",
        '    """Outputs of neurons and drives: first those that depend on states alone, then the others in order."""',
    ]
    for kind in shape.kinds:
        if kind.cls.output and not evaluated_with_body(kind.cls) and not has_feedthrough(kind.cls):
            lines += _loop(kind, kind.cls.output, "output")
    lines += ["    evaluate_network(x, s, u, p, F, I)"]
    return "\n".join(lines)


def _loop(kind: KindShape, function: Callable[..., Any], part: str) -> Iterator[str]:
    yield from (f"    {line}" for line in _locals(kind, function, part))
    yield "    for i in range(count):"
    yield from (f"        {line}" for line in _call(kind, function, part))


def _locals(kind: KindShape, function: Callable[..., Any], part: str) -> Iterator[str]:
    """Yield views of what an equation reads and writes: a loop over `view[i]` with i ≥ 0 vectorises."""
    yield f"count = <{kind.name}.count>  # {kind.name}"
    arguments = argument_names(function)
    states = [(state.name, k) for k, state in enumerate(kind.cls.states)]
    yield from (f"{name} = {_block('x', kind, 'states', k)}" for name, k in states if name in arguments)
    ports = [(port.name, k) for k, port in enumerate(kind.cls.inputs)]
    yield from (f"{name} = {_block('u', kind, 'inputs', k)}" for name, k in ports if name in arguments)
    for name in arguments:
        if name in kind.cls.model_fields:
            one = f"p[<{kind.name}.{name}>]"
            yield f"{name} = {one if name in kind.uniform else _block('p', kind, name, 0)}"
    if part == "output":
        yield from (f"{name}_out = {_block('s', kind, 'outputs', k)}" for name, k in _outputs_of(kind, part))
    elif part == "advance":
        yield from (f"next_{name} = {_block('F', kind, 'states', k, '<advanced> + ')}" for name, k in states)
        yield from (f"{name}_out = {_block('s', kind, 'outputs', k)}" for name, k in _outputs_of(kind, part))
    else:
        for name, k in states:
            yield from (f"{target}_of_{name} = {_block(target, kind, 'states', k)}" for target in ("drive", "rate"))


def _outputs_of(kind: KindShape, part: str) -> list[tuple[str, int]]:
    """Return (name, position) of the outputs that `output` gives, or of those that `advance` does."""
    named = [(port.name, k) for k, port in enumerate(kind.cls.outputs)]
    own = len(named) - kind.cls.advanced_outputs
    return named[own:] if part == "advance" else named[:own]


def _block(array: str, kind: KindShape, section: str, k: int, base: str = "") -> str:
    """Return the k-th block of `count` numbers of a section of an array, counted from the offset `base`."""
    further = "" if k == 0 else " + count" if k == 1 else f" + {k} * count"
    return f"span_of({array}, {base}<{kind.name}.{section}>{further}, count)"


def _call(kind: KindShape, function: Callable[..., Any], part: str) -> Iterator[str]:
    arguments = ", ".join(_argument(kind, name) for name in argument_names(function))
    if part == "flow":
        names = [f"{target}_of_{state.name}[i]" for state in kind.cls.states for target in ("drive", "rate")]
    else:
        names = [f"next_{state.name}[i]" for state in kind.cls.states] if part == "advance" else []
        names += [f"{name}_out[i]" for name, _ in _outputs_of(kind, part)]
    yield f"{', '.join(names)} = {kind.name}_{part}({arguments})"


def _argument(kind: KindShape, name: str) -> str:
    if name in _OF_STEP:
        return name
    own = {*(state.name for state in kind.cls.states), *(port.name for port in kind.cls.inputs)}
    if name not in own and name not in kind.cls.model_fields:
        raise TypeError(f"{kind.cls.__qualname__}: '{name}' is no state, input port or parameter")
    return name if name in kind.uniform else f"{name}[i]"


def _dispatch(function: str, shape: Shape, *, with_body: bool) -> str:
    name = function.removeprefix("evaluate_")
    phase = [kind for kind in shape.kinds if evaluated_with_body(kind.cls) == with_body]
    kinds = [kind for kind in phase if is_scheduled(kind)]
    lines = [
        "@part",
        f"def {function}(x, s, u, p, F, I):",
        '    """Inputs and outputs of what passes inputs straight on, in an order in which each input is ready."""',
    ]
    in_turn = [(kind.turn, kind) for kind in phase if kind.turn is not None]
    for _, kind in sorted(in_turn, key=lambda pair: pair[0]):
        if kind.cls.output:
            lines.append(f"    {_gather_all(kind, shape)}")
            lines += _loop(kind, kind.cls.output, "output")
    if not kinds:
        return "\n".join([*lines, "    return"])
    lines += [
        "    source = I[<row_source> :].view(np.uint32)",
        "    row_start, weights, base = <row_start>, <weights>, <base>",
        f"    for k in range(<{name}_ordered>):",
        f"        at = <{name}_order> + 3 * k",
        "        kind, first, last = I[at], I[at + 1], I[at + 2]",
        f"        members = span_of(I, <{name}_members> + first, last - first)",
    ]
    for branch, kind in enumerate(kinds):
        if kind.cls.output:
            lines.append(f"        {'el' if branch else ''}if kind == {shape.kinds.index(kind)}:")
            lines += [f"            {line}" for line in _one_by_one(kind, kind.cls.output)]
    return "\n".join(lines)


def _one_by_one(kind: KindShape, output: Callable[..., Any]) -> Iterator[str]:
    """Yield a loop over `members` that sums the inputs of each before it evaluates it."""
    yield from _locals(kind, output, "output")
    yield f"inputs = <{kind.name}.inputs>"
    yield "for i in members:"
    for port in range(len(kind.cls.inputs)):
        row = f"inputs + {port} * count + i"
        yield f"    u[{row}] = arriving({row}, s, p, F, I, source, row_start, weights, base)"
    yield from (f"    {line}" for line in _call(kind, output, "output"))


def _inputs(shape: Shape) -> str:
    lines = [
        "@part",
        "def network_inputs(s, u, p, F, I):",
        '    """Inputs of everything that has states."""',
    ]
    for kind in shape.kinds:
        if kind.cls.flow and kind.cls.inputs:
            lines.append(f"    {_gather_all(kind, shape)}")
    return "\n".join([*lines, "    return"] if len(lines) == 3 else lines)


def _gather_all(kind: KindShape, shape: Shape) -> str:
    rows = f"{len(kind.cls.inputs)} * <{kind.name}.count>"
    if shape.has_short_rows:
        return f"gather_slots(s, u, p, F, I, <{kind.name}.inputs>, {rows}, <{kind.name}.table>)"
    return f"gather(s, u, p, F, I, <{kind.name}.inputs>, {rows}, 0, 1)"


def _flows(shape: Shape) -> str:
    lines = [
        "@part",
        "def flows(x, u, p, I, drive, rate):",
        '    """Drive and rate of every state: dx/dt = drive − rate x."""',
    ]
    for kind in shape.kinds:
        if kind.cls.flow:
            lines += _loop(kind, kind.cls.flow, "flow")
    return "\n".join([*lines, "    return"] if len(lines) == 3 else lines)


def _advances(shape: Shape) -> str:
    lines = [
        "@part",
        "def advance_states(dt, x, s, u, p, F, I):",
        '    """States that components advance themselves: what they are after the step waits in F."""',
    ]
    for kind in shape.kinds:
        if kind.cls.advance:
            lines.append(f"    {_gather_all(kind, shape)}")
            in_parts = is_divided(kind.cls)
            lines += _divided_loop(kind, kind.cls.advance) if in_parts else _loop(kind, kind.cls.advance, "advance")
    return "\n".join([*lines, "    return"] if len(lines) == 3 else lines)


def _divided_loop(kind: KindShape, function: Callable[..., Any]) -> Iterator[str]:
    """Yield the loops of what advances by parts of the step: all instances by one part, then all by the next."""
    states = [state.name for state in kind.cls.states]
    means = [name for name, _ in _outputs_of(kind, "advance")]
    yield from (f"    {line}" for line in _locals(kind, function, "advance"))
    yield "    parts = max(1, int(np.ceil(dt / p[<muscle_step>] - 1e-9)))"
    yield "    duration = dt / parts"
    yield "    for i in range(count):"
    yield from (f"        next_{name}[i] = {name}[i]" for name in states)
    yield from (f"        {name}_out[i] = 0.0" for name in means)
    yield "    for number in range(parts):"
    yield "        elapsed = number * duration"
    yield "        for i in range(count):"
    arguments = [_argument(kind, name) for name in argument_names(function)]
    now = ", ".join(f"next_{name}" if name.removesuffix("[i]") in states else name for name in arguments)
    names = [*(f"next_{name}[i]" for name in states), *(f"part_of_{name}" for name in means)]
    yield f"            {', '.join(names)} = {kind.name}_advance({now})"
    yield from (f"            {name}_out[i] += part_of_{name} / parts" for name in means)


def _arrivals(shape: Shape) -> str:
    lines = ["@part", "def take_advanced(x, F, I):", '    """Give these states their new values."""']
    for kind in shape.kinds:
        if kind.cls.advance:
            first, count = f"<{kind.name}.states>", f"{len(kind.cls.states)} * <{kind.name}.count>"
            lines += [f"    for k in range({first}, {first} + {count}):", "        x[k] = F[<advanced> + k]"]
    return "\n".join([*lines, "    return"] if len(lines) == 3 else lines)
