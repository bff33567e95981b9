"""Time: the loop that steps network and body, records, and ends with an outcome."""

import itertools
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from neuromech.bodies.base import Body
from neuromech.bodies.factory import open_body
from neuromech.compiler.ground import Surface
from neuromech.compiler.numerics import Floats
from neuromech.compiler.pendulums import NO_PENDULUMS, PLACE, Pendulums, lead
from neuromech.compiler.program import Memory, Program
from neuromech.compiler.pushes import ACTING, NO_PUSHES, Pushes, acting, share_of_step, show_pushes
from neuromech.errors import RunError
from neuromech.graph.model import BodyModel
from neuromech.simulate.adaptive import breakpoints, integrate, is_adaptive, ticks_from
from neuromech.simulate.compiled_loop import BAD_STATE, BAD_TORQUE, FELL, compiled_loop
from neuromech.simulate.fall import FallRule
from neuromech.simulate.helpers import helpers
from neuromech.simulate.initial import initial_states, rest_muscles
from neuromech.simulate.pushes import drawn_pushes
from neuromech.simulate.recorder import Recorder
from neuromech.simulate.recording import Outcome, Recording
from neuromech.simulate.start import drawn_body

Progress = Callable[[float], None]

_SECONDS_BETWEEN_REPORTS = 0.05


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """A look at a run while it goes on.

    Args:
        at: simulated time (s).
        stop: gets the recording up to then, as if the run had finished; returns why the run is to end there, or an
            empty text where it is to go on.
    """

    at: float
    stop: Callable[[Recording], str]


@dataclass
class _Run:
    """What the loops share: `done` is the number of ticks that are complete."""

    program: Program
    memory: Memory
    recorder: Recorder
    ticks: int
    seed: int
    progress: Progress | None
    checkpoint: Checkpoint | None
    pushes: Pushes
    surface: Surface
    pendulums: Pendulums
    engine: str = "none"
    done: int = 0
    started: float = field(default_factory=time.perf_counter)

    @property
    def now(self) -> float:
        return self.done * self.program.tick

    @property
    def pause(self) -> int:
        """The tick of the checkpoint; the last one where there is none."""
        return self.ticks if self.checkpoint is None else min(round(self.checkpoint.at / self.program.tick), self.ticks)

    def recording(self, outcome: Outcome) -> Recording:
        wall = time.perf_counter() - self.started
        return self.recorder.recording(self.done, outcome, self.seed, self.engine, wall)

    def ended_at_checkpoint(self) -> Outcome | None:
        if self.checkpoint is None or self.done != self.pause or self.done == self.ticks:
            return None
        words = self.checkpoint.stop(self.recording(Outcome("finished", self.now)))
        return Outcome("stopped", self.now, words) if words else None

    def report(self) -> None:
        if self.progress is not None:
            self.progress(self.now)

    def bad_torque(self, joint: str) -> Outcome:
        return Outcome("diverged", self.now, f"the torque at joint {joint} is not a finite number any more")

    def bad_state(self, position: int) -> Outcome:
        name = self.program.layout.state_name(position)
        return Outcome("diverged", self.now, f"state {name} is not a finite number any more")


def simulate(
    program: Program,
    *,
    seed: int | None = None,
    progress: Progress | None = None,
    duration: float | None = None,
    checkpoint: Checkpoint | None = None,
) -> Recording:
    """Run a program to the end of its protocol.

    Args:
        program: from `lower`.
        seed: of random initial states; that of the protocol where not given.
        progress: is told the simulated time (s), about twenty times a second.
        duration: simulated time (s); that of the protocol where not given.
        checkpoint: may end the run at one time before its end.

    Returns:
        The recording. Its outcome says whether the run finished, fell, diverged, or was stopped by the user or at the
        checkpoint.

    Raises:
        DocumentError: the engine cannot move this body.
    """
    protocol = program.graph.document.experiment.protocol
    used_seed = protocol.seed if seed is None else seed
    ticks = round((float(protocol.duration) if duration is None else duration) / program.tick)
    body = drawn_body(program.graph, used_seed)
    memory = program.memory()
    memory.x[:] = initial_states(program, used_seed)
    pushes = NO_PUSHES if body is None else drawn_pushes(program, body, used_seed, ticks * program.tick)
    pendulums = NO_PENDULUMS if body is None else Pendulums.of(body)
    surface = Surface.of(None if body is None else body.world.ground)
    recorder = Recorder(program, memory.I, ticks)
    run = _Run(program, memory, recorder, ticks, used_seed, progress, checkpoint, pushes, surface, pendulums)
    return run.recording(_with_body(run, body) if body is not None else _ended(run, _network))


