"""The body step, as text of a generated step module.

<name> is an offset or a count; `if <flag>:` keeps or drops the lines below it. What takes the tree and its kinematics
is inlined, because a call hands over each of their two dozen arrays with all its lengths and strides.
"""

BODY = '''
@part
def kinematics(s, F, I, T, D):
    """Place the segments in the world; signals of the contacts' centres and of the segments that are looked at."""
    topology, geometry, contact_segment, contact_position = T
    rotation, position, linear, angular, centers, axis, points, work, mass, damping = D
    n, body = <joints>, <body>
    root = body + 2 * n
    forward_kinematics(topology, geometry, span_of(s, body, n), span_of(s, root, 7), rotation, position)
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
    if <tracked> > 0 and I[<track> + <tracked> - 1] > 0:
        velocity = span_of(s, body + n, n)
        segment_velocities(topology, geometry, velocity, span_of(s, root + 7, 6), rotation, position, linear, angular)
    for k in range(<tracked>):
        r = I[<track> + k]
        at = <segment_signal> + 12 * k
        for c in range(3):
            s[at + c] = position[r, c]
            s[at + 6 + c] = linear[r, c]
            s[at + 9 + c] = angular[r, c]
        s[at + 3], s[at + 4], s[at + 5] = roll_pitch_yaw(rotation[r])


@part
def muscle_paths(s, p, F, I, T, D):
    """Muscle lengths, velocities and moment arms; as if all arms were constant first, then the other paths."""
    n, m, body = <joints>, <muscles>, <body>
    first = span_of(I, <path_first>, m + 1)
    total = first[m]
    joint = places_of(I, <path_joint>, total)
    kind = span_of(I, <path_kind>, m)
    factor = span_of(p, <path_factor>, m)
    angle = span_of(s, body, n)
    velocity = span_of(s, body + n, n)
    length = span_of(s, <length_signal>, m)
    speed = span_of(s, <velocity_signal>, m)
    constant = span_of(p, <path_arm>, total)
    reference = span_of(p, <path_reference>, total)
    reference_length = span_of(p, <path_length>, m)
    arms = span_of(F, <arms>, total)
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
    carrier = places_of(I, <path_segment> + first, last - first)
    for h in range(last - first):
        r = carrier[h]
        at = <path_point> + 3 * (first + h)
        for c in range(3):
            points[h, c] = position[r, c] + (
                rotation[r, c, 0] * p[at] + rotation[r, c, 1] * p[at + 1] + rotation[r, c, 2] * p[at + 2]
            )
    moved = span_of(I, <moved>, n * segments).reshape(n, segments)
    child = places_of(I, <child>, n)
    slide = span_of(I, <slide>, n)
    return straight_path(points[: last - first], carrier, moved, axis, position, child, slide, joint, arm)


@part
def torques(dt, x, s, u, p, F, I, T, D):
    """Torques of muscles, joint dampers and joint springs, coupled with the body; they go to the torque signals."""
    n, m, body, w = <joints>, <muscles>, <body>, <work>
    mass, damping = D[8], D[9]
    velocity = span_of(s, body + n, n)
    torque = span_of(s, <torque>, n)
    force = span_of(F, w, m)
    slope = span_of(F, w + m, m)
    acceleration = span_of(F, w + 2 * m, n + <root>)
    first = span_of(I, <path_first>, m + 1)
    joint = places_of(I, <path_joint>, first[m])
    arms = span_of(F, <arms>, first[m])
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
    last_velocity = span_of(F, <last_velocity>, n)
    last_torque = span_of(F, <last_torque>, n)
    if n > 0 and np.isnan(last_torque[0]):
        for j in range(n):
            last_torque[j] = torque[j]
            last_velocity[j] = velocity[j]
    coupled = span_of(I, <coupled>, n + <root>)
    observer_implicit(dt, mass, damping, coupled, torque, velocity, last_velocity, last_torque, acceleration)
    for j in range(n):
        last_torque[j] = torque[j]
        last_velocity[j] = velocity[j]


@compiled
def tick(number, dt, x, s, u, p, F, I, R, T, D):
    """One body step but for the body: the state read from it stands in s, the torque to apply is left there.

    What sensors tell reaches muscles through units without memory in the same step.
    Returns the position of a joint whose torque is not finite, or −1.
    """
    apply_protocol(number * dt, p, I)
    passes = 1
    if <delays>:
        if number == 0:
            passes += <history_width>
    for k in range(passes):
        if <delays>:
            delayed_inputs(number * <substeps>, 0.0, p, F, I)
        if <commanded>:
            network_outputs(x, s, u, p, F, I)
        kinematics(s, F, I, T, D)
        muscle_paths(s, p, F, I, T, D)
        evaluate_mechanics(x, s, u, p, F, I)
        if not <commanded>:
            network_outputs(x, s, u, p, F, I)
        if <commanded>:
            if <relays>:
                evaluate_network(x, s, u, p, F, I)
                evaluate_mechanics(x, s, u, p, F, I)
        if <delays>:
            if k < passes - 1:
                fill_history(s, F, I)
    if <inputs_recorded>:
        network_inputs(s, u, p, F, I)
    advance_states(dt, x, s, u, p, F, I)
    torques(dt, x, s, u, p, F, I, T, D)
    record(number, x, s, u, I, R)
    take_advanced(x, F, I)
    return bad_place(span_of(s, <torque>, <joints>))


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
    return bad_place(x)
'''
