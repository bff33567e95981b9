"""The parts of a generated step module that do not depend on the kinds in use. <name> is an offset or a count."""

ROWS = '''
@inlined
def arriving(row, s, p, F, I, source, row_start, weights, base):
    """Return the sum of the weighted signals that reach an input port."""
    total = F[base + row] + weighted_sum_at(p, s, source, weights, I[row_start + row], I[row_start + row + 1])
    if <shared weights>:
        shared_source = I[<segment_source> :].view(np.uint32)
        for g in range(I[<segment_start> + row], I[<segment_start> + row + 1]):
            some = shared_source[I[<segment_first> + g] : I[<segment_last> + g]]
            total += p[weights + I[<segment_weight> + g]] * sum_at(s, some)
    return total


@part
def rows_between(s, u, p, F, I, first, last):
    """Sum the weighted signals that reach the input ports from `first` to `last`."""
    source = I[<row_source> :].view(np.uint32)
    row_start, weights, base = <row_start>, <weights>, <base>
    for row in range(first, last):
        u[row] = arriving(row, s, p, F, I, source, row_start, weights, base)
'''

GATHER = '''
@part
def gather(s, u, p, F, I, first, rows, stride, ports):
    """Sum the weighted signals that reach `ports` blocks of `rows` input ports each."""
    for port in range(ports):
        start = first + port * stride
        rows_between(s, u, p, F, I, start, start + rows)
'''

TEAM_GATHER = '''
@part
def take_rows(s, u, p, F, I):
    """Sum rows of the present order until none are left."""
    team = I.ctypes.data + 8 * <team>
    first, last = I[<team> + FIRST], I[<team> + LAST]
    while True:
        start = first + PART * add(team + 8 * NEXT, 1)
        if start >= last:
            return
        rows_between(s, u, p, F, I, start, min(start + PART, last))


@compiled
def help(s, u, p, F, I):
    """Help the thread that runs the step until it stops the team."""
    team = I.ctypes.data + 8 * <team>
    seen, turns = 0, 0
    while True:
        order = load(team + 8 * ORDER)
        if order == STOP:
            return
        if order == seen:
            turns = rest_now_and_then(turns)
            continue
        seen = order
        take_rows(s, u, p, F, I)
        add(team + 8 * DONE, 1)


@part
def gather(s, u, p, F, I, first, rows, stride, ports):
    """Sum the weighted signals that reach `ports` blocks of `rows` input ports each, many of them with the team."""
    helpers = I[<team> + HELPERS]
    for port in range(ports):
        start = first + port * stride
        if helpers == 0 or rows <= PART:
            rows_between(s, u, p, F, I, start, start + rows)
            continue
        team = I.ctypes.data + 8 * <team>
        I[<team> + FIRST], I[<team> + LAST] = start, start + rows
        store(team + 8 * NEXT, 0)
        store(team + 8 * DONE, 0)
        add(team + 8 * ORDER, 1)
        take_rows(s, u, p, F, I)
        turns = 0
        while load(team + 8 * DONE) < helpers:
            turns = rest_now_and_then(turns)


@compiled
def stop(I):
    """Send the team away."""
    store(I.ctypes.data + 8 * <team> + 8 * ORDER, STOP)
'''

GATHER_SLOTS = '''
@part
def gather_slots(s, u, p, F, I, first, rows, table):
    """Sum the weighted signals that reach `rows` input ports, the k-th of every port at a time; see `slots.py`."""
    used, slots, entry, row = I[table], I[table + 1], I[table + 2], I[table + 3]
    base = F[<base> + first : <base> + first + rows]
    ports = u[first : first + rows]
    for k in range(rows):
        ports[k] = base[k]
    total = F[<slot_sums> : <slot_sums> + used]
    for k in range(used):
        total[k] = 0.0
    for slot in range(slots):
        count = I[table + 4 + slot]
        source = I[<slot_source> + entry : <slot_source> + entry + count]
        weight = p[<slot_weights> + entry : <slot_weights> + entry + count]
        for k in range(count):
            total[k] += weight[k] * s[source[k]]
        entry += count
    order = I[<slot_order> + row : <slot_order> + row + used]
    for k in range(used):
        u[order[k]] += total[k]
'''

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
    rate = F[<stages> : <stages> + n]
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