def _ended(run: _Run, loop: Callable[[_Run], Outcome | None]) -> Outcome:
    """Return how a loop ended, whatever ended it."""
    try:
        return loop(run) or Outcome("finished", run.now)
    except KeyboardInterrupt:
        return Outcome("stopped", run.now, "stopped by the user")
    except RunError as error:
        return Outcome("diverged", run.now, str(error))


def _network(run: _Run) -> Outcome | None:
    run.program.module.begin(*run.memory.buffers)
    return _network_adaptive(run) if is_adaptive(run.program) else _network_fixed(run)


def _network_fixed(run: _Run) -> Outcome | None:
    advance = run.program.module.run

    def chunk(last: int) -> Outcome | None:
        run.done, bad = advance(run.done, last, run.program.tick, *run.memory.buffers, run.recorder.samples)
        return run.bad_state(bad) if bad >= 0 else None

    return _in_chunks(run, chunk)


def _in_chunks(run: _Run, chunk: Callable[[int], Outcome | None]) -> Outcome | None:
    """Call `chunk` with the tick to reach, again and again, in pieces short enough to report and to be interrupted."""
    length = 1
    with helpers(run.program, run.memory):
        # Compiles what is not in the cache yet, so that the clock shows what the run itself takes.
        chunk(run.done)
        run.started = time.perf_counter()
        while run.done < run.ticks:
            started = time.perf_counter()
            ended = chunk(min(run.done + length, run.pause if run.done < run.pause else run.ticks))
            spent = max(time.perf_counter() - started, 1e-6)
            ended = ended or run.ended_at_checkpoint()
            if ended is not None:
                return ended
            run.report()
            length = max(1, min(int(length * _SECONDS_BETWEEN_REPORTS / spent), length * 10))
    return None


def _network_adaptive(run: _Run) -> Outcome | None:
    tick, memory = run.program.tick, run.memory
    marks = sorted({*breakpoints(run.program, run.ticks * tick), run.pause * tick})
    for start, end in itertools.pairwise(marks):
        first, last = ticks_from(start, tick), ticks_from(end, tick)
        states = integrate(run.program, memory, start, end, np.arange(first, last, dtype=np.float64) * tick)
        for row in range(last - first):
            memory.x[:] = states[row]
            run.program.module.sample(first + row, tick, *memory.buffers, run.recorder.samples)
        memory.x[:] = states[-1]
        run.done = last
        ended = run.ended_at_checkpoint()
        if ended is not None:
            return ended
        run.report()
    return None


def _with_body(run: _Run, model: BodyModel) -> Outcome:
    with open_body(model, run.program.tick) as body:
        run.engine = str(body.engine)
        return _ended(run, lambda same: _body_loop(same, body))


def _body_loop(run: _Run, body: Body) -> Outcome | None:
    """Step a body with the compiled functions of its engine where there are any, else through its methods."""
    body.read(_body_state(run, body))
    rest_muscles(run.program, run.memory)
    run.program.module.begin(*run.memory.buffers)
    native = None if is_adaptive(run.program) else body.native()
    if native is None or body.native_module is None:
        return _method_loop(run, body)
    return _native_loop(run, body, body.native_module, native)


def _fall_rule(run: _Run, body: Body) -> FallRule:
    return FallRule.of(run.program.graph.document.experiment.protocol.fall, body.layout, run.surface)


