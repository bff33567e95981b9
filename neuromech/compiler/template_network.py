"""The network and its steps, as text of a generated step module.

<name> is an offset or a count; `if <flag>:` keeps or drops the lines below it.
"""

NETWORK = '''
@part
def delayed_inputs(step, fraction, p, F, I):
    """Put into the base of each input what delayed synapses bring `fraction` steps after step `step`."""
    base, history, length, width = <base>, <history>, <history_length>, <history_width>
    row, source, weight = <delayed_row>, <delayed_source>, <delayed_weight>
    weights, delay, now = <weights>, <delay_steps>, step % length
    for k in range(<inputs>):
        F[base + k] = 0.0
    for k in range(<delayed>):
        ago = p[delay + k] - fraction
        whole = int(np.ceil(ago))
        earlier = now - whole if now >= whole else now - whole + length
        later = earlier + 1 if earlier + 1 < length else 0
        share = whole - ago
        column = history + I[source + k]
        signal = (1.0 - share) * F[column + earlier * width] + share * F[column + later * width]
        F[base + I[row + k]] += p[weights + I[weight + k]] * signal


@part
def remember(step, s, F, I):
    """Write the signals that delayed synapses will need into the ring of step `step`."""
    start = <history> + (step % <history_length>) * <history_width>
    for k in range(<history_width>):
        F[start + k] = s[I[<history_slot> + k]]


@part
def fill_history(s, F, I):
    """Write the signals of now into the whole ring."""
    for step in range(<history_length>):
        remember(step, s, F, I)


@part
def stage(x, s, u, p, F, I, drive, rate, step, fraction, known):
    """Evaluate the network at one state: signals unless they are known, inputs, drive and rate of every state."""
    if not known:
        if <delays>:
            delayed_inputs(step, fraction, p, F, I)
        network_outputs(x, s, u, p, F, I)
    network_inputs(s, u, p, F, I)
    flows(x, u, p, I, drive, rate)


@compiled
def derivative(t, x, dx, s, u, p, F, I):
    """Fill dx/dt at time t and state x."""
    apply_protocol(t, p, I)
    n = <states>
    rate = span_of(F, <stages>, n)
    stage(x, s, u, p, F, I, dx, rate, 0, 0.0, False)
    for k in range(n):
        dx[k] -= rate[k] * x[k]


@part
def apply_protocol(t, p, I):
    """Give every parameter that the protocol moves its value at time t, wherever it is used.

    Network steps hold the value in their middle, which follows a ramp to second order.
    """
    for k in range(<driven>):
        start = I[<driven_start> + k]
        count = I[<driven_start> + k + 1] - start
        value = interpolate(t, start, count, <breakpoint_time>, <breakpoint_value>, p)
        for b in range(I[<bound_start> + k], I[<bound_start> + k + 1]):
            p[I[<bound_slot> + b]] = value


@compiled
def first_bad(x):
    """Return the position of the first state that is not finite, or −1."""
    return bad_place(x)


@part
def bad_place(x):
    """Do the same for compiled functions."""
    total = 0.0
    for k in range(x.shape[0]):
        total += x[k] * 0.0
    if total == 0.0:
        return -1
    for k in range(x.shape[0]):
        if not np.isfinite(x[k]):
            return k
    return -1


@compiled
def sample(tick, dt, x, s, u, p, F, I, R):
    """Record the network at a state that was found elsewhere."""
    apply_protocol(tick * dt, p, I)
    network_outputs(x, s, u, p, F, I)
    network_inputs(s, u, p, F, I)
    record(tick, x, s, u, I, R)


@compiled
def begin(x, s, u, p, F, I):
    """Fill the delay lines as if the first state had always been; each pass reaches one delay further."""
    apply_protocol(0.0, p, I)
    for row in range(<inputs>):
        F[<base> + row] = 0.0
    if <delays>:
        for _ in range(1 + <history_width>):
            network_outputs(x, s, u, p, F, I)
            fill_history(s, F, I)
            delayed_inputs(0, 0.0, p, F, I)
'''