@part
def mean(k, x, s, u, I):
    """Return the k-th mean over a population."""
    first, count = I[<mean_first> + k], I[<mean_count> + k]
    states, signals = x.shape[0], s.shape[0]
    if first < states:
        return np.sum(x[first : first + count]) / count
    if first < states + signals:
        return np.sum(s[first - states : first - states + count]) / count
    return np.sum(u[first - states - signals : first - states - signals + count]) / count


@part
def is_due(tick, I):
    """Return whether any record group samples this tick."""
    for group in range(<groups>):
        if tick % I[<group_every> + group] == 0:
            return True
    return False


@part
def record(tick, x, s, u, I, R):
    """Copy the signals of every record group that is due, one stretch of signals that stand in one array at a time."""
    for group in range(<groups>):
        every = I[<group_every> + group]
        if tick % every:
            continue
        start, end = I[<group_start> + group], I[<group_start> + group + 1]
        row = I[<group_row> + group] + (tick // every) * (end - start) - start
        for k in range(I[<group_stretch> + group], I[<group_stretch> + group + 1]):
            first, last = I[<stretch_start> + k], I[<stretch_start> + k + 1]
            place = I[<place> + first : <place> + last]
            samples = R[row + first : row + last]
            array = I[<stretch_array> + k]
            if array == 0:
                copy_from(x, place, samples)
            elif array == 1:
                copy_from(s, place, samples)
            elif array == 2:
                copy_from(u, place, samples)
            else:
                for h in range(last - first):
                    samples[h] = mean(place[h], x, s, u, I)


@compiled
def first_bad(x):
    """Return the position of the first state that is not finite, or −1."""
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
    for _ in range(1 + <history_width>):
        network_outputs(x, s, u, p, F, I)
        fill_history(s, F, I)
        if <delays>:
            delayed_inputs(0, 0.0, p, F, I)
'''

RK4 = '''
@part
def network_step(step, dt, x, s, u, p, F, I, known):
    """Advance the network by one step of the classical Runge–Kutta method."""
    n = <states>
    k0 = <stages>
    total = F[k0 : k0 + n]
    now = F[k0 + n : k0 + 2 * n]
    drive = F[k0 + 2 * n : k0 + 3 * n]
    rate = F[k0 + 3 * n : k0 + 4 * n]
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
    drive = F[k0 : k0 + n]
    rate = F[k0 + n : k0 + 2 * n]
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
    drive = F[k0 : k0 + n]
    rate = F[k0 + n : k0 + 2 * n]
    last_drive = F[k0 + 2 * n : k0 + 3 * n]
    last_rate = F[k0 + 3 * n : k0 + 4 * n]
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
        bad = first_bad(x)
        if bad >= 0:
            return step + 1, bad
    return last, -1
'''

BODY = '''
@part
def kinematics(s, F, I, T, D):
    """Place the segments in the world; signals of the contacts' centres and of the segments that are looked at."""
    topology, geometry, contact_segment, contact_position = T
    rotation, position, linear, angular, centers, axis, points, work, mass, damping = D
    n, body = <joints>, <body>
    root = body + 2 * n
    forward_kinematics(topology, geometry, s[body : body + n], s[root : root + 7], rotation, position)
    contact_positions(contact_segment, contact_position, rotation, position, centers)
    for k in range(<contacts>):
        for c in range(3):
            s[<point> + 3 * k + c] = centers[k, c]
    for r in range(1, <segments>):
        for c in range(3):
            axis[topology[r, 1], c] = world_axis(geometry, rotation, r, c)
    for c in range(3):
        linear[0, c] = s[root + 7 + c]
        angular[0, c] = s[root + 10 + c]
    if <tracked> > 1:
        velocity = s[body + n : body + 2 * n]
        segment_velocities(topology, geometry, velocity, s[root + 7 : root + 13], rotation, position, linear, angular)
    for k in range(<tracked>):
        r = I[<track> + k]
        at = <segment_signal> + 12 * k
        for c in range(3):
            s[at + c] = position[r, c]
            s[at + 6 + c] = linear[r, c]
            s[at + 9 + c] = angular[r, c]
        s[at + 3], s[at + 4], s[at + 5] = roll_pitch_yaw(rotation[r])


@part
def mechanics(x, s, u, p, F, I, T, D):
    """Muscle lengths, velocities and moment arms, then forces and sensors."""
    kinematics(s, F, I, T, D)
    muscle_paths(s, p, F, I, T, D)
    evaluate_mechanics(x, s, u, p, F, I)


@part
def muscle_paths(s, p, F, I, T, D):
    """Muscle lengths, velocities and moment arms; as if all arms were constant first, then the other paths."""
    n, m, body = <joints>, <muscles>, <body>
    first = I[<path_first> : <path_first> + m + 1]
    total = first[m]
    joint = I[<path_joint> : <path_joint> + total]
    kind = I[<path_kind> : <path_kind> + m]
    factor = p[<path_factor> : <path_factor> + m]
    angle = s[body : body + n]
    velocity = s[body + n : body + 2 * n]
    length = s[<length_signal> : <length_signal> + m]
    speed = s[<velocity_signal> : <velocity_signal> + m]
    constant = p[<path_arm> : <path_arm> + total]
    reference = p[<path_reference> : <path_reference> + total]
    reference_length = p[<path_length> : <path_length> + m]
    arms = F[<arms> : <arms> + total]
    for h in range(total):
        arms[h] = constant[h]
    for k in range(m):
        some = reference_length[k]
        for h in range(first[k], first[k + 1]):
            some -= constant[h] * (angle[joint[h]] - reference[h])
        length[k] = some
    for k in range(m):
        a, b = first[k], first[k + 1]
        if kind[k] == STRAIGHT_LINES:
            length[k] = lines_length(k, p, I, T, D, joint[a:b], arms[a:b])
        elif kind[k] == LEVER_ARMS:
            some = 0.0
            for h in range(a, b):
                turned = angle[joint[h]] + p[<path_zero> + h]
                arms[h], way = lever(I[<path_form> + h], constant[h], turned, reference[h], p[<path_peak> + h])
                some += way
            length[k] = reference_length[k] - factor[k] * some
    for k in range(m):
        some = 0.0
        for h in range(first[k], first[k + 1]):
            some -= arms[h] * velocity[joint[h]]
        speed[k] = factor[k] * some


@compiled
def lengths_now(s, p, F, I, T, D):
    """Fill the lengths of all muscles from the body's state in s."""
    apply_protocol(0.0, p, I)
    kinematics(s, F, I, T, D)
    muscle_paths(s, p, F, I, T, D)


@part
def lines_length(k, p, I, T, D, joint, arm):
    """Place the points of muscle k in the world, measure the lines between them, fill the moment arms."""
    topology, geometry, contact_segment, contact_position = T
    rotation, position, linear, angular, centers, axis, points, work, mass, damping = D
    n, segments = <joints>, <segments>
    first, last = I[<path_point_first> + k], I[<path_point_first> + k + 1]
    carrier = I[<path_segment> + first : <path_segment> + last]
    for h in range(last - first):
        r = carrier[h]
        at = <path_point> + 3 * (first + h)
        for c in range(3):
            points[h, c] = position[r, c] + (
                rotation[r, c, 0] * p[at] + rotation[r, c, 1] * p[at + 1] + rotation[r, c, 2] * p[at + 2]
            )
    moved = I[<moved> : <moved> + n * segments].reshape(n, segments)
    child = I[<child> : <child> + n]
    slide = I[<slide> : <slide> + n]
    return straight_path(points[: last - first], carrier, moved, axis, position, child, slide, joint, arm)


@part
def torques(dt, x, s, u, p, F, I, T, D):
    """Torques of muscles, joint dampers and joint springs, coupled with the body; they go to the torque signals."""
    n, m, body, w = <joints>, <muscles>, <body>, <work>
    mass, damping = D[8], D[9]
    velocity = s[body + n : body + 2 * n]
    torque = s[<torque> : <torque> + n]
    force = F[w : w + m]
    slope = F[w + m : w + 2 * m]
    acceleration = F[w + 2 * m : w + 2 * m + n + <root>]
    first = I[<path_first> : <path_first> + m + 1]
    joint = I[<path_joint> : <path_joint> + first[m]]
    arms = F[<arms> : <arms> + first[m]]
    for k in range(m):
        force[k] = s[I[<force_slot> + k]]
        slope[k] = p[<path_factor> + k] * max(0.0, s[I[<damping_slot> + k]] + dt * s[I[<stiffness_slot> + k]])
    for j in range(n):
        d, k = p[<damping> + j], p[<joint_stiffness> + j]
        torque[j] = -k * (s[body + j] - p[<rest_angle> + j]) - d * velocity[j]
        for i in range(j):
            damping[j, i] = 0.0
        lower, upper = p[<soft_lower> + j], p[<soft_upper> + j]
        push, rise = soft_limit(s[body + j], velocity[j], lower, upper, p[<soft_velocity> + j])
        torque[j] += p[<soft_stiffness> + j] * push
        damping[j, j] = d + dt * k + p[<soft_stiffness> + j] * rise
    muscle_torque(force, arms, first, joint, torque)
    if <explicit>:
        return
    muscle_damping(slope, arms, first, joint, damping)
    inertia_of_all(T[0], T[1], <root>, D[0], D[1], D[7], mass)
    last_velocity = F[<last_velocity> : <last_velocity> + n]
    last_torque = F[<last_torque> : <last_torque> + n]
    if n > 0 and np.isnan(last_torque[0]):
        for j in range(n):
            last_torque[j] = torque[j]
            last_velocity[j] = velocity[j]
    coupled = I[<coupled> : <coupled> + n + <root>]
    observer_implicit(dt, mass, damping, coupled, torque, velocity, last_velocity, last_torque, acceleration)
    for j in range(n):
        last_torque[j] = torque[j]
        last_velocity[j] = velocity[j]


@part
def present(step, x, s, u, p, F, I, T, D):
    """Evaluate all signals of one instant; what sensors tell reaches muscles through units without memory at once."""
    if <delays>:
        delayed_inputs(step, 0.0, p, F, I)
    if <commanded>:
        network_outputs(x, s, u, p, F, I)
    mechanics(x, s, u, p, F, I, T, D)
    if not <commanded>:
        network_outputs(x, s, u, p, F, I)
    elif <relays>:
        evaluate_network(x, s, u, p, F, I)
        evaluate_mechanics(x, s, u, p, F, I)


@compiled
def tick(number, dt, x, s, u, p, F, I, R, T, D):
    """One body step but for the body: the state read from it stands in s, the torque to apply is left there.

    Returns the position of a joint whose torque is not finite, or −1.
    """
    apply_protocol(number * dt, p, I)
    passes = 1
    if <delays> and number == 0:
        passes += <history_width>
    for k in range(passes):
        present(number * <substeps>, x, s, u, p, F, I, T, D)
        if k < passes - 1:
            fill_history(s, F, I)
    if <inputs_recorded>:
        network_inputs(s, u, p, F, I)
    advance_states(dt, x, s, u, p, F, I)
    torques(dt, x, s, u, p, F, I, T, D)
    record(number, x, s, u, I, R)
    take_advanced(x, F, I)
    return first_bad(s[<torque> : <torque> + <joints>])


@compiled
def advance(number, dt, x, s, u, p, F, I):
    """Advance the network over body step `number`, sensors held; return the position of a bad state or −1.

    Where no parameter moves, the first step knows all signals from the body step's tick.
    """
    steps = <substeps>
    for k in range(steps):
        step = number * steps + k
        apply_protocol((step + 0.5) * dt / steps, p, I)
        network_step(step, dt / steps, x, s, u, p, F, I, k == 0 and <driven> == 0)
    return first_bad(x)
'''