def _body_state(run: _Run, body: Body) -> Floats:
    return run.memory.s[run.program.header["body"] :][: body.layout.size]


def _native_loop(run: _Run, body: Body, native_module: str, native: tuple[Any, ...]) -> Outcome | None:
    memory, dt = run.memory, run.program.tick
    fall = _fall_rule(run, body)
    pushes, pendulums = len(run.pushes.places) > 0, len(run.pendulums.segments) > 0
    advance = compiled_loop(run.program, native_module, pushes=pushes, pendulums=pendulums).run
    limits = (fall.height, fall.least_cosine, (fall.surface.corners, fall.surface.steps))
    hanging = (run.pendulums.numbers, run.pendulums.segments, run.pendulums.now, run.pendulums.gravity)
    outside = ((run.pushes.numbers, run.pushes.places), hanging, np.zeros(ACTING))
    rest = (*memory.buffers, run.recorder.samples, memory.T, memory.D, native, *limits, *outside)

    def chunk(last: int) -> Outcome | None:
        run.done, why, position = advance(run.done, last, dt, *rest)
        if why == BAD_TORQUE:
            return run.bad_torque(body.joints[position])
        if why == FELL:
            return Outcome("fell", run.now, fall.broken(_body_state(run, body)))
        if why == BAD_STATE:
            return run.bad_state(position)
        body.check()
        return None

    return _in_chunks(run, chunk)


def _method_loop(run: _Run, body: Body) -> Outcome | None:
    program, memory = run.program, run.memory
    state = _body_state(run, body)
    torque = memory.s[program.header["torque"] :][: body.layout.joints]
    fall = _fall_rule(run, body)
    rest = (*memory.buffers, run.recorder.samples, memory.T, memory.D)
    advance = _adaptive_advance(program, memory) if is_adaptive(program) else program.module.advance

    def chunk(last: int) -> Outcome | None:
        for number in range(run.done, last):
            body.read(state)
            show_pushes(number, program.tick, run.pushes.numbers, run.pushes.places, memory.s)
            bad = program.module.tick(number, program.tick, *rest)
            if bad >= 0:
                return run.bad_torque(body.joints[bad])
            fallen = fall.broken(state)
            if fallen:
                return Outcome("fell", run.now, fallen)
            bad = advance(number, program.tick, *memory.buffers)
            if bad >= 0:
                return run.bad_state(bad)
            _push(run, body, number)
            _lead_pendulums(run, body, number)
            body.step(torque)
            run.done = number + 1
        return None

    return _in_chunks(run, chunk)


def _push(run: _Run, body: Body, number: int) -> None:
    rotation, position, *_ = run.memory.D
    room = np.zeros(ACTING)
    for push, (segment, _) in zip(run.pushes.numbers, run.pushes.places, strict=True):
        share = share_of_step(number, run.program.tick, push)
        if share > 0.0:
            acting(share, push, segment, rotation, position, room)
            body.push(segment, room)


def _lead_pendulums(run: _Run, body: Body, number: int) -> None:
    rotation, position, *_ = run.memory.D
    state, hanging, room = _body_state(run, body), run.pendulums, np.zeros(ACTING)
    weights = state[body.layout.hanging].reshape(-1, 9)
    root = state[body.layout.root_velocity]
    for k, (pendulum, segment) in enumerate(zip(hanging.numbers, hanging.segments, strict=True)):
        now, weight, gravity, dt = hanging.now[k], weights[k], hanging.gravity, run.program.tick
        if lead(number, dt, gravity, pendulum, segment, now, weight, root, rotation, position, room):
            body.place(k, now[PLACE:])
        body.push(len(position) + k, room)


def _adaptive_advance(program: Program, memory: Memory) -> Callable[..., int]:
    def advance(number: int, dt: float, *_buffers: object) -> int:
        memory.x[:] = integrate(program, memory, number * dt, (number + 1) * dt)[-1]
        return int(program.module.first_bad(memory.x))

    return advance