RK4 = '''
@part
def network_step(step, dt, x, s, u, p, F, I, known):
    """Advance the network by one step of the classical Runge–Kutta method."""
    n = <states>
    k0 = <stages>
    total = span_of(F, k0, n)
    now = span_of(F, k0 + n, n)
    drive = span_of(F, k0 + 2 * n, n)
    rate = span_of(F, k0 + 3 * n, n)
    stage(x, s, u, p, F, I, drive, rate, step, 0.0, known)
    if <delays>:
        remember(step, s, F, I)
    for k in range(n):
        slope = drive[k] - rate[k] * x[k]
        total[k] = slope
        now[k] = x[k] + 0.5 * dt * slope
    stage(now, s, u, p, F, I, drive, rate, step, 0.5, False)
    for k in range(n):
        slope = drive[k] - rate[k] * now[k]
        total[k] += 2.0 * slope
        now[k] = x[k] + 0.5 * dt * slope
    stage(now, s, u, p, F, I, drive, rate, step, 0.5, False)
    for k in range(n):
        slope = drive[k] - rate[k] * now[k]
        total[k] += 2.0 * slope
        now[k] = x[k] + dt * slope
    stage(now, s, u, p, F, I, drive, rate, step, 1.0, False)
    for k in range(n):
        x[k] += dt / 6.0 * (total[k] + drive[k] - rate[k] * now[k])
'''

EXPONENTIAL_EULER = '''
@part
def network_step(step, dt, x, s, u, p, F, I, known):
    """Advance the network by one step of exponential Euler: drive and rate held, the linear equation exact."""
    n = <states>
    k0 = <stages>
    drive = span_of(F, k0, n)
    rate = span_of(F, k0 + n, n)
    stage(x, s, u, p, F, I, drive, rate, step, 0.0, known)
    if <delays>:
        remember(step, s, F, I)
    for k in range(n):
        x[k] = relaxed(x[k], drive[k], rate[k], dt)
'''

RUSH_LARSEN = '''
@part
def network_step(step, dt, x, s, u, p, F, I, known):
    """Advance the network by one step of the second-order Rush–Larsen method: one evaluation.

    Drive and rate of the step's middle, on the line through those of this step and of the last, are held.
    """
    n = <states>
    k0 = <stages>
    drive = span_of(F, k0, n)
    rate = span_of(F, k0 + n, n)
    last_drive = span_of(F, k0 + 2 * n, n)
    last_rate = span_of(F, k0 + 3 * n, n)
    stage(x, s, u, p, F, I, drive, rate, step, 0.0, known)
    if <delays>:
        remember(step, s, F, I)
    ahead = 0.5 if step > 0 else 0.0
    for k in range(n):
        middle_drive = drive[k] + ahead * (drive[k] - last_drive[k])
        middle_rate = rate[k] + ahead * (rate[k] - last_rate[k])
        last_drive[k] = drive[k]
        last_rate[k] = rate[k]
        x[k] = relaxed(x[k], middle_drive, middle_rate, dt)
'''

STEPPERS = {"rk4": RK4, "exponential_euler": EXPONENTIAL_EULER, "rush_larsen": RUSH_LARSEN}

NO_BODY = '''
@compiled
def run(first, last, dt, x, s, u, p, F, I, R):
    """Advance from step `first` to step `last`; return the step reached and the position of a bad state or −1."""
    for step in range(first, last):
        if is_due(step, I):
            apply_protocol(step * dt, p, I)
            if <delays>:
                delayed_inputs(step, 0.0, p, F, I)
            network_outputs(x, s, u, p, F, I)
            if <inputs_recorded>:
                network_inputs(s, u, p, F, I)
            record(step, x, s, u, I, R)
        if <memory>:
            apply_protocol(step * dt, p, I)
            if <delays>:
                delayed_inputs(step, 0.0, p, F, I)
            network_outputs(x, s, u, p, F, I)
            advance_states(dt, x, s, u, p, F, I)
        apply_protocol((step + 0.5) * dt, p, I)
        network_step(step, dt, x, s, u, p, F, I, False)
        if <memory>:
            take_advanced(x, F, I)
        bad = bad_place(x)
        if bad >= 0:
            return step + 1, bad
    return last, -1
'''
